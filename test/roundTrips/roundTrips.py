#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Tutorials of limit analysis, exported and imported again, have the same multiplier.

roundTrips.py BIN TUTORIALS few|all

Exactly written formats (obj, compasJson, of the plane dxf) to 1e-9, rounded ones (obj and dxf of four
decimals) to 1e-4.
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
    both = [0 if value == "unstable" and gate > 1e-9 else value for value in (expected, found)]
    if all(isinstance(value, (int, float)) for value in both):
        return abs(both[0] - both[1]) <= gate * max(1, abs(both[0]))
    return both[0] == both[1]


def supportNames(case):
    text = (case / "constant/assembly/blocks").read_text()
    body = re.search(r"^supports\n\{\n(.*?)^\}", text, re.S | re.M).group(1)
    return re.findall(r"^    (\S+)\n    \{", body, re.M)


def imported(case, target, file, dimensions, format_, scale=""):
    """A copy of the case whose blocks come from the exported file."""
    shutil.copytree(case, target, ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "assembly", "export"))
    shutil.copy(file, target / "constant")
    text = (case / "constant/assembly/blocks").read_text()
    tolerance = re.search(r"^jointTolerance\s+(\S+);", text, re.M)
    zones = supportNames(case)
    supports = ("base { type import; }" if format_ == "compasJson"
                else " ".join(f"{name} {{ type import; }}" for name in zones))
    thickness = re.search(r"^thickness\s+([\d.e+-]+);", text, re.M)
    (target / "system/blockTextureDict").write_text(
        f"dimensions {dimensions};\ntexture {{ type import; file \"constant/{file.name}\"; {scale}"
        + (f" thickness {thickness.group(1)};" if dimensions == 2 and thickness else "") + " }\n"
        f"supports {{ {supports} }}\n" + (f"jointTolerance {tolerance.group(1)};\n" if tolerance else ""))


def cases():
    names = ["masonryPanels/wall1", "space/column"] if few else None
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
            formats = ([("dxf", [], 1e-9), ("dxf", ["-decimals", "4"], 1e-4)] if dimensions == 2 else
                       [("obj", [], 1e-9), ("compasJson", [], 1e-9), ("obj", ["-decimals", "4"], 1e-4)])
            if dimensions == 3 and "supports\n{\n}" not in text and len(supportNames(case)) > 1:
                formats = [one for one in formats if one[0] != "compasJson"]  # which knows supports, but not their names
            for format_, options, gate in formats:
                if hasManyThicknesses:
                    continue
                label = f"{name} {format_} {' '.join(options)}"
                output, message = run("exportBlocks", case, "-format", format_, *options)
                target = pathlib.Path(scratch) / f"case{number}-{format_}{''.join(options)}"
                ending = {"dxf": "dxf", "obj": "obj", "compasJson": "json"}[format_]
                if output is not None:
                    imported(case, target, case / f"export/blocks.{ending}", dimensions, format_)
                    output, message = run("blockTexture", target)
                found = outcome(target) if output is not None else None
                isSame = isTheSame(expected, found, gate)
                compared += 1
                print(f"{label}: {expected} {found}{'' if isSame else '  DIFFERENT'}", flush=True)
                if not isSame:
                    failures += 1
                    print(message if found is None else "")
    print(f"{compared} round trips, {failures} failures")
    return 1 if failures or compared < 3 else 0


if __name__ == "__main__":
    sys.exit(main())
