#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorials of limit analysis, exported and imported again, have the same multiplier.

roundTrips.py BIN TUTORIALS few|all

Exactly written formats (obj, compasJson, of the plane dxf) to 1e-9. Of those of four decimals:

- dxf has the multiplier of the same blocks whose corners are rounded here, to 1e-9: export and import add nothing to
  what rounding does;
- what rounding does is within what follows from it, see changeByRounding.
"""
import base64
import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

applications, tutorials = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
few = sys.argv[3] == "few"
exact = 1e-9


def run(application, case, *options):
    """\return its standard output, or None where it ended otherwise than with an answer"""
    done = subprocess.run([applications / application, "-case", case, *options], capture_output=True, text=True,
                          timeout=900, check=False)
    return (done.stdout if done.returncode == 0 else None), done.stdout[-1500:] + done.stderr


def outcome(case):
    """The multiplier, or the status where there is none; None where limitAnalysis refuses the case."""
    output, _ = run("limitAnalysis", case)
    if output is None:
        return None
    alpha = re.search(r"multiplier alpha = (\S+)", output)
    if alpha:
        table = (case / "postProcessing/limitAnalysis/0/limitAnalysis.dat").read_text().splitlines()
        names = table[0].lstrip("# ").split()
        return float(table[-1].split()[[name.split("[")[0] for name in names].index("alpha")])
    return re.search(r"Status: (\w+)", output).group(1)


def isTheSame(expected, found, gate):
    """Blocks that fall have no multiplier above 0: where rounding decides whether they do, the other one is next to it."""
    both = [0 if value == "unstable" and gate > exact else value for value in (expected, found)]
    if all(isinstance(value, (int, float)) for value in both):
        return abs(both[0] - both[1]) <= gate * max(1, abs(both[0]))
    return both[0] == both[1]


def withRing(case, target, change):
    """The multiplier of the case with a ring that is thicker by so much [m]."""
    shutil.copytree(case, target, ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "assembly", "export"))
    dictionary = target / "system/blockTextureDict"
    thickness = re.compile(r"(?<=thickness)(\s+)([\d.]+)(?=;)")
    dictionary.write_text(thickness.sub(lambda key: f"{key[1]}{float(key[2]) + change!r}", dictionary.read_text(), 1))
    run("blockTexture", target)
    multiplier = outcome(target)
    shutil.rmtree(target)
    return 0 if multiplier == "unstable" else multiplier


def changeByRounding(case, expected, decimals, dimensions):
    """\return by how much rounding may change a multiplier, relative to the larger of it and 1

    In arches, vaults and domes a line of thrust goes through the ring, and hinges are where it meets a face. Corners
    move by half a unit u = 10^-decimals along each axis, sqrt(2)/2 u in the plane; in space by sqrt(3)/2 u, and by up
    to the tolerance of the import, 1.75 u, where it makes faces plane again. Both faces moved inwards by that are those
    of a ring thinner by twice as much, in which a line of thrust of the rounded ring is none the worse, and outwards
    likewise: the multiplier of the rounded ring lies between those of two rings of such a thickness, with their loads.
    For a radius of 2 m and a ring of 0.3 m this is 55 u / 1 m in a multiplier of 4.65 without backfill: the
    multiplier starts from 0 at the least thickness, 0.215 m, so that what counts is u by the 0.085 m beyond it.

    Multipliers of walls and columns are ratios of a width and a height, b / h, of some metre, and most of these lengths are
    multiples of u: u / 1 m is enough.
    """
    unit = 10.0**-decimals
    if not re.search(r"type +(arch|barrelVault|dome|crossVault);", (case / "system/blockTextureDict").read_text()):
        return unit
    nearer = unit * (2**0.5 if dimensions == 2 else 2 * (3**0.5 / 2 + 1.75))
    expected = 0 if expected == "unstable" else expected
    bounds = [withRing(case, case.with_name(f"{case.name}-ring"), change) for change in (-nearer, nearer)]
    return max(abs(bound - expected) for bound in bounds) / max(1, abs(expected))


def roundedHere(case, target, decimals):
    """The multiplier of the case whose corners are rounded in its own file of blocks."""
    shutil.copytree(case, target, ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "export"))
    file = target / "constant/assembly/blocks"
    text = file.read_text()
    outlines = re.search(r"^outlines +\d+\n\(\n(.*?)^\)", text, re.M | re.S)
    number = re.compile(r"-?\d[\d.]*(?:e[-+]?\d+)?")
    rounded = number.sub(lambda one: f"{float(one[0]):.{decimals}f}", outlines[1])
    file.write_text(text[:outlines.start(1)] + rounded + text[outlines.end(1):])
    return outcome(target)


def supportNames(case):
    text = (case / "constant/assembly/blocks").read_text()
    body = re.search(r"^supports\n\{\n(.*?)^\}", text, re.S | re.M).group(1)
    return re.findall(r"^    (\S+)\n    \{", body, re.M)


def imported(case, target, file, dimensions):
    """A copy of the case whose blocks come from the exported file."""
    shutil.copytree(case, target, ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "assembly", "export"))
    shutil.copy(file, target / "constant")
    text = (case / "constant/assembly/blocks").read_text()
    tolerance = re.search(r"^jointTolerance\s+(\S+);", text, re.M)
    supports = " ".join(f"{name} {{ type import; }}" for name in supportNames(case))
    thickness = re.search(r"^thickness\s+([\d.e+-]+);", text, re.M)
    (target / "system/blockTextureDict").write_text(
        f"dimensions {dimensions};\ntexture {{ type import; file \"constant/{file.name}\";"
        + (f" thickness {thickness.group(1)};" if dimensions == 2 and thickness else "") + " }\n"
        f"supports {{ {supports} }}\n" + (f"jointTolerance {tolerance.group(1)};\n" if tolerance else ""))


def cases():
    names = ["masonryPanels/wall1", "space/column", "blockGroups/space"] if few else None
    for dictionary in sorted(tutorials.glob("limitAnalysis/**/system/blockTextureDict")):
        case = dictionary.parents[1]
        if (case / "constant/loads").exists() and (names is None or any(name in str(case) for name in names)):
            if "imported" not in str(case) and "triSurface" not in " ".join(map(str, case.glob("constant/*"))):
                yield case


def faultOfOthers(case):
    """What is wrong with the formats that Drystone does not read: glTF, the LMGC90 script, 3DEC commands."""
    text = (case / "constant/assembly/blocks").read_text()
    shapes = text[re.search(r"^(outlines|blocks) +\d+\n", text, re.M).start():]
    blocks = int(re.match(r"\w+ +(\d+)", shapes).group(1))
    for format_ in ("gltf", "lmgc90", "3dec"):
        output, message = run("exportBlocks", case, "-format", format_, "-output", f"export/other.{format_}")
        if output is None:
            return message
    gltf = json.loads((case / "export/other.gltf").read_text())
    buffer = base64.b64decode(gltf["buffers"][0]["uri"].split(",")[1], validate=True)
    if len(buffer) != gltf["buffers"][0]["byteLength"] or len(gltf["nodes"]) != blocks:
        return f"glTF has {len(gltf['nodes'])} nodes and {len(buffer)} bytes"
    for accessor in gltf["accessors"]:
        view = gltf["bufferViews"][accessor["bufferView"]]
        numbers = struct.unpack(f"<{3 * accessor['count']}f", buffer[view["byteOffset"]:][:view["byteLength"]])
        for axis in range(3):
            if "min" in accessor and abs(
                    min(numbers[axis::3]) - accessor["min"][axis]) > 1e-6 * max(1, abs(accessor["min"][axis])):
                return f"glTF: minimum of {accessor}"
    script = (case / "export/other.lmgc90").read_text()
    compile(script, "lmgc90", "exec")
    if script.count("\nblock([") != blocks:
        return f"LMGC90: {script.count('block([')} blocks of {blocks}"
    commands = (case / "export/other.3dec").read_text()
    if commands.count("block create polyhedron") + commands.count("left out") != blocks:
        return "3DEC: not all blocks"
    return None


def main():
    failures = compared = 0
    with tempfile.TemporaryDirectory() as scratch:
        for number, source in enumerate(cases()):
            case = pathlib.Path(scratch) / f"case{number}"
            shutil.copytree(source, case, ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "runs"))
            name = source.relative_to(tutorials)
            output, message = run("blockTexture", case)
            expected = outcome(case) if output is not None else None
            if expected is None:
                print(f"{name}: left out, its own multiplier needs more than one run")
                continue
            text = (case / "constant/assembly/blocks").read_text()
            dimensions = 2 if "dimensions      2;" in text else 3
            fault = faultOfOthers(case)
            if fault:
                failures += 1
                print(f"{name}: {fault}")
            hasManyThicknesses = re.search(r"^thickness\s+\d+\n\(", text, re.M)
            if hasManyThicknesses:
                continue
            decimals = 4
            rounded = changeByRounding(case, expected, decimals, dimensions)
            formats = ([("dxf", [], exact), ("dxf", ["-decimals", f"{decimals}"], rounded)] if dimensions == 2 else
                       [("obj", [], exact), ("compasJson", [], exact), ("obj", ["-decimals", f"{decimals}"], rounded)])
            for format_, options, gate in formats:
                label = f"{name} {format_} {' '.join(options)}"
                output, message = run("exportBlocks", case, "-format", format_, *options)
                target = pathlib.Path(scratch) / f"case{number}-{format_}{''.join(options)}"
                ending = {"dxf": "dxf", "obj": "obj", "compasJson": "json"}[format_]
                if output is not None:
                    imported(case, target, case / f"export/blocks.{ending}", dimensions)
                    output, message = run("blockTexture", target)
                found = outcome(target) if output is not None else None
                isSame = isTheSame(expected, found, gate)
                compared += 1
                print(f"{label}: {expected} {found}{'' if isSame else '  DIFFERENT'}, to {gate:.2g}", flush=True)
                if dimensions == 2 and options:
                    here = roundedHere(case, pathlib.Path(scratch) / f"case{number}-rounded", decimals)
                    isAsHere = isTheSame(here, found, exact)
                    print(f"{label}: {here} with corners rounded here{'' if isAsHere else '  DIFFERENT'}", flush=True)
                    isSame = isSame and isAsHere
                if not isSame:
                    failures += 1
                    print(message if found is None else "")
    print(f"{compared} round trips, {failures} failures")
    return 1 if failures or compared < 3 else 0


if __name__ == "__main__":
    sys.exit(main())
