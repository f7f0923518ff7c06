#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the results of a tutorial with the expected ones: compareResults.py CASE EXPECTED

A line of EXPECTED is one of

    FILE  COLUMN[@ROW]  VALUE  TOLERANCE
    FILE  contains      TEXT TO THE END OF THE LINE
    FILE  exists
    FILE  absent

FILE is relative to the case; it may hold * and ?, and every file that fits is then compared. A table (.dat, .csv) has
a header whose last comment line names its columns, "# Time[s]  alpha[-]"; COLUMN is such a name, its unit may be left
out. ROW is first, last (the default), min, max, count, or the value of the first column: ux@0.5. TOLERANCE is absolute,
or relative with a % behind it. Lines that begin with # are comments.
"""
import glob
import math
import os
import sys


def readTable(path):
    """Column names without and with units, and the rows of numbers."""
    names, rows = [], []
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, start=1):
            line = line.replace(",", " ")
            if line.lstrip().startswith("#"):
                names = line.lstrip().lstrip("#").split()
            elif line.strip() and not names:
                names = line.split()
            elif line.strip():
                values = [float(word) for word in line.split()]
                if len(values) != len(names):
                    raise ValueError(f"{path}:{number}: {len(values)} values under {len(names)} columns")
                rows.append(values)
    return names, rows


def valueOf(path, column):
    names, rows = readTable(path)
    name, _, row = column.partition("@")
    plain = [full.split("[")[0] for full in names]
    if name not in names and name not in plain:
        raise ValueError(f"there is no column {name}; there are {' '.join(names)}")
    index = names.index(name) if name in names else plain.index(name)
    if not rows:
        raise ValueError("the table has no rows")
    values = [values[index] for values in rows]
    if row in ("", "last"):
        return values[-1]
    if row in ("first", "min", "max", "count"):
        return {"first": values[0], "min": min(values), "max": max(values), "count": len(values)}[row]
    wanted = float(row)
    nearest = min(rows, key=lambda entry: abs(entry[0] - wanted))
    if abs(nearest[0] - wanted) > 1e-9 * max(1, abs(wanted)):
        raise ValueError(f"there is no row {row}; the nearest is {nearest[0]}")
    return nearest[index]


def compareLine(case, line):
    """Failures of one line of what is expected, and the number of comparisons made."""
    words = line.split(None, 2)
    if len(words) < 2:
        return [f"not understood: {line}"], 0
    pattern, what = words[0], words[1]
    paths = sorted(glob.glob(os.path.join(case, pattern), recursive=True))
    if what == "absent":
        return [f"{path} is there" for path in paths], 1
    if not paths:
        return [f"{pattern} was not written"], 1
    failures = []
    for path in paths:
        name = os.path.relpath(path, case)
        if what == "exists":
            if os.path.isfile(path) and os.path.getsize(path) == 0:
                failures.append(f"{name} is empty")
        elif what == "contains":
            with open(path, encoding="utf-8", errors="replace") as file:
                if len(words) < 3 or words[2].strip() not in file.read():
                    failures.append(f"{name} does not contain: {words[2] if len(words) > 2 else ''}")
        else:
            try:
                expected, tolerance = words[2].split()
                allowed = (float(tolerance[:-1]) / 100 * abs(float(expected)) if tolerance.endswith("%")
                           else float(tolerance))
                found = valueOf(path, what)
            except (ValueError, IndexError) as error:
                failures.append(f"{name} {what}: {error}")
                continue
            good = math.isfinite(found) and abs(found - float(expected)) <= allowed
            print(f"{'  ' if good else 'X '}{name} {what} = {found:.12g}, expected {expected} within {tolerance}")
            if not good:
                failures.append(f"{name} {what} = {found:.12g}, expected {expected} within {tolerance}")
    return failures, len(paths)


def main():
    case, expected = sys.argv[1:3]
    failures, count = [], 0
    with open(expected, encoding="utf-8") as file:
        for line in file:
            line = line.strip()
            if line and not line.startswith("#"):
                found, compared = compareLine(case, line)
                failures += found
                count += compared
    for failure in failures:
        print("FAILED:", failure)
    print(f"{count} comparisons, {len(failures)} failures")
    return 1 if failures or not count else 0


if __name__ == "__main__":
    sys.exit(main())
