#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the results of a tutorial with the expected ones:
compareResults.py CASE EXPECTED [--record FILE --tutorial NAME --time SECONDS]

A line of EXPECTED is one of

    FILE  COLUMN[@ROW]  VALUE  TOLERANCE
    FILE  "TEXT"        VALUE  TOLERANCE
    FILE  COLUMN[@ROW]  VALUE  differs
    FILE  contains      TEXT TO THE END OF THE LINE
    FILE  exists
    FILE  absent

FILE is relative to the case; it may hold * and ?, and every file that fits is then compared. A table (.dat, .csv) has
a header whose last comment line names its columns, "# Time[s]  alpha[-]"; COLUMN is such a name, its unit may be left
out. ROW is first, last (the default), min, max, count, or the value of the first column: ux@0.5. "TEXT" is what stands
before the number in a log. TOLERANCE is absolute, or relative with a % behind it; `differs` is for a published figure
that is not reproduced, and fails once it is, to half a unit of its last digit. Lines that begin with # are comments.

Lines with a VALUE may say where it is from, for tutorials/README.md (writeAtlas.py):

    FILE COLUMN VALUE TOLERANCE ; KIND OF STRUCTURE: WHAT ; ORIGIN ; SOURCE

ORIGIN is published, closed form, another program, or kept: a figure of Drystone itself, asserted so that it stays. The
record (JSON) has each such line with the value that was found, and the CPU time of the tutorial, for that page.
"""
import argparse
import datetime
import glob
import json
import math
import os
import re
import sys

origins = ("published", "closed form", "another program", "kept")


def parseLine(line):
    """The words of a line, FILE, COLUMN and the rest, and where its value is from: None, or what, origin and source."""
    parts = [part.strip() for part in re.split(r"\s;\s", line)]
    annotation = None
    if len(parts) > 1 and not re.match(r"\S+\s+contains\s", line):
        if len(parts) != 4 or not all(parts):
            raise ValueError(f"a value, what it is, its origin and its source are four parts: {line}")
        if parts[2] not in origins:
            raise ValueError(f"unknown origin {parts[2]}; there are {', '.join(origins)}: {line}")
        annotation = {"what": parts[1], "origin": parts[2], "source": parts[3]}
        line = parts[0]
    found = re.match(r'(\S+)\s+("[^"]*"|\S+)\s*(.*)', line)
    if not found:
        raise ValueError(f"not understood: {line}")
    return list(found.groups()), annotation


def expectedLines(path):
    with open(path, encoding="utf-8") as file:
        return [line.strip() for line in file if line.strip() and not line.strip().startswith("#")]


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


def valueAfter(path, text):
    """The number behind a text that stands in a file once, or each time with the same number."""
    with open(path, encoding="utf-8", errors="replace") as file:
        numbers = re.findall(re.escape(text) + r"\s*([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)", file.read())
    if len(set(numbers)) != 1:
        raise ValueError(f"there are {len(set(numbers))} numbers after this text")
    return float(numbers[0].rstrip("."))


def halfUnit(number):
    """Of the last digit that is written."""
    mantissa, _, exponent = number.lower().partition("e")
    return 0.5 * 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def valueOf(path, column):
    if column.startswith('"'):
        return valueAfter(path, column[1:-1])
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
    """Failures of one line of what is expected, and the values found, one a file (None where there is no value)."""
    try:
        (pattern, what, rest), _ = parseLine(line)
    except ValueError as error:
        return [str(error)], []
    paths = sorted(glob.glob(os.path.join(case, pattern), recursive=True))
    if what == "absent":
        return [f"{path} is there" for path in paths], [None]
    if not paths:
        return [f"{pattern} was not written"], []
    failures, values = [], []
    for path in paths:
        name = os.path.relpath(path, case)
        values.append(None)
        if what == "exists":
            if os.path.isfile(path) and os.path.getsize(path) == 0:
                failures.append(f"{name} is empty")
        elif what == "contains":
            with open(path, encoding="utf-8", errors="replace") as file:
                if not rest or rest not in file.read():
                    failures.append(f"{name} does not contain: {rest}")
        else:
            try:
                expected, tolerance = rest.split()
                found = valueOf(path, what)
                if tolerance == "differs":
                    good = math.isfinite(found) and abs(found - float(expected)) > halfUnit(expected)
                    wanted = f"published {expected}, which it differs from"
                else:
                    allowed = (float(tolerance[:-1]) / 100 * abs(float(expected)) if tolerance.endswith("%")
                               else float(tolerance))
                    good = math.isfinite(found) and abs(found - float(expected)) <= allowed
                    wanted = f"expected {expected} within {tolerance}"
            except (ValueError, IndexError) as error:
                failures.append(f"{name} {what}: {error}")
                continue
            values[-1] = found
            print(f"{'  ' if good else 'X '}{name} {what} = {found:.12g}, {wanted}")
            if not good:
                failures.append(f"{name} {what} = {found:.12g}, {wanted}")
    return failures, values


def processor():
    """As the system names it."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            return re.search(r"^model name\s*:\s*(.*)$", file.read(), re.MULTILINE).group(1).strip()
    except (OSError, AttributeError):
        return "an unknown processor"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("case")
    parser.add_argument("expected")
    parser.add_argument("--record")
    parser.add_argument("--tutorial", default="")
    parser.add_argument("--time", type=float, default=0)
    arguments = parser.parse_args()
    failures, count, found = [], 0, {}
    for line in expectedLines(arguments.expected):
        failed, values = compareLine(arguments.case, line)
        failures += failed
        count += len(values)
        found[line] = [value for value in values if value is not None]
    for failure in failures:
        print("FAILED:", failure)
    print(f"{count} comparisons, {len(failures)} failures")
    if failures or not count:
        return 1
    if arguments.record:
        os.makedirs(os.path.dirname(os.path.abspath(arguments.record)), exist_ok=True)
        with open(arguments.record, "w", encoding="utf-8") as file:
            json.dump({"tutorial": arguments.tutorial, "time": arguments.time, "processor": processor(),
                       "date": datetime.date.today().isoformat(),
                       "found": {line: values for line, values in found.items() if values}}, file, indent=1)
    return 0


if __name__ == "__main__":
    sys.exit(main())
