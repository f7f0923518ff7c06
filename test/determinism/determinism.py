#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Runs cases with one thread, with two and with four, and with each dense kernel, and compares all their files. Four
are those of controlDict (nThreads), the others of the environment.

    determinism.py small|large BIN TUTORIALS

small: wall 6 and square walls of 40 and 60 units in limit analysis, wall 1 in collapse, a square wall of 40 units for two
steps. large: a square wall of 160 units. Of the results only CPU times may differ, and between kernels of different
processors the last digits.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

size, applications, tutorials = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])

squareWall = """
dimensions 2;
texture
{{
    type runningBond; unit (0.4 0.175); thickness 1; length {0}; courses {0}; firstCourse full;
}}
supports {{ ground {{ type ground; segment 0.5; }} }}
"""


def run(application, case, threads, kernel=""):
    """False where this processor has not got the kernel."""
    environment = {**os.environ, "DRYSTONE_KERNEL": kernel, "OMP_NUM_THREADS": str(threads)}
    if threads == 4:
        environment["OMP_NUM_THREADS"] = "3"
        control = case / "system/controlDict"
        control.write_text(control.read_text(encoding="utf-8") + "nThreads 4;\n", encoding="utf-8")
    done = subprocess.run([applications / application, "-case", case], env=environment, capture_output=True, text=True,
                          check=False)
    if kernel and "DRYSTONE_KERNEL" in done.stderr:
        return False
    if done.returncode != 0:
        sys.exit(f"{application} failed with {threads} threads:\n{done.stdout[-2000:]}{done.stderr}")
    if application != "blockTexture" and f"Threads: {threads}, dense kernel: {kernel}" not in done.stdout:
        sys.exit(f"{application} does not have {threads} threads and the kernel {kernel}:\n{done.stdout[:2000]}")
    return True


def results(case):
    """Content of every file but controlDict, with the CPU time of limitAnalysis.dat left out."""
    found = {}
    for file in sorted(case.rglob("*")):
        if file.is_file() and file.name != "controlDict":
            content = file.read_bytes()
            if file.name == "limitAnalysis.dat":
                content = re.sub(rb" \S+$", b"", content, flags=re.MULTILINE)
            found[str(file.relative_to(case))] = content
    return found


def compare(name, source, application, edits, root):
    """Prepares a case, runs it four times, compares; then three times with each kernel."""
    for kernel in ("", "avx512", "avx2", "baseline"):
        if not compareRuns(name, source, application, edits, root, kernel):
            print(f"{name}: no kernel {kernel} on this processor")


def compareRuns(name, source, application, edits, root, kernel):
    seen = None
    for threads in (1, 2, 4) if kernel else (1, 2, 1, 4):
        # Under the same name each time: results may hold the name of their case.
        case = root / name
        shutil.rmtree(case, ignore_errors=True)
        shutil.copytree(source, case, ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "assembly"))
        for file, text in edits.items():
            (case / file).write_text(text, encoding="utf-8")
        run("blockTexture", case, 1)
        if not run(application, case, threads, kernel):
            return False
        now = results(case)
        if seen is None:
            seen = now
            continue
        different = sorted(file for file in seen.keys() | now.keys() if seen.get(file) != now.get(file))
        if different:
            sys.exit(f"{name}: with {threads} threads these files are not what they were: {' '.join(different)}")
    # No test of nothing.
    wanted = {"limitAnalysis": "postProcessing/limitAnalysis/0/coneProgram",
              "contactDynamics": "0.04/state"}[application]
    if wanted not in seen:
        sys.exit(f"{name}: {wanted} is missing among {' '.join(seen)}")
    print(f"{name}: {len(seen)} files, the same with one thread, two and four" + (f", kernel {kernel}" if kernel else ""))
    return True


with tempfile.TemporaryDirectory() as folder:
    root = pathlib.Path(folder)
    # Dictionaries of motion are shared by its walls.
    shutil.copytree(tutorials / "contactDynamics/masonryPanels/common", root / "contactDynamics/common")
    (root / "limitAnalysis").mkdir()
    solution = {"system/solution": "limitAnalysis { tolerance 1e-8; writeProgram always; }\n"}
    panels = tutorials / "limitAnalysis/masonryPanels"
    if size == "small":
        compare("wall6", panels / "wall6", "limitAnalysis", solution, root / "limitAnalysis")
        compare("square60", panels / "wall6", "limitAnalysis",
                {**solution, "system/blockTextureDict": squareWall.format(60)}, root / "limitAnalysis")
        compare("square40", panels / "wall6", "limitAnalysis",
                {**solution, "system/blockTextureDict": squareWall.format(40)}, root / "limitAnalysis")
        control = ("application contactDynamics; startFrom startTime; startTime 0; endTime 0.04; deltaT 0.002;\n"
                   "writeControl timeStep; writeInterval 10;\nfunctions { energy { } residuals { } }\n")
        compare("wall1", tutorials / "contactDynamics/masonryPanels/wall1", "contactDynamics",
                {"system/controlDict": control, "system/solution": "contactDynamics { writeProgram always; }\n"},
                root / "contactDynamics")
    else:
        compare("square160", panels / "wall6", "limitAnalysis",
                {**solution, "system/blockTextureDict": squareWall.format(160)}, root / "limitAnalysis")
