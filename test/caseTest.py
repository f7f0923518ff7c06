# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Common to the tests of whole applications: cases in a temporary folder, in which an application is run."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

applications, tutorial = (os.path.abspath(path) for path in sys.argv[1:3])

header = "FoamFile { version 2.0; format ascii; class dictionary; object %s; }\n"


class CaseTest(unittest.TestCase):
    application = ""  # the one that run_ runs

    @classmethod
    def setUpClass(cls):
        cls.root = tempfile.TemporaryDirectory()

    @classmethod
    def tearDownClass(cls):
        cls.root.cleanup()

    @staticmethod
    def copyInput(source, target):
        """A case as git has it: without what applications wrote, and without an initial state."""
        shutil.copytree(source, target,
                        ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "[0-9]*", "assembly"))

    def copyOf(self, source):
        """The input of a case in a folder of this test."""
        case = os.path.join(self.root.name, self.id().rsplit(".", 1)[-1])
        self.copyInput(source, case)
        return case

    def runApplication(self, application, case, *options, status=0, timeout=120):
        done = subprocess.run([os.path.join(applications, application), "-case", case, *options],
                              capture_output=True, text=True, timeout=timeout, check=False)
        self.assertEqual(done.returncode, status, done.stdout[-2000:] + done.stderr)
        return done

    def run_(self, case, *options, status=0):
        return self.runApplication(self.application, case, *options, status=status)

    @staticmethod
    def read(case, name):
        with open(os.path.join(case, name), encoding="utf-8") as file:
            return file.read()
