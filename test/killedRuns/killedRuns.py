#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""contactDynamics killed (kill -9) at random times and started again: the files are complete and correct, at most the
steps since the last write are lost, and those during that write if it was still in progress, and the end is that of an
uninterrupted run, bit for bit.

killedRuns.py BIN RUNS [SEED]
"""
import filecmp
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

import shakenWall
from shakenWall import interval, step

applications, runs = sys.argv[1], int(sys.argv[2])
seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1

def times(case):
    return sorted((name for name in os.listdir(case) if re.fullmatch(r"[0-9]+(\.[0-9]+)?", name)), key=float)


def expectWrittenAsIn(reference, case, what):
    """Each state on disk is that of the reference, to the last byte."""
    for instant in times(case):
        folder = os.path.join(case, instant)
        for name in os.listdir(folder):
            if not filecmp.cmp(os.path.join(folder, name), os.path.join(reference, instant, name), shallow=False):
                sys.exit(f"{what}: {instant}/{name} is not that of the uninterrupted run")


def lastTime(log):
    found = re.findall(r"^Time = (\S+)", log, re.M)
    return float(found[-1]) if found else 0


def energies(case):
    """Rows of energy.dat over all starts, the later start taking precedence where they overlap."""
    rows = {}
    folder = os.path.join(case, "postProcessing/energy")
    for start in sorted(os.listdir(folder), key=float):
        rows = {instant: row for instant, row in rows.items() if float(instant) <= float(start) + step / 2}
        with open(os.path.join(folder, start, "energy.dat"), encoding="utf-8") as file:
            for line in file:
                if not line.startswith("#") and line.endswith("\n"):
                    rows[line.split()[0]] = line
    return rows


with tempfile.TemporaryDirectory() as root:
    base = os.path.join(root, "base")
    shakenWall.make(applications, base)
    reference = os.path.join(root, "reference")
    shutil.copytree(base, reference)
    began = time.monotonic()
    shakenWall.run(applications, "contactDynamics", reference)
    length = time.monotonic() - began
    wholeEnergy = energies(reference)
    whole = times(reference)
    chance = random.Random(seed)
    lost, early, late = [], 0, 0
    for number in range(1, runs + 1):
        case = os.path.join(root, "killed")
        shutil.copytree(base, case)
        delay = chance.uniform(0, length)
        what = f"run {number} of seed {seed}, killed after {delay:.3f} s"
        with open(os.path.join(root, "log"), "w+", encoding="utf-8") as log:
            process = subprocess.Popen([os.path.join(applications, "contactDynamics"), "-case", case], stdout=log,
                                       stderr=subprocess.STDOUT)
            time.sleep(delay)
            process.kill()
            process.wait()
            log.seek(0)
            reached = lastTime(log.read())
        late += process.returncode == 0
        written = times(case)
        latest = float(written[-1]) if written else 0
        early += latest == 0
        expectWrittenAsIn(reference, case, what)
        # States are written while the run steps on, each before the next one begins: the last one may be in progress.
        # A step of rounding; and the step in hand when it was killed may have been logged before it was written.
        if reached - latest > 2 * interval + 1.5 * step:
            sys.exit(f"{what}: had come to {reached:g} s, and only {latest:g} s was written")
        lost.append(max(0, round((reached - latest) / step)))
        again = shakenWall.run(applications, "contactDynamics", case)
        first = re.search(r"^Time = (\S+)", again, re.M)
        if first and not 0 < float(first.group(1)) - latest < 1.5 * step:
            sys.exit(f"{what}: went on at {first.group(1)} s from {latest:g} s")
        expectWrittenAsIn(reference, case, what + ", and gone on")
        if times(case) != whole:
            sys.exit(f"{what}: went on, and wrote other times: {times(case)}")
        if energies(case) != wholeEnergy:
            sys.exit(f"{what}: went on, and energy.dat is another")
        shutil.rmtree(case)
    print(f"{runs} runs of {length:.2f} s killed: {max(lost)} steps lost at most ({interval / step:.0f} between writes), "
          f"{early} killed before the first write, {late} after the end")
