#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""The clock time of small runs from start to exit: limitAnalysis on walls 1 and 6 with its results written, and
contactDynamics on the same walls standing (500 steps) with frames and states every 10 steps and without.

    smallRuns.py [BIN ...] [--rounds N] [--folder FOLDER] [--out FILE]

BIN defaults to build/bin; several are measured in turn, which is how two versions are compared. The least time of all
rounds is printed. --folder is where the cases are made (default: the temporary folder; /dev/shm leaves the disk out).
"""
import argparse
import csv
import os
import platform
import shutil
import subprocess
import sys
import tempfile
import time

root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
tutorials = os.path.join(root, "tutorials")
standing = {"wall1": "5.0", "wall6": "2.7"}  # accelerations of the ground [m/s2] at which they stand: 0.8 of the collapse


def edit(path, *replacements):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for old, new in replacements:
        if old not in text:
            sys.exit(f"smallRuns.py: {path} is not as it was: {old}")
        text = text.replace(old, new)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def makeCases(folder, binaries):
    """{name: (application, case)}"""
    runs = {}
    for wall, acceleration in standing.items():
        case = os.path.join(folder, "limit", wall)
        shutil.copytree(os.path.join(tutorials, "limitAnalysis/masonryPanels", wall), case)
        runs[f"limitAnalysis {wall}"] = ("limitAnalysis", case)
        for interval, name in ((10, "every 10 steps"), (500, "at the end")):
            group = os.path.join(folder, f"every{interval}")
            shutil.copytree(os.path.join(tutorials, "contactDynamics/masonryPanels/common"), os.path.join(group, "common"),
                            dirs_exist_ok=True)
            case = os.path.join(group, wall)
            shutil.copytree(os.path.join(tutorials, "contactDynamics/masonryPanels", wall), case)
            motion = os.path.join(case, "constant/groundMotion")
            with open(motion, encoding="utf-8") as file:
                value = next(line for line in file if line.strip().startswith("value"))
            edit(motion, (value, f"    value {acceleration};\n"))
            runs[f"contactDynamics {wall}, frames {name}"] = ("contactDynamics", case)
    edit(os.path.join(folder, "every500/common/controlDict"), ("writeInterval   10;\npurgeWrite", "writeInterval   500;\npurgeWrite"))
    for _, case in runs.values():
        subprocess.run([os.path.join(binaries, "blockTexture"), "-case", case], check=True, stdout=subprocess.DEVNULL)
    return runs


def clock(binaries, application, case):
    """Seconds from start to exit, into a case without results."""
    for name in os.listdir(case):
        if name not in ("constant", "system"):
            shutil.rmtree(os.path.join(case, name))
    begin = time.perf_counter()
    subprocess.run([os.path.join(binaries, application), "-case", case], check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - begin


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        return next((line.split(":")[1].strip() for line in file if line.startswith("model name")), "unknown CPU")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", nargs="*", default=[os.path.join(root, "build/bin")])
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--folder")
    parser.add_argument("--out")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        runs = makeCases(folder, options.bin[0])
        least = {(name, binaries): float("inf") for name in runs for binaries in options.bin}
        for _ in range(options.rounds):
            for name, (application, case) in runs.items():
                for binaries in options.bin:
                    least[name, binaries] = min(least[name, binaries], clock(binaries, application, case))
    rows = []
    for name in runs:
        row = {"run": name}
        for number, binaries in enumerate(options.bin):
            row[f"clock[ms] {number + 1}"] = f"{1e3 * least[name, binaries]:.1f}"
            if "every" in name:
                without = least[name.replace("every 10 steps", "at the end"), binaries]
                row[f"over without {number + 1}"] = f"{least[name, binaries] / without:.2f}"
        rows.append(row)
        print(", ".join(f"{key} {value}" for key, value in row.items()))
    head = f"# {processor()}, {platform.system()} {platform.release()}, {os.cpu_count()} cores; bin: {' '.join(options.bin)}"
    print(head[2:])
    if options.out:
        columns = list(dict.fromkeys(key for row in rows for key in row))
        with open(options.out, "w", encoding="utf-8", newline="") as file:
            file.write(head + "\n")
            table = csv.DictWriter(file, columns)
            table.writeheader()
            table.writerows(rows)


if __name__ == "__main__":
    main()
