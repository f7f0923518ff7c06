# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""find_package(Drystone): a program of somebody else is configured, compiled and run with the libraries that
`cmake --install` has made, by its own copy of the sources and without the source tree of Drystone in any variable."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

build, cmake, compiler = sys.argv.pop(1), sys.argv.pop(1), sys.argv.pop(1)
consumer = os.path.join(os.path.dirname(os.path.abspath(__file__)), "consumer")


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = tempfile.TemporaryDirectory()
        cls.prefix = os.path.join(cls.root.name, "first")
        subprocess.run([cmake, "--install", build, "--component", "development", "--prefix", cls.prefix], check=True,
                       stdout=subprocess.DEVNULL)
        # A prefix that is moved is found as well.
        moved = os.path.join(cls.root.name, "moved")
        os.rename(cls.prefix, moved)
        cls.prefix = moved

    @classmethod
    def tearDownClass(cls):
        cls.root.cleanup()

    def configure(self, name, **replaced):
        source = shutil.copytree(consumer, os.path.join(self.root.name, name))
        with open(os.path.join(source, "CMakeLists.txt"), encoding="utf-8") as file:
            text = file.read()
        for old, new in replaced.values():
            self.assertIn(old, text)
            text = text.replace(old, new)
        with open(os.path.join(source, "CMakeLists.txt"), "w", encoding="utf-8") as file:
            file.write(text)
        return source, subprocess.run([cmake, "-S", source, "-B", os.path.join(source, "build"), "-G", "Ninja",
                                       "-D", "CMAKE_PREFIX_PATH=" + self.prefix, "-D", "CMAKE_CXX_COMPILER=" + compiler,
                                       "-D", "CMAKE_BUILD_TYPE=Release"], capture_output=True, text=True, check=False)

    def testAProgramOfSomebodyElseLinksTheLibraries(self):
        source, done = self.configure("program")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        done = subprocess.run([cmake, "--build", os.path.join(source, "build"), "--verbose"], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        # The processor of the libraries, whose layout in memory it shares, and no warnings of ours.
        with open(os.path.join(build, "CMakeCache.txt"), encoding="utf-8") as file:
            processor = re.search(r"^DRYSTONE_PROCESSOR:\w+=(.*)$", file.read(), re.M)
        if processor:
            self.assertIn("-march=" + processor.group(1), done.stdout)
        self.assertIn("-ffp-contract=off", done.stdout)
        self.assertNotIn("-Wshadow", done.stdout)
        done = subprocess.run([os.path.join(source, "build", "consumer")], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, "alpha = 0.642859\n")

    def testNothingInItLeadsToTheSourceTree(self):
        tree = os.path.dirname(os.path.dirname(os.path.dirname(consumer)))
        folder = os.path.join(self.prefix, "lib")
        read = 0
        for where, _, names in os.walk(folder):
            for name in names:
                if name.endswith(".cmake"):
                    with open(os.path.join(where, name), encoding="utf-8") as file:
                        self.assertNotIn(tree + "/", file.read(), name)
                    read += 1
        self.assertGreaterEqual(read, 3)

    def testWhatIsMissingIsSaid(self):
        _, done = self.configure("newer", version=("Drystone 0.1", "Drystone 99"))
        self.assertNotEqual(done.returncode, 0)
        self.assertIn('compatible with requested version "99"', re.sub(r"\s+", " ", done.stderr))
        _, done = self.configure("withoutC", languages=("LANGUAGES C CXX", "LANGUAGES CXX"))
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("write project(NAME LANGUAGES C CXX)", re.sub(r"\s+", " ", done.stderr))


if __name__ == "__main__":
    unittest.main()
