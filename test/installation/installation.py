# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Installs into a folder of its own and uses what is there as a user would, without the source tree in any variable."""
import os
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import unittest

build, cmake = sys.argv.pop(1), sys.argv.pop(1)
system = "/usr/bin:/bin"


def bash(script, folder, path):
    environment = {"PATH": path, "HOME": folder, "LANG": "C.UTF-8"}
    return subprocess.run(["bash", "-c", script], cwd=folder, env=environment, capture_output=True, text=True,
                          timeout=200, check=False)


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = tempfile.TemporaryDirectory()
        cls.prefix = os.path.join(cls.root.name, "prefix")
        subprocess.run([cmake, "--install", build, "--prefix", cls.prefix], check=True, stdout=subprocess.DEVNULL)
        cls.path = os.path.join(cls.prefix, "bin") + ":" + system

    @classmethod
    def tearDownClass(cls):
        cls.root.cleanup()

    def copyOfTutorial(self, name):
        folder = tempfile.mkdtemp(dir=self.root.name)
        return shutil.copytree(os.path.join(self.prefix, "share/drystone/tutorials", name), os.path.join(folder, "mine"),
                               ignore=shutil.ignore_patterns("log.*", "postProcessing", "VTK", "assembly"))

    def testNothingIsInstalledElsewhere(self):
        with open(os.path.join(build, "install_manifest.txt"), encoding="utf-8") as manifest:
            files = manifest.read().split("\n")
        self.assertIn(os.path.join(self.prefix, "bin/limitAnalysis"), files)
        self.assertEqual([file for file in files if file and not file.startswith(self.prefix + "/")], [])
        if os.path.exists(os.path.join(build, "share/drystone/viewer.js")):
            self.assertIn(os.path.join(self.prefix, "share/drystone/viewer.js"), files)

    def testEveryFileIsOfAComponent(self):
        """Packages are made of components, and what is of none would be in no package."""
        def filesIn(prefix):
            return {os.path.relpath(os.path.join(folder, name), prefix)
                    for folder, _, names in os.walk(prefix) for name in names if not name.endswith(".pyc")}

        parts = os.path.join(self.root.name, "parts")
        for component in ("applications", "python", "development"):
            subprocess.run([cmake, "--install", build, "--component", component, "--prefix", parts], check=True,
                           stdout=subprocess.DEVNULL)
        self.assertEqual(filesIn(self.prefix) - filesIn(parts), set())

    def testLinksOfTheDocumentationLeadSomewhere(self):
        documents = os.path.join(self.prefix, "share/doc/drystone")
        for name in ("README.md", "GUIDE.md", "CONTRIBUTING.md", "tutorials/README.md"):
            with open(os.path.join(documents, name), encoding="utf-8") as file:
                links = re.findall(r"\]\(([^)#\s]+)[^)]*\)", file.read())
            folder = os.path.dirname(os.path.join(documents, name))
            self.assertEqual([link for link in links if "://" not in link and not os.path.exists(os.path.join(folder, link))], [], name)

    def testThePackageDependsOnWhatIsLoadedByName(self):
        # dpkg-shlibdeps does not see it.
        with open(os.path.join(build, "CPackConfig.cmake"), encoding="utf-8") as file:
            self.assertRegex(re.findall(r"set\(CPACK_DEBIAN_APPLICATIONS_PACKAGE_DEPENDS.*", file.read())[0], r"\blibcairo2\b")

    def testEachPackageHasItsCopyright(self):
        """Debian policy, 12.5: who has written what is installed, under which licence, by the files' names in the source."""
        for package in ("drystone", "python3-drystone"):
            with open(os.path.join(self.prefix, "share/doc", package, "copyright"), encoding="utf-8") as file:
                text = file.read()
            for part in ("Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/",
                         "\nFiles: *\nCopyright: 2026 the Drystone authors\nLicense: GPL-3.0-or-later\n",
                         "/usr/share/common-licenses/GPL-3", "three.js"):
                self.assertIn(part, text)
            for files in re.findall(r"(?m)^Files: (tutorials/\S+)/\*$", text):
                self.assertTrue(os.path.isdir(os.path.join(self.prefix, "share/drystone", files)), files)

    def testATutorialCopiedElsewhereRuns(self):
        folder = self.copyOfTutorial("limitAnalysis/arch")
        done = bash("./Allrun", folder, self.path)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("Status: optimal", done.stdout)
        self.assertIn("Status: unstable", done.stdout)
        self.assertEqual(bash("./Allclean", folder, self.path).returncode, 0)
        self.assertFalse(os.path.exists(os.path.join(folder, "stands", "log.limitAnalysis")))

    def testEveryTutorialFindsTheFunctionsOfTheInstallation(self):
        lost = []
        for folder, _, names in os.walk(os.path.join(self.prefix, "share/drystone/tutorials")):
            for name in names:
                if name.startswith("All"):
                    with open(os.path.join(folder, name), encoding="utf-8") as script:
                        text = script.read()
                    if "RunFunctions" in text and "|| . drystoneRunFunctions" not in text:
                        lost.append(os.path.join(folder, name))
        self.assertEqual(lost, [])

    def testAStudyInPythonFindsThePackage(self):
        done = bash("./Allrun", self.copyOfTutorial("limitAnalysis/fromPython"), self.path)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("0.65 0.642859", done.stdout)

    def testACopiedTutorialEndsWhereNothingIsInstalled(self):
        done = bash("./Allrun", self.copyOfTutorial("limitAnalysis/arch"), system)
        self.assertEqual(done.returncode, 1)
        self.assertIn("drystoneRunFunctions", done.stderr)
        self.assertNotIn("runApplication", done.stderr)

    def testANewCaseIsWrittenAndComputed(self):
        done = bash("drystone-new garden-wall && cd garden-wall && blockTexture && limitAnalysis", self.root.name, self.path)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("at collapse 861.6 N", done.stdout)
        self.assertEqual(bash("drystone-new -version", self.root.name, self.path).stdout,
                         bash("limitAnalysis -version", self.root.name, self.path).stdout)

    def testVersionNamesNameVersionAndCommit(self):
        done = bash("limitAnalysis -version", self.root.name, self.path)
        self.assertRegex(done.stdout, r"^Drystone \d+\.\d+\.\d+( at [0-9a-f]+)?\n$")

    def testEveryApplicationHasHelpOfEightyColumnsAndAManualPage(self):
        for name in os.listdir(os.path.join(self.prefix, "bin")):
            if name == "drystoneRunFunctions":
                continue
            text = bash(name + " -help", self.root.name, self.path).stdout
            self.assertIn("Usage: " + name, text)
            self.assertEqual([line for line in text.splitlines() if len(line) > 80], [], name)
            with open(os.path.join(self.prefix, "share/man/man1", name + ".1"), encoding="utf-8") as page:
                roff = page.read()
            self.assertRegex(roff, r"\A\.TH " + name.upper() + r' 1 "20\d\d-\d\d-\d\d" ')
            self.assertRegex(roff, r"\n" + name + r" \\- \w")
            self.assertIn(".SH Options", roff)
            # Every key of -help is on the page.
            keys = re.findall(r"^ +([a-zA-Z]+) {2}", text, re.MULTILINE)
            self.assertEqual([key for key in keys if key not in roff], [])

    def complete(self, line, *files):
        """What completion offers behind `line`."""
        folder = tempfile.mkdtemp(dir=self.root.name)
        for name, text in files:
            os.makedirs(os.path.join(folder, os.path.dirname(name)), exist_ok=True)
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        words = line.split(" ")
        script = (f". '{self.prefix}/share/bash-completion/completions/{words[0]}'\n"
                  f"COMP_WORDS=({' '.join(repr(word) for word in words)}); COMP_CWORD={len(words) - 1}\n"
                  f"_drystone {words[0]}; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
        done = bash(script, folder, self.path)
        self.assertEqual(done.stderr, "")
        return sorted(done.stdout.split())

    def typed(self, folder, line):
        """What an interactive bash makes of a line when Tab is pressed behind it."""
        master, slave = pty.openpty()
        environment = {"PATH": self.path, "HOME": folder, "LANG": "C.UTF-8", "TERM": "dumb", "PS1": "$ ", "COLUMNS": "200"}
        shell = subprocess.Popen(["bash", "--norc", "--noprofile", "-i"], cwd=folder, env=environment, stdin=slave, stdout=slave,
                                 stderr=slave, start_new_session=True)
        os.close(slave)

        def answer(text, until):
            os.write(master, text.encode())
            said = ""
            while not re.search(until, said) and select.select([master], [], [], 20)[0]:
                said += os.read(master, 4096).decode()
            return said

        try:
            answer(f"bind 'set enable-bracketed-paste off'; . '{self.prefix}/share/bash-completion/completions/"
                   f"{line.split(' ')[0]}'; echo re''ady\n", r"ready\r?\n\$ ")
            # Tab, then the line as the argument of echo instead of a command (Ctrl-A, Ctrl-E).
            said = answer(line + "\t\x01echo '\x05'; echo do''ne\n", r"done\r?\n")
            return said.replace("\r", "").split("\n")[-3].strip()
        finally:
            shell.kill()
            shell.wait()
            os.close(master)

    def testTabCompletesInABash(self):
        folder = tempfile.mkdtemp(dir=self.root.name)
        os.mkdir(os.path.join(folder, "system"))
        with open(os.path.join(folder, "system/solution"), "w", encoding="utf-8") as file:
            file.write("limitAnalysis { solver interiorPoint; tolerance 1e-9; }\n")
        for line, completed in (
                ("solveProgram program -solver g", "solveProgram program -solver gaussSeidel"),
                ("limitAnalysis -par", "limitAnalysis -par"),
                ("limitAnalysis -dr", "limitAnalysis -dry-run"),
                ("drystone-new ga", "drystone-new garden-wall"),
                ("caseDictionary system/solution -entry l", "caseDictionary system/solution -entry limitAnalysis"),
                ("caseDictionary system/solution -entry limitAnalysis/s",
                 "caseDictionary system/solution -entry limitAnalysis/solver")):
            with self.subTest(line=line):
                self.assertEqual(self.typed(folder, line), completed)

    def testCompletionOffersWhatTheApplicationTakes(self):
        self.assertIn("-dry-run", self.complete("limitAnalysis -"))
        self.assertNotIn("-parallel", self.complete("limitAnalysis -"))
        self.assertEqual(self.complete("solveProgram program -solver g"), ["gaussSeidel"])
        self.assertEqual(self.complete("solveProgram program -tolerance "), [])
        self.assertEqual(self.complete("exportBlocks -format "), ["3dec", "compasJson", "dxf", "gltf", "lmgc90", "obj"])
        self.assertEqual(self.complete("limitAnalysis -view b"), ["back"])
        self.assertEqual(self.complete("drystone-new ga"), ["garden-wall"])
        dictionary = ("system/solution", "limitAnalysis { solver interiorPoint; tolerance 1e-9; }\n")
        self.assertEqual(self.complete("caseDictionary system/solution -entry l", dictionary), ["limitAnalysis"])
        self.assertEqual(self.complete("caseDictionary system/solution -entry limitAnalysis/", dictionary),
                         ["limitAnalysis/solver", "limitAnalysis/tolerance"])


if __name__ == "__main__":
    unittest.main()
