#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""ensemble under a real Slurm on this machine: srun, and a job array of which one task is requeued in the middle.

slurm.py BIN CASE       CASE: the tutorial masonryPanels

Brings up munged, slurmctld and slurmd of Debian as the user who runs it, in a temporary folder and on free ports,
without systemd and accounting, and ends them. Skipped (exit status 77) where these are not installed.
"""
import getpass
import os
import shutil
import socket
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
sys.path.insert(0, os.path.dirname(__file__))
from caseTest import applications
import ensemble

os.environ["PATH"] += ":/usr/sbin"
needed = ["munged", "slurmctld", "slurmd", "sbatch", "srun", "scontrol", "squeue"]

configuration = """
ClusterName=drystone
SlurmctldHost=%(host)s(127.0.0.1)
SlurmUser=%(user)s
SlurmdUser=%(user)s
SlurmctldPort=%(port)d
SlurmdPort=%(nodePort)d
AuthType=auth/munge
AuthInfo=socket=%(folder)s/munge.socket
CredType=cred/munge
StateSaveLocation=%(folder)s/state
SlurmdSpoolDir=%(folder)s/spool
SlurmctldPidFile=%(folder)s/slurmctld.pid
SlurmdPidFile=%(folder)s/slurmd.pid
SlurmctldLogFile=%(folder)s/slurmctld.log
SlurmdLogFile=%(folder)s/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
ReturnToService=2
KillWait=2
SlurmdParameters=config_overrides
NodeName=%(host)s NodeAddr=127.0.0.1 CPUs=2 Boards=1 SocketsPerBoard=1 CoresPerSocket=2 ThreadsPerCore=1 State=UNKNOWN
PartitionName=all Nodes=%(host)s Default=YES MaxTime=INFINITE State=UP
"""


def freePort():
    with socket.socket() as opened:
        opened.bind(("127.0.0.1", 0))
        return opened.getsockname()[1]


class Slurm(ensemble.Ensemble):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = os.path.join(cls.root.name, "slurm")
        for name in ("", "state", "spool"):
            os.makedirs(os.path.join(folder, name), mode=0o755)
        cls.folder = folder
        with open(os.path.join(folder, "munge.key"), "wb") as file:
            file.write(os.urandom(1024))
        os.chmod(os.path.join(folder, "munge.key"), 0o600)
        with open(os.path.join(folder, "slurm.conf"), "w", encoding="utf-8") as file:
            file.write(configuration % {"host": socket.gethostname().split(".")[0], "user": getpass.getuser(),
                                        "port": freePort(), "nodePort": freePort(), "folder": folder})
        os.environ["SLURM_CONF"] = os.path.join(folder, "slurm.conf")
        cls.daemons = []
        cls.daemon("munged", "--foreground", "--force", f"--socket={folder}/munge.socket",
                   f"--key-file={folder}/munge.key", f"--pid-file={folder}/munge.pid",
                   f"--log-file={folder}/munge.log", f"--seed-file={folder}/munge.seed")
        cls.waitUntil(lambda: os.path.exists(f"{folder}/munge.socket"), 10)
        cls.daemon("slurmctld", "-D", "-c")
        cls.daemon("slurmd", "-D", "-c")
        if not cls.waitUntil(lambda: "idle" in cls.output("sinfo", "-h", "-o", "%T"), 30):
            logs = "".join(open(os.path.join(folder, name), encoding="utf-8", errors="replace").read()[-1500:]
                           for name in ("munge.log", "slurmctld.log", "slurmd.log")
                           if os.path.exists(os.path.join(folder, name)))
            cls.tearDownClass()
            raise unittest.SkipTest("Slurm does not come up on this machine:\n" + logs)

    @classmethod
    def tearDownClass(cls):
        for process in reversed(cls.daemons):
            process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        super().tearDownClass()

    @classmethod
    def daemon(cls, *command):
        cls.daemons.append(subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))

    @staticmethod
    def waitUntil(condition, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if condition():
                return True
            time.sleep(0.1)
        return False

    @staticmethod
    def output(*command):
        return subprocess.run(command, capture_output=True, text=True, timeout=60, check=False).stdout

    def testSrunSharesTheSamples(self):
        case = self.case("srun")
        done = subprocess.run(["srun", "-n", "2", os.path.join(applications, "ensemble"), "-case", case, "-parallel"],
                              capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(self.digest(case), self.reference())

    def testATaskOfAnArrayMayBeRequeued(self):
        case = self.case("array", samples=3000)
        done = self.run_(case, "-submit", "--array=1-2 --time=10")
        job, merge = [word.rstrip(",") for word in done.stdout.split("Submitted job")[1].split() if
                      word.rstrip(",").isdigit()][:2]
        self.assertTrue(self.waitUntil(lambda: self.rowsOf(case) > 200, 60), self.output("squeue"))
        requeued = subprocess.run(["scontrol", "requeue", f"{job}_1"], capture_output=True, text=True, check=False)
        self.assertEqual(requeued.returncode, 0, requeued.stderr)
        # A requeued task is held back for a while by Slurm; the merging job waits for it.
        self.assertTrue(self.waitUntil(lambda: merge not in self.output("squeue", "-h", "-o", "%A"), 240),
                        self.output("squeue"))
        log = self.read(case, "postProcessing/ensemble/0/log.ensemble.merge")
        self.assertIn("Samples: 3000 of 3000", log)
        alone = self.case("alone", samples=3000)
        self.run_(alone)
        self.assertEqual(self.digest(case), self.digest(alone))


if __name__ == "__main__":
    missing = [name for name in needed if not shutil.which(name)]
    if missing:
        print("Skipped: not installed:", " ".join(missing), "(etc/bootstrap test installs them)")
        sys.exit(77)
    suite = unittest.TestSuite([Slurm("testSrunSharesTheSamples"), Slurm("testATaskOfAnArrayMayBeRequeued")])
    result = unittest.TextTestRunner().run(suite)
    for _, reason in result.skipped:
        print("Skipped:", reason)
    sys.exit(1 if not result.wasSuccessful() else 77 if result.skipped else 0)
