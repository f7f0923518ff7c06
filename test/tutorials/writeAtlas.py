#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Writes tutorials/README.md, the page of every number that a tutorial asserts and where it is from:

    writeAtlas.py SOURCE RECORDS    from the records of the tutorials' tests (build/test/tutorials/records); a tutorial
                                    that was not run keeps its figures of the page, or gets "-"
    writeAtlas.py SOURCE --check    whether the page has exactly the lines and references of the files `expected`, with
                                    figures that these accept

The lines are those of the files `expected` that say where their value is from (compareResults.py).
"""
import glob
import json
import os
import re
import sys

import compareResults

# The tables of the page, by the kinds of structure that lines name.
kinds = {"block": "Single blocks", "column": "Columns, stacks and towers", "arch": "Arches", "wall": "Walls in the plane",
         "wall in space": "Walls in space", "house": "Houses", "vault": "Vaults", "dome": "Domes"}
leastReferences = 60
notRun = "-"  # instead of a figure
heading = "| structure and figure | reference | of | here | difference | tutorial | CPU [s] |"


def lines(source):
    """Every annotated line of the tutorials, in the order of the page's tables."""
    found = []
    for path in sorted(glob.glob(os.path.join(source, "tutorials", "**", "expected"), recursive=True)):
        tutorial = os.path.relpath(os.path.dirname(path), os.path.join(source, "tutorials"))
        for line in compareResults.expectedLines(path):
            (_, column, rest), annotation = compareResults.parseLine(line)
            if annotation is None:
                if column not in ("exists", "absent", "contains") and float((rest.split() or ["nan"])[0]) != 0:
                    raise ValueError(f"{path}: a line whose value is not 0 has to say where it is from: {line}")
                continue
            kind, _, what = annotation["what"].partition(": ")
            if kind not in kinds or not what:
                raise ValueError(f"{path}: no kind of structure ({', '.join(kinds)}) is named: {line}")
            reference, tolerance = rest.split()
            found.append({"tutorial": tutorial, "line": line, "kind": kind, "what": what, "reference": reference,
                          "tolerance": tolerance, "origin": annotation["origin"], "source": annotation["source"]})
    keys = list(kinds)
    found.sort(key=lambda line: (keys.index(line["kind"]), compareResults.origins.index(line["origin"])))
    if len({(line["tutorial"], line["what"], line["reference"]) for line in found}) != len(found):
        seen = set()
        for line in found:
            key = (line["tutorial"], line["what"], line["reference"])
            if key in seen:
                raise ValueError(f"two lines with one name: {line['line']}")
            seen.add(key)
    return found


def difference(found, reference):
    """Relative to the reference, absolute where that is 0."""
    if found == notRun:
        return notRun
    found, reference = float(found), float(reference)
    distance = found - reference
    if distance == 0 or reference and abs(distance / reference) < 5e-10:
        return "0"
    if reference == 0:
        return f"{distance:.1e}"
    return f"{100 * distance / abs(reference):+.2g}%" if abs(distance / reference) >= 1e-5 else f"{distance / abs(reference):+.0e}"


def accepted(line, found):
    if found == notRun:
        return True
    found = float(found)
    reference, tolerance = float(line["reference"]), line["tolerance"]
    if tolerance == "differs":
        return abs(found - reference) > compareResults.halfUnit(line["reference"])
    allowed = float(tolerance[:-1]) / 100 * abs(reference) if tolerance.endswith("%") else float(tolerance)
    return abs(found - reference) <= allowed * (1 + 1e-6) + 1e-9 * abs(reference)


def row(line, found, time):
    """Of a table; found and time as they are to be printed."""
    name = line["tutorial"]
    source = "kept" if line["origin"] == "kept" and line["source"] == "Drystone" else f"{line['origin']}: {line['source']}"
    return (f"| {line['what']} | {line['reference']} | {source} | {found} | "
            f"{difference(found, line['reference'])} | [{name}]({name}) | {time} |")


