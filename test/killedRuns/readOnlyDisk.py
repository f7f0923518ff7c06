#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Cases on a disk that cannot be written on: `-dry-run` checks them as anywhere else, and a run ends with a message that
names the file and the reason. The disk is a folder mounted read-only in a namespace of its own; where this is not allowed
the test is skipped (77).

readOnlyDisk.py BIN TUTORIALS
"""
import os
import shutil
import subprocess
import sys
import tempfile

applications, tutorials = (os.path.abspath(path) for path in sys.argv[1:3])
# Each application, and a case for it.
cases = {"blockTexture": "limitAnalysis/masonryPanels/wall1", "limitAnalysis": "limitAnalysis/masonryPanels/wall1",
         "contactDynamics": "contactDynamics/fallingWall/wall", "accuracyCost": "accuracyCost/masonryPanel/wall",
         "incrementalDynamics": "incrementalDynamics/space/cornerWalls/structure", "ensemble": "ensemble/wall6",
         "parameterSearch": "parameterSearch/archThickness/stands"}


def mounted(folder, command):
    """Runs a command in a namespace in which the folder is mounted read-only."""
    script = f'mount --bind "{folder}" "{folder}" && mount -o remount,bind,ro "{folder}" && exec {command}'
    flags = ["-m"] if os.geteuid() == 0 else ["-r", "-m"]
    return subprocess.run(["unshare", *flags, "bash", "-c", script], capture_output=True, text=True, timeout=300, check=False)


def main():
    with tempfile.TemporaryDirectory() as root:
        try:
            works = mounted(root, "true")
        except FileNotFoundError:
            works = None
        if works is None or works.returncode != 0:
            print("a disk cannot be mounted here (unshare): skipped")
            return 77
        for application, tutorial in cases.items():
            case = os.path.join(root, application)
            shutil.copytree(os.path.join(tutorials, tutorial), case, ignore=shutil.ignore_patterns(
                "VTK", "postProcessing", "log.*", "assembly", "*.svg"))
            if application not in ("blockTexture", "ensemble"):
                subprocess.run([os.path.join(applications, "blockTexture"), "-case", case], check=True, capture_output=True)
            before = sorted(os.walk(case))
            done = mounted(root, f'{os.path.join(applications, application)} -case "{case}" -dry-run')
            print(application, "-dry-run", done.returncode)
            assert done.returncode == 0, application + done.stdout[-500:] + done.stderr
            assert done.stdout.rstrip().endswith("End"), done.stdout[-500:]
            done = mounted(root, f'{os.path.join(applications, application)} -case "{case}"')
            print(application, done.returncode, [line for line in done.stderr.splitlines() if "ead-only" in line])
            assert done.returncode == 1, application + done.stdout[-500:] + done.stderr
            assert "Read-only file system" in done.stderr, done.stderr
            assert case in done.stderr, "the message names no file: " + done.stderr
            assert sorted(os.walk(case)) == before, "something was left"
    return 0


if __name__ == "__main__":
    sys.exit(main())
