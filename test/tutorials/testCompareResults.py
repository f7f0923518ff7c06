#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""That the comparison of results accepts what is right and refuses what is not."""
import os
import tempfile
import unittest

import compareResults

table = "# Time[s]  ux[m] alpha[-]\n0 0 0.5\n0.5 1e-3 0.6\n1 -2e-3 0.642859\n"


class Comparison(unittest.TestCase):
    def setUp(self):
        self.case = tempfile.TemporaryDirectory()
        os.makedirs(os.path.join(self.case.name, "post"))
        for name, text in {"post/a.dat": table, "log.x": "Status: optimal\nalpha = 0.25.\nrun 1\nrun 2\nEnd\n", "empty": "",
                           "nan.dat": "# Time[s] ux[m]\n1 nan\n", "short.dat": "# Time[s] ux[m]\n1\n"}.items():
            with open(os.path.join(self.case.name, name), "w", encoding="utf-8") as file:
                file.write(text)

    def tearDown(self):
        self.case.cleanup()

    def failures(self, line):
        return compareResults.compareLine(self.case.name, line)[0]

    def testAcceptsWhatIsRight(self):
        for line in ("post/a.dat alpha 0.642859 1e-9", "post/*.dat alpha[-]@first 0.5 0", "post/a.dat ux@0.5 0.001 1e-9",
                     "post/a.dat ux@min -2e-3 1%", "post/a.dat ux@count 3 0", "log.x contains Status: optimal",
                     "log.x exists", "log.y absent", 'log.x "alpha =" 0.25 0', "post/a.dat alpha 0.641 differs",
                     "post/a.dat alpha 0.642859 1e-9 ; wall: a panel ; closed form ; by hand"):
            self.assertEqual(self.failures(line), [], line)

    def testRefusesWhatIsNot(self):
        for line in ("post/a.dat alpha 0.6428 1e-6", "post/a.dat beta 1 1", "post/a.dat ux@0.7 0 1", "post/b.dat ux 0 1",
                     "log.x contains Status: unstable", "empty exists", "log.x absent", "nan.dat ux 0 1e9",
                     "short.dat ux 0 1", "post/a.dat alpha 0.6", "post/a.dat", "post/a.dat alpha 0.65 1%",
                     'log.x "alpha =" 0.2 0', 'log.x "beta =" 0.2 1', 'log.x "run" 1 9', "post/a.dat alpha 0.643 differs",
                     "post/a.dat alpha 0.642859 1e-9 ; wall: a panel ; heard ; of somebody",
                     "post/a.dat alpha 0.642859 1e-9 ; wall: a panel ; published",
                     "post/a.dat alpha 0.65 1e-9 ; wall: a panel ; closed form ; by hand"):
            self.assertNotEqual(self.failures(line), [], line)

    def testParsesWhereAValueIsFrom(self):
        words, annotation = compareResults.parseLine('log.x "alpha =" 0.25 0 ; wall: a panel ; published ; a paper, table 1')
        self.assertEqual(words, ["log.x", '"alpha ="', "0.25 0"])
        self.assertEqual(annotation, {"what": "wall: a panel", "origin": "published", "source": "a paper, table 1"})
        self.assertEqual(compareResults.parseLine("log.x contains a ; b"), (["log.x", "contains", "a ; b"], None))


if __name__ == "__main__":
    unittest.main()