def page(annotated, figures, machine):
    """The text; figures by (tutorial, what, reference): found and time as printed."""
    def rowOf(line):
        return row(line, *figures[line["tutorial"], line["what"], line["reference"]])

    reproduced = [line for line in annotated if line["tolerance"] != "differs"]
    others = [line for line in annotated if line["tolerance"] == "differs"]
    counts = {origin: sum(line["origin"] == origin for line in reproduced) for origin in compareResults.origins}
    text = f"""# Validation

Each tutorial is a test: after a run its figures are compared with the file `expected` of its folder. This page has every
number that these files assert, with its reference: {counts['published']} are published figures, {counts['closed form']} closed forms, {counts['another program']} were computed by
another program, and {counts['kept']} are kept, figures of Drystone itself that are asserted so that a change of them is seen. Not listed are
residuals, gaps, imbalances of energy and other figures whose reference is 0. {len(others)} published figures are [not
reproduced](#not-reproduced).

The difference is relative to the reference, in percent or as a fraction; 0 is one below the digits printed. CPU is the time of
the tutorial's `./Allrun` as a whole, of all its cases and cores. A line with "-" has not been run for this page.

The page is written by `test/tutorials/writeAtlas.py` from a run of the tests of the tutorials ({machine});
the test `tutorials.atlas` compares it with the files `expected`. Sources are given in full in the READMEs of the tutorials.
"""
    for kind, title in kinds.items():
        rows = [rowOf(line) for line in reproduced if line["kind"] == kind]
        if rows:
            text += f"\n## {title}\n\n{heading}\n|---|---|---|---|---|---|---|\n" + "\n".join(rows) + "\n"
    text += ("\n## Not reproduced\n\nPublished figures that Drystone does not give, with the reason as far as it is known. The tests fail "
             f"as soon as one of them is reproduced.\n\n{heading}\n|---|---|---|---|---|---|---|\n"
             + "\n".join(rowOf(line) for line in others) + "\n")
    return text


def read(text):
    """Figures and machine of a page."""
    figures = {}
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split(" | ")]
        if line.startswith("| ") and len(cells) == 7 and line != heading:
            name = re.match(r"\[([^]]*)\]", cells[5]).group(1)
            figures[name, cells[0], cells[1]] = cells[3], cells[6]
    machine = re.search(r"from a run of the tests of the tutorials \((.*)\);", text)
    return figures, machine.group(1) if machine else ""


def recordedFigures(annotated, folder):
    """Of the records in a folder, and the machine and date that they name."""
    figures, machines = {}, set()
    for path in sorted(glob.glob(os.path.join(folder, "**", "*.json"), recursive=True)):
        with open(path, encoding="utf-8") as file:
            record = json.load(file)
        for line in annotated:
            values = record["found"].get(line["line"])
            if line["tutorial"] == record["tutorial"] and values:
                worst = max(values, key=lambda value: abs(value - float(line["reference"])))
                figures[line["tutorial"], line["what"], line["reference"]] = f"{worst:.9g}", f"{record['time']:.1f}"
                machines.add((record["date"], record["processor"]))
    return figures, machines


def faultsOf(source, what):
    """Faults, after the page has been written or checked."""
    path = os.path.join(source, "tutorials", "README.md")
    annotated = lines(source)
    text = ""
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            text = file.read()
    figures, machine = read(text)
    if what != "--check":
        recorded, machines = recordedFigures(annotated, what)
        figures.update(recorded)
        if machines:
            machine = f"{max(machines)[0]}, {' and '.join(sorted({name for _, name in machines}))}"

    def key(line):
        return line["tutorial"], line["what"], line["reference"]

    for line in annotated:
        if what != "--check":
            figures.setdefault(key(line), (notRun, notRun))
    missing = [line for line in annotated if key(line) not in figures]
    faults = [f"{line['tutorial']}: the page has no figure for: {line['line']}" for line in missing]
    faults += [f"{line['tutorial']}: {figures[key(line)][0]} of the page is not accepted by: {line['line']}"
               for line in annotated if line not in missing and not accepted(line, figures[key(line)][0])]
    references = sum(line["origin"] != "kept" and line["tolerance"] != "differs" and line not in missing
                     and figures[key(line)][0] != notRun for line in annotated)
    if references < leastReferences:
        faults.append(f"{references} lines have a reference and a figure, at least {leastReferences} have to")
    if not faults:
        written = page(annotated, figures, machine)
        if what != "--check":
            with open(path, "w", encoding="utf-8") as file:
                file.write(written)
        elif written != text:
            present = set(text.splitlines())
            faults.append("tutorials/README.md is not what the files `expected` say; run the tutorials' tests, then "
                          "test/tutorials/writeAtlas.py . build/test/tutorials/records")
            faults += [f"+ {line}" for line in written.splitlines() if line not in present]
            faults += [f"- {line}" for line in text.splitlines() if line not in set(written.splitlines())]
    return faults, f"{len(annotated)} lines, {references} with a reference"


def main():
    try:
        faults, summary = faultsOf(*sys.argv[1:3])
    except ValueError as error:
        faults, summary = [str(error)], "not read"
    for fault in faults:
        print(fault)
    print(f"{summary}, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
