#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""contactDynamics killed (kill -9) at random times and started again: the files are complete and correct, at most the
steps since the last write are lost, and those during that write if it was still in progress, and the end is that of an
uninterrupted run, bit for bit. What the steps called for with `selection automatic` is on the disk for all of them.

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
from shakenWall import end, interval, step

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


def rowsOf(case, function="energy"):
    """Rows of a table over all starts, the later start taking precedence where they overlap."""
    rows = {}
    folder = os.path.join(case, "postProcessing", function)
    for start in sorted(os.listdir(folder), key=float):
        rows = {instant: row for instant, row in rows.items() if float(instant) <= float(start) + step / 2}
        with open(os.path.join(folder, start, function + ".dat"), encoding="utf-8") as file:
            for line in file:
                if not line.startswith("#") and line.endswith("\n"):
                    rows[line.split()[0]] = line
    return rows


def expectEffectsOfAllSteps(root, base):
    """A run with `selection automatic` that is killed keeps what its steps called for up to the last state, and the run
    that goes on says that its closing lines begin there."""
    whole, case = os.path.join(root, "wholeAutomatic"), os.path.join(root, "automatic")
    for folder in (whole, case):
        shutil.copytree(base, folder)
        with open(os.path.join(folder, "system/schemes"), "w", encoding="utf-8") as file:
            file.write(shakenWall.header % "schemes" + "effects { selection automatic; }\n")
    said = shakenWall.run(applications, "contactDynamics", whole)
    if "went on from" in said:
        sys.exit("a run from the beginning says that it went on:\n" + said[-2000:])
    with subprocess.Popen([os.path.join(applications, "contactDynamics"), "-case", case], stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL) as process:
        while process.poll() is None and not os.path.isdir(os.path.join(case, "0.3")):
            time.sleep(0.001)
        process.kill()
    last = times(case)[-1]
    if float(last) > end - step:
        return  # was not stopped in time
    said = shakenWall.run(applications, "contactDynamics", case)
    if f"went on from {last} s" not in said:
        sys.exit(f"a run that went on from {last} s does not say so:\n" + said[-2000:])
    expected, found = rowsOf(whole, "effects"), rowsOf(case, "effects")
    if len(expected) != round(end / step) or found != expected:
        sys.exit(f"effects.dat has {len(found)} steps after a run that was killed and went on, {len(expected)} of one run")


with tempfile.TemporaryDirectory() as root:
    base = os.path.join(root, "base")
    shakenWall.make(applications, base)
    reference = os.path.join(root, "reference")
    shutil.copytree(base, reference)
    began = time.monotonic()
    shakenWall.run(applications, "contactDynamics", reference)
    length = time.monotonic() - began
    wholeEnergy = rowsOf(reference)
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
        if rowsOf(case) != wholeEnergy:
            sys.exit(f"{what}: went on, and energy.dat is another")
        shutil.rmtree(case)
    print(f"{runs} runs of {length:.2f} s killed: {max(lost)} steps lost at most ({interval / step:.0f} between writes), "
          f"{early} killed before the first write, {late} after the end")
    expectEffectsOfAllSteps(root, base)
