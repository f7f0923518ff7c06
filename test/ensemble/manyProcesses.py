#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""ensemble at length: fifty random kills, sixty-four programs in one folder, recorded motions of the ground.

manyProcesses.py BIN CASE       CASE: the tutorial masonryPanels
"""
import glob
import os
import random
import shutil
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
sys.path.insert(0, os.path.dirname(__file__))
from caseTest import applications, tutorial
import ensemble

records = os.path.join(tutorial, "../../../../shared/records")


class ManyProcesses(ensemble.Ensemble):
    def testFiftyKillsLoseNothing(self):
        case = self.case("fifty", samples=4000)
        random.seed(2)
        kills = 0
        processes = []
        while kills < 50:
            processes = [process for process in processes if process.poll() is None]
            while len(processes) < 2:
                # Two programs, with two workers each, that know nothing of each other but the folder.
                environment = {**os.environ, "PMI_RANK": str(len(processes)), "PMI_SIZE": "2"}
                processes.append(subprocess.Popen([os.path.join(applications, "ensemble"), "-case", case, "-parallel",
                                                   "-jobs", "2"], env=environment, stdout=subprocess.DEVNULL,
                                                  stderr=subprocess.DEVNULL))
            time.sleep(random.uniform(0.02, 0.4))
            alive = [process.pid for process in processes if process.poll() is None]
            victims = alive + [child for pid in alive for child in self.childrenOf(pid)]
            if victims:
                try:
                    os.kill(random.choice(victims), random.choice([signal.SIGKILL, signal.SIGSEGV]))
                except ProcessLookupError:
                    continue
            kills += 1
        for process in processes:
            process.kill()
            process.wait()
        self.run_(case, "-jobs", "3")
        alone = self.case("undisturbed", samples=4000)
        self.run_(alone, "-jobs", "2")
        self.assertEqual(len(self.table(case)), 4001)
        self.assertEqual(self.digest(case), self.digest(alone))

    def testSixtyFourProgramsShareSleepingSamples(self):
        ranks, each, nap = 64, 12, 2.0
        case = self.case("ranks", applications='"./nap"', samples=ranks * each, statistics="")
        script = os.path.join(case, "nap")
        with open(script, "w", encoding="utf-8") as file:
            file.write("#!/bin/bash\nmkdir -p postProcessing/limitAnalysis/0\n"
                       "printf '# alpha[-]\\n1\\n' > postProcessing/limitAnalysis/0/limitAnalysis.dat\n"
                       f"exec sleep {nap}\n")
        os.chmod(script, 0o755)
        begin = time.monotonic()
        processes = []
        for rank in range(ranks):
            environment = {**os.environ, "OMPI_COMM_WORLD_RANK": str(rank), "OMPI_COMM_WORLD_SIZE": str(ranks)}
            processes.append(subprocess.Popen([os.path.join(applications, "ensemble"), "-case", case, "-parallel"],
                                              env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        self.assertEqual({process.wait() for process in processes}, {0})
        elapsed = time.monotonic() - begin
        efficiency = each * nap / elapsed
        print(f"{ranks} programs, {ranks * each} samples of {nap} s: {elapsed:.1f} s, efficiency {efficiency:.3f}")
        self.assertEqual(len(self.table(case)), ranks * each + 1)
        self.assertGreater(efficiency, 0.8)  # 0.9 on a machine that does nothing else

    @unittest.skipUnless(os.path.isdir(records), "the recorded motions are not on this machine")
    def testAPanelUnderRecordedMotions(self):
        names = sorted(glob.glob(os.path.join(records, "*.[Aa][Tt]2")))[:6]
        for flowRule in ("associative", "nonAssociative"):
            case = os.path.join(self.root.name, "recorded" + flowRule)
            shutil.copytree(os.path.join(tutorial, "../../ensemble/panel", flowRule), case,
                            ignore=shutil.ignore_patterns("postProcessing", "log.*"))
            dictionary = os.path.join(case, "system/ensembleDict")
            with open(dictionary, encoding="utf-8") as file:
                text = file.read()
            begin, end = text.index('"constant/records/synthetic1.csv"'), text.index("            );")
            with open(dictionary, "w", encoding="utf-8") as file:
                file.write(text[:begin] + " ".join(f'"{os.path.abspath(name)}"' for name in names) + "\n" + text[end:])
            motion = os.path.join(case, "constant/groundMotion")
            with open(motion, encoding="utf-8") as file:
                text = file.read()
            with open(motion, "w", encoding="utf-8") as file:
                file.write(text.replace("csv;", "PEER_AT2;"))
            control = os.path.join(case, "system/controlDict")
            with open(control, encoding="utf-8") as file:
                text = file.read()
            with open(control, "w", encoding="utf-8") as file:
                file.write(text.replace("endTime         7;", "endTime         40;"))
            done = subprocess.run([os.path.join(applications, "ensemble"), "-case", case], capture_output=True, text=True,
                                  timeout=1500, check=False)
            self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
            begin = done.stdout.index("CPU time")
            print(flowRule, done.stdout[begin - 40:done.stdout.index("fractiles")])
            self.assertRegex(done.stdout, r"theta = [0-9.]+, standard error")


if __name__ == "__main__":
    suite = unittest.TestSuite([ManyProcesses(name) for name in
                                (sys.argv[3:] or ("testFiftyKillsLoseNothing",
                                                  "testSixtyFourProgramsShareSleepingSamples",
                                                  "testAPanelUnderRecordedMotions"))])
    sys.exit(0 if unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful() else 1)
