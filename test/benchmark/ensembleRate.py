#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""The rate of ensemble: 100,000 limit analyses of wall 1 with friction and unit length uncertain (Latin hypercube), and
10,000 of wall 6, which has five times the blocks, with friction uncertain: their blocks are the same in all samples, so that
they are solved several at once. The same one by one, as where the iterations of a solution are asked for besides.

    ensembleRate.py [BIN] [--samples N] [--rounds N] [--out FILE]

BIN defaults to build/bin; --samples are those of wall 1. One process, then two, in turn, as often as --rounds says; the
least time of each. Prints samples a second, the efficiency of two processes (time of one over twice the time of two) and
the largest memory of a process, and checks that the table of samples is the same, md5 for md5, but for the CPU times.
"""
import argparse
import csv
import hashlib
import os
import platform
import resource
import shutil
import subprocess
import sys
import tempfile
import time

root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
ensembleDict = """FoamFile { version 2.0; format ascii; class dictionary; object ensembleDict; }
applications (blockTexture limitAnalysis);
variables
{
    mu { file "constant/contactProperties"; entry "friction/mu";
         distribution { type lognormal; median 0.65; beta 0.15; minimum 0.2; maximum 1.2; } }
    %s
}
design { type latinHypercube; samples %d; seed 1; }
results { alpha { table "postProcessing/limitAnalysis/0/limitAnalysis.dat"; column alpha; } %s }
statistics { capacity { type distribution; value alpha; } }
"""

iterations = """its { table "postProcessing/limitAnalysis/0/limitAnalysis.dat"; column iterations; }"""

unit = """unit { file "system/blockTextureDict"; entry "unitLength";
           distribution { type uniform; minimum 0.35; maximum 0.45; } }"""


def makeCase(folder, wall, samples, more=""):
    shutil.copytree(os.path.join(root, "tutorials/limitAnalysis/masonryPanels", wall), folder)
    texture = os.path.join(folder, "system/blockTextureDict")
    with open(texture, encoding="utf-8") as file:
        text = file.read()
    changed = text.replace("dimensions      2;", "dimensions      2;\nunitLength 0.4;").replace(
        "(0.4 0.175)", "($unitLength 0.175)")
    if "$unitLength" not in changed or "\nunitLength" not in changed:
        sys.exit(f"ensembleRate.py: {wall}/system/blockTextureDict is not as it was")
    with open(texture, "w", encoding="utf-8") as file:
        file.write(changed)
    with open(os.path.join(folder, "system/ensembleDict"), "w", encoding="utf-8") as file:
        file.write(ensembleDict % (unit if wall == "wall1" else "", samples, more))


def run(binaries, wall, samples, jobs, more=""):
    """Clock [s], digest of the table, largest memory of a process [MB]."""
    with tempfile.TemporaryDirectory() as scratch:
        case = os.path.join(scratch, wall)
        makeCase(case, wall, samples, more)
        begin = time.monotonic()
        subprocess.run([os.path.join(binaries, "ensemble"), "-case", case, "-jobs", str(jobs)], check=True,
                       stdout=subprocess.DEVNULL)
        elapsed = time.monotonic() - begin
        with open(os.path.join(case, "postProcessing/ensemble/0/samples.dat"), encoding="utf-8") as file:
            rows = [line.split() for line in file]
        column = next(i for i, name in enumerate(rows[0][1:]) if name.startswith("cpuTime"))
        if len(rows) != samples + 1:
            sys.exit(f"ensembleRate.py: {len(rows) - 1} rows of {samples}")
        table = "\n".join(" ".join(row[:column] + row[column + 1:]) for row in rows[1:])
        # Of the largest of all children that have ended, grandchildren among them.
        return elapsed, hashlib.md5(table.encode()).hexdigest(), resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1e3


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        return next((line.split(":")[1].strip() for line in file if line.startswith("model name")), "unknown CPU")


def rowsOf(options, wall, samples, more=""):
    least, digests, memory = {1: float("inf"), 2: float("inf")}, set(), 0
    for _ in range(options.rounds):
        for jobs in least:
            elapsed, digest, memory = run(options.bin, wall, samples, jobs, more)
            least[jobs] = min(least[jobs], elapsed)
            digests.add(digest)
    if len(digests) != 1:
        sys.exit("ensembleRate.py: the tables differ")
    case = wall + (" one by one" if more else "")
    return [{"case": case, "processes": jobs, "samples": samples, "clock[s]": f"{clock:.2f}",
             "samples/s": f"{samples / clock:.0f}", "efficiency": f"{least[1] / jobs / clock:.3f}",
             "memory[MB]": f"{memory:.0f}"} for jobs, clock in least.items()]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", nargs="?", default=os.path.join(root, "build/bin"))
    parser.add_argument("--samples", type=int, default=100000)
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--out")
    options = parser.parse_args()
    rows = (rowsOf(options, "wall1", options.samples) + rowsOf(options, "wall6", options.samples // 10)
            + rowsOf(options, "wall6", options.samples // 10, iterations))
    head = f"# {processor()}, {platform.system()} {platform.release()}, {os.cpu_count()} cores"
    for row in rows:
        print(", ".join(f"{name} {value}" for name, value in row.items()))
    print(head[2:])
    if options.out:
        with open(options.out, "w", encoding="utf-8", newline="") as file:
            file.write(head + "\n")
            table = csv.DictWriter(file, list(rows[0]))
            table.writeheader()
            table.writerows(rows)


if __name__ == "__main__":
    main()
