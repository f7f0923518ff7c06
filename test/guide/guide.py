# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the commands of GUIDE.md, `$ command` in blocks of kind console, in an empty folder, and compares their answers with
the lines below each, which have to be there in this order; `...` is any number of lines. Then each kind of case that
drystone-new knows is written and computed."""
import os
import re
import subprocess
import sys
import tempfile
import unittest

root, applications = (os.path.abspath(path) for path in (sys.argv.pop(1), sys.argv.pop(1)))


def commandsOf(text):
    """Pairs of a command and the lines of its answer."""
    pairs = []
    for block in re.findall(r"^```console\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        for line in block.splitlines():
            if line.startswith("$ "):
                pairs.append((line[2:], []))
            else:
                pairs[-1][1].append(line.strip())
    return pairs


def fits(answer, wanted):
    """Whether the lines of an answer are those that are wanted, blank ones aside; `...` is any number of lines."""
    wanted = [line for line in wanted if line]
    pattern = "".join(r"(?:.*\n)*?" if line == "..." else re.escape(line) + r"\n" for line in wanted)
    lines = "".join(line.strip() + "\n" for line in answer.splitlines() if line.strip())
    return re.fullmatch(pattern, lines) is not None


class Shell:
    def __init__(self, folder):
        self.folder = folder
        self.environment = {"PATH": applications + ":/usr/bin:/bin", "HOME": folder, "LANG": "C.UTF-8"}

    def step(self, command):
        """Runs a command; the folder that it goes to is kept for the next one."""
        readEnd, writeEnd = os.pipe()
        done = subprocess.run(["bash", "-c", f"{command}\nstatus=$?; pwd >&{writeEnd}; exit $status"], cwd=self.folder,
                              env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=300, check=False, pass_fds=[writeEnd])
        os.close(writeEnd)
        with os.fdopen(readEnd, encoding="utf-8") as pipe:
            self.folder = pipe.read().strip() or self.folder
        return done


class Guide(unittest.TestCase):
    def testComparesAnswers(self):
        self.assertTrue(fits("a\n\n  b = 1\nc\n", ["...", "b = 1", "..."]))
        self.assertTrue(fits("", []))
        self.assertFalse(fits("a\nb = 2\nc\n", ["...", "b = 1", "..."]))
        self.assertFalse(fits("b\na\n", ["...", "a", "...", "b", "..."]))
        self.assertFalse(fits("a\n", []))

    def testEveryCommandAnswersAsTheGuideSays(self):
        with open(os.path.join(root, "GUIDE.md"), encoding="utf-8") as file:
            pairs = commandsOf(file.read())
        self.assertGreater(len(pairs), 20)
        with tempfile.TemporaryDirectory() as folder:
            shell = Shell(folder)
            for command, wanted in pairs:
                done = shell.step(command)
                self.assertTrue(fits(done.stdout, wanted), f"$ {command}\n{done.stdout}\nis not\n" + "\n".join(wanted))
                # A fault is shown once, with its message.
                self.assertEqual(done.returncode, 1 if any(line.startswith("file: ") for line in wanted) else 0, command)
            self.assertTrue(os.path.getsize(os.path.join(folder, "garden-wall", "report.html")) > 10000)
            self.assertTrue(os.path.getsize(os.path.join(folder, "column", "report.html")) > 10000)


class NewCases(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.shell = Shell(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def testEveryKindIsComputed(self):
        kinds = sorted(os.listdir(os.path.join(root, "etc", "cases")))
        self.assertGreaterEqual(len(kinds), 6)
        for kind in kinds:
            done = self.shell.step(f"drystone-new {kind}")
            self.assertEqual(done.returncode, 0, done.stdout)
            # The commands that it prints.
            commands = re.findall(r"^  (\w.*?)(?: +#.*)?$", done.stdout.partition("Compute it:")[2], re.MULTILINE)
            self.assertEqual(len(commands), 4, done.stdout)
            for command in commands:
                done = self.shell.step(command)
                self.assertEqual(done.returncode, 0, f"{kind}: {command}\n{done.stdout[-2000:]}")
                self.assertNotIn("WARNING", done.stdout, kind)
            self.assertTrue("Status: optimal" in done.stdout or "Wrote the state" in done.stdout, done.stdout[-2000:])
            self.shell.step("cd ..")

    def testRefusesWhatItCannotDo(self):
        self.assertEqual(self.shell.step("drystone-new garden-wall wall").returncode, 0)
        self.assertTrue(os.path.exists(os.path.join(self.folder.name, "wall", "system", "blockTextureDict")))
        for command, message in (("drystone-new arch wall", "wall exists already"), ("drystone-new", "no kind of case"),
                                 ("drystone-new pyramid", "unknown kind pyramid"), ("drystone-new arch a b", "too many: b"),
                                 ("drystone-new ../tools t", "unknown kind ../tools"), ("drystone-new -dict x", "-dict")):
            done = self.shell.step(command)
            self.assertEqual(done.returncode, 1, command)
            self.assertIn(message, done.stdout)
        with open(os.path.join(self.folder.name, "wall", "system", "blockTextureDict"), encoding="utf-8") as file:
            self.assertIn("garden wall", file.read())


if __name__ == "__main__":
    unittest.main()
