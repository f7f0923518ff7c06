#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Runs that may take long say meanwhile how long they still take: in the log, or in a line on a terminal.

timeLeft.py BIN CASE       CASE: the tutorial limitAnalysis/largeWall, 25,680 blocks
"""
import os
import pty
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from caseTest import CaseTest, applications, tutorial  # noqa: E402

tutorials = os.path.join(tutorial, "../..")
left = r"(\d+ (d|h|min|s) ?)+ *left"


class TimeLeft(CaseTest):
    def case(self, name, entries=()):
        """A copy of a tutorial with its blocks. entries: file, entry and value of dictionaries."""
        case = self.copyOf(os.path.join(tutorials, name))
        for file, entry, value in entries:
            self.call("caseDictionary", case, file, "-entry", entry, "-set", value)
        self.call("blockTexture", case)
        return case

    def call(self, *command):
        return self.runApplication(*command, timeout=280).stdout

    def onTerminal(self, application, case):
        """What a run writes on a terminal beside its log, and how long it takes [s]."""
        master, slave = pty.openpty()
        start = time.monotonic()
        with open(os.path.join(case, "log"), "w", encoding="utf-8") as log:
            process = subprocess.Popen([os.path.join(applications, application), "-case", case], stdout=log, stderr=slave)
        os.close(slave)
        said = b""
        while True:
            try:
                part = os.read(master, 4096)
            except OSError:  # the other end is closed
                part = b""
            if not part:
                break
            said += part
        self.assertEqual(process.wait(), 0, said)
        os.close(master)
        return said.decode(), time.monotonic() - start

    def testLimitAnalysisOfALargeWall(self):
        case = self.case("limitAnalysis/largeWall")
        said, seconds = self.onTerminal("limitAnalysis", case)
        if seconds < 4:
            self.skipTest("this machine solves it before it is worth a line")
        self.assertRegex(said, rf"\d+\.\d %  {left}  iteration \d+")
        self.assertTrue(said.endswith("\r\033[K"), "the line is not wiped")

    def testContactDynamics(self):
        case = self.case("contactDynamics/fallingWall/wall")
        said, seconds = self.onTerminal("contactDynamics", case)
        if seconds < 1:
            self.skipTest("this machine simulates it before it is worth a line")
        self.assertRegex(said, rf"\d+\.\d %  {left}")

    def testIncrementalDynamics(self):
        case = self.case("incrementalDynamics/space/cornerWalls/structure")
        self.assertRegex(self.call("incrementalDynamics", case), rf"at most {left}")

    def testParameterSearch(self):
        self.assertRegex(self.call("parameterSearch", self.case("parameterSearch/liveLoadDirection")), rf"at most {left}")

    def testEnsemble(self):
        case = self.case("ensemble/wall6", entries=[("system/ensembleDict", "design/samples", "40")])
        self.assertRegex(self.call("ensemble", case), rf"Samples: \d+ of 240, .*{left}")

    def testAccuracyCost(self):
        case = self.case("accuracyCost/space/slidingBox/box")
        self.assertRegex(self.call("accuracyCost", case), left)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
