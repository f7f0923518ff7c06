#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the walks of CONTRIBUTING.md: numbered lists of files under the heading "Walks", each of which names the file
by which, or of which, it is included.

    1. `applications/solvers/contactDynamics/contactDynamics.cpp`: the main.
    2. `dynamics/Advance.h` (included by 1): the step.
    3. `dynamics/Solve.cpp` (includes 2): one of its stages.

A file is named from the root or from libs/. A header stands for its .cpp as well.

checkWalks.py [ROOT]        prints each file that does not exist, or is not included as listed; exit status 1 then
checkWalks.py --self-test   plants faults in a scratch tree and demands that each is found
"""
import pathlib
import re
import sys
import tempfile

import checkTree

item = re.compile(r"(\d+)\. `([^`]+)`(?: \((included by|includes) (\d+)\))?")
heading = re.compile(r"#+ ")


def walks(text):
    """Each walk as (title, [(number, file, relation, other number), ..])."""
    found = []
    level = 0
    for line in text.splitlines():
        if heading.match(line):
            depth = len(line) - len(line.lstrip("#"))
            name = line.lstrip("# ").strip()
            if name == "Walks":
                level = depth
            elif depth <= level:
                level = 0
            elif level:
                found.append((name, []))
        elif level and found and (match := item.match(line)):
            found[-1][1].append((int(match[1]), match[2], match[3], int(match[4]) if match[4] else None))
    return found


def filesOf(root, name):
    """The file, and the .cpp of a header; none where it does not exist."""
    path = next((root / folder / name for folder in ("", "libs") if (root / folder / name).is_file()), None)
    if path is None:
        return []
    source = path.with_suffix(".cpp")
    return [path, source] if path.suffix == ".h" and source.is_file() else [path]


def includes(files, header):
    """Whether one of the files includes the header."""
    return any(f'#include "{header}"' in file.read_text(encoding="utf-8") for file in files)


def faults(root):
    text = (root / "CONTRIBUTING.md").read_text(encoding="utf-8")
    found = []
    lists = walks(text)
    if not lists:
        found.append('CONTRIBUTING.md has no heading "Walks" with a list under it')
    for title, items in lists:
        if not items:
            found.append(f"{title}: no list")
        names = {}
        for expected, (number, name, relation, other) in enumerate(items, start=1):
            place = f"{title}, {number}. {name}"
            if number != expected:
                found.append(f"{place}: should be number {expected}")
            names[number] = name
            own = filesOf(root, name)
            if not own:
                found.append(f"{place}: there is no such file")
            elif number > 1 and other not in names:
                found.append(f"{place}: does not tell which file before it includes it, or which it includes")
            elif number > 1:
                header = name if relation == "included by" else names[other]
                files = filesOf(root, names[other]) if relation == "included by" else own
                if not includes(files, header.removeprefix("libs/")):
                    found.append(f"{place}: is not what its list says, {relation} {other}. {names[other]}")
    return found


def selfTest():
    """A good tree, and every kind of fault in it."""
    good = {"libs/a/A.h": "", "libs/a/A.cpp": '#include "b/B.h"\n', "libs/b/B.h": "", "libs/c/C.cpp": '#include "a/A.h"\n',
            "CONTRIBUTING.md": "# Top\n## Walks\n### First\n1. `libs/a/A.h`: a.\n2. `b/B.h` (included by 1): b.\n"
                               "3. `c/C.cpp` (includes 1): c.\n## Other\n1. `no/File.h`\n"}
    planted = {"no such file": ("`b/B.h`", "`b/D.h`"), "is not what its list says": ("(includes 1)", "(includes 2)"),
               "does not tell": (" (included by 1)", ""), "should be number 3": ("3. `c", "4. `c"),
               "no heading": ("## Walks", "## Paths"), "no list": ("## Other", "### Second\n## Other")}
    failures = []

    def faultsOf(files):
        with tempfile.TemporaryDirectory() as scratch:
            for name, text in files.items():
                path = pathlib.Path(scratch) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return faults(pathlib.Path(scratch))

    if faultsOf(good):
        failures.append(f"the good tree: {faultsOf(good)}")
    for message, (old, new) in planted.items():
        assert old in good["CONTRIBUTING.md"]
        found = faultsOf({**good, "CONTRIBUTING.md": good["CONTRIBUTING.md"].replace(old, new)})
        if not any(message in line for line in found):
            failures.append(f"expected '{message}', got {found}")
    return len(planted), failures


def check(root):
    found = faults(root)
    count = len(walks((root / "CONTRIBUTING.md").read_text(encoding="utf-8")))
    return found, f"{count} walks, {len(found)} faults"


if __name__ == "__main__":
    sys.exit(checkTree.run(check, selfTest))
