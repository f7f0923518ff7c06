#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Runs on a disk that becomes full: they end with a message that names the file and the reason, and leave no temporary
file or folder behind. The disk is a tmpfs of some hundred kB, mounted in a namespace of its own; where this is not allowed
the test is skipped (77).

fullDisk.py BIN TUTORIALS
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile

import shakenWall

applications, tutorials = (os.path.abspath(path) for path in sys.argv[1:3])


def mounted(folder, size, commands):
    """Runs commands in a namespace in which a disk of this size is mounted at the folder; then lists what is left."""
    script = f'mount -t tmpfs -o size={size} none "{folder}" && cd "{folder}" && {commands}; status=$?; ' \
             'echo "== left"; find . -name "*.tmp" -o -name ".*.tmp*"; exit $status'
    flags = ["-m"] if os.geteuid() == 0 else ["-r", "-m"]
    return subprocess.run(["unshare", *flags, "bash", "-c", script], capture_output=True, text=True, timeout=300, check=False)


def main():
    with tempfile.TemporaryDirectory() as root:
        disk, case = os.path.join(root, "disk"), os.path.join(root, "case")
        os.mkdir(disk)
        try:
            works = mounted(disk, "100k", "true")
        except FileNotFoundError:
            works = None
        if works is None or works.returncode != 0:
            print("a disk cannot be mounted here (unshare): skipped")
            return 77
        shakenWall.make(applications, case)
        run = os.path.join(applications, "contactDynamics") + " -case case"
        # Full before the run, after some states, and in the course of the frames.
        for size in ("60k", "150k", "400k"):
            done = mounted(disk, size, f'cp -r "{case}" . && {run}')
            print(size, [line for line in done.stderr.splitlines() if "No space" in line])
            assert done.returncode == 1, done.stdout[-500:] + done.stderr
            assert "No space left on device" in done.stderr, done.stderr
            assert "case/" in done.stderr, "the message names no file: " + done.stderr
            left = done.stdout.split("== left\n")[1].split()
            assert not left, f"left behind: {left}"
        # The history of a study is written by the threads that carry out its runs.
        study = os.path.join(root, "study")
        shutil.copytree(os.path.join(tutorials, "incrementalDynamics/space/cornerWalls/structure"), study,
                        ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "assembly", "*.svg"))
        subprocess.run([os.path.join(applications, "blockTexture"), "-case", study], check=True, capture_output=True)
        shutil.rmtree(os.path.join(study, "VTK"))
        size = sum((os.path.getsize(os.path.join(folder, file)) + 4095) // 4096 * 4096
                   for folder, _, files in os.walk(study) for file in files)
        run = os.path.join(applications, "incrementalDynamics") + " -case study"
        for prepare, fault in (("mkdir -p study/postProcessing/incrementalDynamics/0/history.dat", "it is a folder"),
                               ("dd if=/dev/zero of=full bs=4096 2> dd.log; true", "No space left on device")):
            done = mounted(disk, f"{size // 1024 + 60}k", f'cp -r "{study}" . && {{ {prepare}; }} && {run}')
            print("incrementalDynamics", done.returncode, done.stderr.splitlines()[-5:])
            assert done.returncode == 1, done.stdout[-500:] + done.stderr
            assert "Cannot write study/" in done.stderr and fault in done.stderr, done.stderr
        # A search takes no value for a point whose application had no room, `otherwise` neither, and goes on from there.
        search = os.path.join(root, "search")
        shutil.copytree(os.path.join(tutorials, "parameterSearch/liveLoadDirection"), search,
                        ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "assembly", "parameterSearch"))
        run = os.path.join(applications, "parameterSearch") + " -case search"
        done = mounted(disk, "200k", f'cp -r "{search}" . && {run}; status=$?; mount -o remount,size=20m . && {run} > again; '
                       'grep "^    angle" again; (exit $status)')
        print("parameterSearch", done.returncode, done.stderr.splitlines()[-5:])
        assert done.returncode == 1, done.stdout[-500:] + done.stderr
        assert "ended with exit status 1" in done.stderr and "Make room on the disk" in done.stderr, done.stderr
        assert "Evaluation 1:" not in done.stdout and "angle = 147.26" in done.stdout, done.stdout
        # Journals of an ensemble that do not fit: the worker that finds it has no room either to say so in its file.
        ensemble = os.path.join(root, "ensemble")
        shutil.copytree(os.path.join(tutorials, "limitAnalysis/masonryPanels/wall1"), ensemble,
                        ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "assembly"))
        with open(os.path.join(ensemble, "system/ensembleDict"), "w", encoding="utf-8") as file:
            file.write("""applications (blockTexture limitAnalysis);
variables { seed { file "constant/contactProperties"; entry "friction/mu";
                   distribution { type uniform; minimum 0.5; maximum 0.7; } } }
design { type random; samples 8000; }
results { alpha { table "postProcessing/limitAnalysis/0/limitAnalysis.dat"; column alpha; } }
""")
        run = os.path.join(applications, "ensemble") + " -case ensemble -jobs 2"
        done = mounted(disk, "200k", f'cp -r "{ensemble}" . && {run}')
        print("ensemble", done.returncode, done.stderr.splitlines()[-7:])
        assert done.returncode == 1, done.stdout[-500:] + done.stderr
        assert "A worker process cannot go on" in done.stderr, done.stderr
        assert re.search(r"Cannot write ensemble/\S*/journal\.\S*: No space left on device", done.stderr), done.stderr
        # On a disk that has room the run ends well.
        run = os.path.join(applications, "contactDynamics") + " -case case"
        done = mounted(disk, "200m", f'cp -r "{case}" . && {run}')
        assert done.returncode == 0, done.stderr
    return 0


if __name__ == "__main__":
    sys.exit(main())
