# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""foamlib, to which the Python package leaves dictionaries, reads every one of ours, and sees the values that are there.
Skipped (77) where it is not installed, which Debian's packages cannot do: pip install foamlib."""
import pathlib
import sys

root = pathlib.Path(sys.argv[1])
try:
    from foamlib import FoamFile
except ImportError:
    print("foamlib is not installed: skipped")
    sys.exit(77)


def dictionaries():
    """Those that have the header of OpenFOAM, but for what runs left behind."""
    for folder in ("tutorials", "etc/annotated", "etc/cases"):
        for file in sorted((root / folder).rglob("*")):
            isResult = {"postProcessing", "VTK", "assembly"} & set(file.parts)
            if file.is_file() and not isResult and b"FoamFile" in file.read_bytes()[:4000]:
                yield file


faults, count = [], 0
for file in dictionaries():
    count += 1
    try:
        FoamFile(file).as_dict()
    except Exception as fault:  # whatever a reader of others raises
        faults.append(f"{file.relative_to(root)}: {type(fault).__name__} {fault}")
print(f"foamlib reads {count - len(faults)} of {count} dictionaries", *faults, sep="\n")

wall = root / "tutorials/limitAnalysis/masonryPanels/wall1"
seen = (FoamFile(wall / "constant/contactProperties")["friction", "mu"], FoamFile(wall / "constant/g")["value"],
        FoamFile(wall / "system/blockTextureDict")["texture", "type"])
print("of wall 1 it sees", *seen)
isRight = seen[0] == 0.65 and list(seen[1]) == [0, -9.81, 0] and seen[2] == "runningBond"
sys.exit(0 if count > 400 and not faults and isRight else 1)
