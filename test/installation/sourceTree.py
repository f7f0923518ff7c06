# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""What of a source tree gets into packages and images, and a source tree that is moved after its build. Trees of this test
have the files of Drystone that decide it, and nothing to compile."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

root = os.path.abspath(sys.argv.pop(1))
cmake = sys.argv.pop(1)


def read(name):
    with open(os.path.join(root, name), encoding="utf-8") as file:
        return file.read()


class SourceTree(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.tree = os.path.join(self.folder.name, "dry+stone (2)")

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, text=""):
        path = os.path.join(self.tree, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def copy(self, *names):
        for name in names:
            os.makedirs(os.path.dirname(os.path.join(self.tree, name)), exist_ok=True)
            shutil.copy(os.path.join(root, name), os.path.join(self.tree, name))

    def call(self, *command):
        done = subprocess.run(command, cwd=self.tree, capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def testRunsInTheSourceTreeAreNotInstalled(self):
        kept = ["parameterSearch/arch/Allrun", "contactDynamics/slide/0/motion", "contactDynamics/slide/constant/g",
                "limitAnalysis/masonryPanels/wall1/system/loads", "limitAnalysis/arch/mechanism.svg",
                "accuracyCost/space/box/pages/points.svg", "limitAnalysis/space/house/structure/constant/loads"]
        left = ["limitAnalysis/masonryPanels/table1.txt", "limitAnalysis/masonryPanels/surface_wall1/system/loads",
                "incrementalDynamics/masonryPanels/wall3/system/loads", "contactDynamics/slide/1/state",
                "contactDynamics/slide/0.25/state", "contactDynamics/slide/log.contactDynamics",
                "contactDynamics/slide/constant/assembly/blocks", "contactDynamics/slide/VTK/blocks.vtp.series",
                "contactDynamics/slide/postProcessing/energy/0/energy.dat", "contactDynamics/slide/report.html",
                "parameterSearch/arch/parameterSearch/best/system/loads", "limitAnalysis/space/house/runs/0/system/loads",
                "limitAnalysis/fromPython/__pycache__/study.pyc"]
        for name in kept + left:
            self.write("tutorials/" + name)
        self.copy(".gitignore", "cmake/leftByRuns.cmake")
        self.write("CMakeLists.txt", "cmake_minimum_required(VERSION 3.25)\nproject(drystone NONE)\n"
                   "include(cmake/leftByRuns.cmake)\ninstall(DIRECTORY tutorials DESTINATION . ${leftByRuns})\n")
        self.call(cmake, "-B", "build")
        self.call(cmake, "--install", "build", "--prefix", "installed")
        installed = os.path.join(self.tree, "installed/tutorials")
        found = [os.path.relpath(os.path.join(folder, name), installed) for folder, _, names in os.walk(installed) for name in names]
        self.assertEqual(sorted(found), sorted(kept))
        self.assertIn("include(${CMAKE_CURRENT_LIST_DIR}/leftByRuns.cmake)", read("cmake/install.cmake"))

    def testImagesAreMadeWithoutWhatGitIgnores(self):
        self.assertIn("COPY . /drystone", read("Dockerfile"))
        ignored = {line for line in read(".gitignore").split("\n") if line.startswith("/")}
        self.assertIn("/build/", ignored)
        self.assertLessEqual(ignored, set(read(".dockerignore").split("\n")))

    def testTheImageIsMadeByWhatThereIs(self):
        recipe = read("Dockerfile")
        self.assertRegex(read("etc/bootstrap"), re.search(r"etc/bootstrap (\w+)", recipe).group(1) + r" \| test\) what=")
        for option in re.findall(r"-D (DRYSTONE_\w+)", recipe):
            self.assertIn(option, read("CMakeLists.txt"))
        self.assertIn("add_custom_target(" + re.search(r"--target (\w+)", recipe).group(1) + ")", read("CMakeLists.txt"))

    def testCommandsOfABuildAreQuoted(self):
        # In a folder such as "Drystone (2)" a command without VERBATIM is no command of the shell.
        commands = []
        for folder, folders, names in os.walk(root):
            folders[:] = [name for name in folders if name not in ("build", ".git", "tutorials", "node_modules")]
            for name in names:
                if name == "CMakeLists.txt" or name.endswith(".cmake"):
                    commands += re.findall(r"add_custom_command\([^\0]*?\)\n", read(os.path.join(folder, name)))
        self.assertTrue(commands)
        self.assertEqual([command for command in commands if "VERBATIM" not in command], [])

    def testATreeThatIsMovedIsBuiltAnew(self):
        self.copy("etc/tools/BuildFunctions", "CMakePresets.json")
        self.write("etc/bootstrap", "#!/bin/bash\n")
        os.chmod(os.path.join(self.tree, "etc/bootstrap"), 0o755)
        self.write("CMakeLists.txt", "cmake_minimum_required(VERSION 3.25)\nproject(drystone NONE)\n"
                   "add_custom_target(applications COMMAND ${CMAKE_COMMAND} -E touch built)\n")
        build = ("bash", "-c", ". etc/tools/BuildFunctions; buildRelease applications")
        self.call(*build)
        self.assertIn("build/ is configured", self.call(*build))
        moved = self.tree + " moved"
        os.rename(self.tree, moved)
        self.tree = moved
        os.remove(os.path.join(self.tree, "build/built"))
        self.call(*build)
        self.assertTrue(os.path.exists(os.path.join(self.tree, "build/built")))


if __name__ == "__main__":
    unittest.main()
