# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""How the checks of this folder run: on a tree, or on planted faults."""
import pathlib
import sys


def run(check, selfTest):
    """The exit status. check(root) returns the lines of what is wrong and a line that sums up; selfTest() the number of
    faults that it has planted and the failures to find them."""
    if "--self-test" in sys.argv[1:]:
        planted, failures = selfTest()
        for failure in failures:
            print("self-test:", failure)
        print(f"{planted} planted faults, {len(failures)} failures")
        return 1 if failures else 0
    found, summary = check(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]))
    for line in found:
        print(line)
    print(summary)
    return 1 if found else 0
