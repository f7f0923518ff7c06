# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""runApplication of etc/tools/RunFunctions, by which Allrun of a tutorial begins where it ended: only a run that came to its
end is not repeated. Its applications are scripts of this test."""
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

functions = os.path.join(os.path.abspath(sys.argv.pop(1)), "etc/tools/RunFunctions")


class RunFunctions(unittest.TestCase):
    def setUp(self):
        self.root = tempfile.TemporaryDirectory()
        self.folder = os.path.join(self.root.name, "a case")
        os.mkdir(self.folder)
        self.application("slow", "echo begun; echo >runs.$$; while [ -f wait ]; do sleep 0.02; done; echo End")
        self.application("fails", "head -c 5000 /dev/zero | tr '\\0' '.' || exit 1; exit 3")

    def tearDown(self):
        self.root.cleanup()

    def application(self, name, text):
        path = os.path.join(self.root.name, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(f"#!/bin/bash\n{text}\n")
        os.chmod(path, 0o755)

    def start(self, script):
        return subprocess.Popen(["bash", "-c", f'. "{functions}"\n{script}'], cwd=self.folder, text=True, start_new_session=True,
                                env={"PATH": "/usr/bin:/bin", "DRYSTONE_BIN": self.root.name}, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE)

    def run_(self, script):
        process = self.start(script)
        output, errors = process.communicate(timeout=60)
        return process.returncode, output, errors

    def runs(self):
        return len([name for name in os.listdir(self.folder) if name.startswith("runs.")])

    def testWhatIsDoneIsNotRepeated(self):
        self.assertEqual(self.run_("runApplication slow")[0], 0)
        status, output, _ = self.run_("runApplication slow")
        self.assertEqual((status, self.runs()), (0, 1))
        self.assertIn("already run", output)
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith("log.")], ["log.slow"])

    def testARunThatASignalEndedIsRepeated(self):
        for number, end in enumerate((signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL), 1):
            with self.subTest(end=end.name):
                with open(os.path.join(self.folder, "wait"), "w", encoding="utf-8"):
                    pass
                process = self.start("runApplication slow")
                deadline = time.monotonic() + 10
                while self.runs() < 2 * number - 1 and time.monotonic() < deadline:
                    time.sleep(0.01)
                os.killpg(process.pid, end)
                process.communicate(timeout=60)
                self.assertNotEqual(process.returncode, 0)
                os.remove(os.path.join(self.folder, "wait"))
                status, output, _ = self.run_("runApplication slow")
                self.assertEqual((status, self.runs()), (0, 2 * number), output)
                self.assertIn("already run", self.run_("runApplication slow")[1])
                os.remove(os.path.join(self.folder, "log.slow"))

    def testARunThatFailedIsRepeated(self):
        for _ in range(2):
            status, output, errors = self.run_("runApplication fails")
            self.assertEqual(status, 3, errors)
            self.assertIn("Running fails", output)
            self.assertIn("fails failed", errors)

    def testARunWithoutRoomForItsLogIsRepeated(self):
        # A limit of the size of files is like a full disk: here the log has room for some of it, not for the mark of a failure.
        for _ in range(2):
            status, output, _ = self.run_("trap '' XFSZ; ulimit -f 4\nrunApplication fails")
            self.assertNotEqual(status, 0)
            self.assertIn("Running fails", output)

    def testAFolderThatIsNotWritableIsNamed(self):
        status, output, errors = self.run_("runApplication slow -case /proc/self")
        self.assertEqual((status, output, self.runs()), (1, "", 0))
        self.assertIn("/proc/self/log.slow.unfinished cannot be written", errors)
        self.assertIn("Run a copy of your own", errors)


if __name__ == "__main__":
    unittest.main()
