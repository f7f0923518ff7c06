#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""That the page of the tutorials' figures is checked against the files `expected`, and against what they accept."""
import json
import os
import tempfile
import unittest

import writeAtlas

expected = """a.dat alpha 0.643 5e-4 ; wall: panel 1, multiplier ; published ; a paper, table 1
a.dat x 0 1e-9 ; block: at rest, x [m] ; closed form ; 0
a.dat ag 0.641 differs ; wall: panel 1, acceleration [g] ; published ; a paper, table 1
a.dat alpha 0.5 1e-9 ; arch: of stones, multiplier ; kept ; Drystone
a.dat gap 0 1e-9
"""
figures = {0: 0.642859003, 1: -3e-12, 2: 0.643, 3: 0.5}


class Atlas(unittest.TestCase):
    def setUp(self):
        writeAtlas.leastReferences = 2
        self.root = tempfile.TemporaryDirectory()
        self.write("tutorials/limitAnalysis/wall/expected", expected)
        found = {line: [figures[i]] for i, line in enumerate(expected.splitlines()) if i in figures}
        self.write("records/limitAnalysis/wall.json",
                   json.dumps({"tutorial": "limitAnalysis/wall", "time": 0.52, "processor": "Some(R) CPU",
                               "date": "2026-11-23", "found": found}))

    def tearDown(self):
        self.root.cleanup()

    def path(self, name):
        return os.path.join(self.root.name, name)

    def write(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def page(self):
        with open(self.path("tutorials/README.md"), encoding="utf-8") as file:
            return file.read()

    def faults(self, what="--check"):
        return writeAtlas.faultsOf(self.root.name, what)[0]

    def testWritesAPageThatItAccepts(self):
        self.assertEqual(self.faults(self.path("records")), [])
        self.assertEqual(self.faults(), [])
        page = self.page()
        self.assertIn("| panel 1, multiplier | 0.643 | published: a paper, table 1 | 0.642859003 | -0.022% |", page)
        self.assertIn("2026-11-23, Some(R) CPU", page)
        self.assertLess(page.index("at rest"), page.index("of stones"))
        self.assertIn("| 0.643 | +0.31% |", page[page.index("## Not reproduced"):])

    def testRefusesAPageThatDiffers(self):
        self.faults(self.path("records"))
        for old, new in (("| 0.642859003 |", "| 0.652859003 |"), ("| 0.643 | published", "| 0.644 | published"),
                         ("a paper, table 1", "a paper, table 2"), ("| 0.643 | +0.31%", "| 0.641 | +0.31%"),
                         ("-0.022%", "-0.021%"), ("1 published figures", "2 published figures")):
            page = self.page()
            self.assertIn(old, page)
            self.write("tutorials/README.md", page.replace(old, new, 1))
            self.assertNotEqual(self.faults(), [], new)
            self.write("tutorials/README.md", page)

    def testRefusesLinesThatThePageDoesNotHave(self):
        self.faults(self.path("records"))
        self.write("tutorials/limitAnalysis/wall/expected",
                   expected + "a.dat alpha 0.7 1 ; wall: panel 2, multiplier ; published ; a paper\n")
        self.assertNotEqual(self.faults(), [])
        self.write("tutorials/limitAnalysis/wall/expected", expected.split("\n", 1)[1])
        self.assertNotEqual(self.faults(), [])

    def testRefusesNumbersWithoutASource(self):
        for line in ("a.dat alpha 0.643 5e-4\n", "a.dat alpha 0.643 5e-4 ; pyramid: of stones ; published ; a paper\n"):
            self.write("tutorials/limitAnalysis/wall/expected", expected + line)
            with self.assertRaises(ValueError):
                self.faults()

    def testSaysWhatWasNotRun(self):
        self.write("tutorials/limitAnalysis/other/expected", "a.dat x 2 1 ; wall: other, x ; published ; a paper\n")
        self.assertEqual(self.faults(self.path("records")), [])
        self.assertEqual(self.faults(), [])
        self.assertIn("| other, x | 2 | published: a paper | - | - | [limitAnalysis/other](limitAnalysis/other) | - |",
                      self.page())
        writeAtlas.leastReferences = 3  # it does not count
        self.assertNotEqual(self.faults(), [])

    def testDemandsReferences(self):
        self.faults(self.path("records"))
        writeAtlas.leastReferences = 3
        self.assertNotEqual(self.faults(), [])


if __name__ == "__main__":
    unittest.main()
