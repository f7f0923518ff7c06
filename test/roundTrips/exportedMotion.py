#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Moments of a motion as exportBlocks writes them, in each format, in the plane and in space.

A brick flies over the ground and turns. Where its corners are at each written time follows from its displacement and
rotation in blockMotion's table (Rodrigues' formula), and every format must have just these points.
"""
import base64
import json
import math
import pathlib
import re
import struct
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from caseTest import CaseTest, header  # noqa: E402

endings = {"obj": "obj", "compasJson": "json", "dxf": "dxf", "gltf": "gltf", "lmgc90": "py", "3dec": "dat"}
box = {2: ((0, 5), (1, 5.4)), 3: ((0, 0, 5), (1, 0.6, 5.4))}
thickness = 0.3
number = r"[-+]?\d[\d.]*(?:e[-+]?\d+)?"


def writeCase(case, dimensions):
    isPlane = dimensions == 2
    (low, high) = box[dimensions]
    outline = f"(({low[0]} {low[1]}) ({high[0]} {low[1]}) ({high[0]} {high[1]}) ({low[0]} {high[1]}))"
    texture = (f"type polygons; thickness {thickness}; blocks ( {outline} );" if isPlane else
               f"type boxes; blocks ( (({' '.join(map(str, low))}) ({' '.join(map(str, high))})) );")
    files = {
        "constant/g": f"value ({'0 -9.81' if isPlane else '0 0'} {'0' if isPlane else '-9.81'});",
        "constant/materialProperties": "density 2000;",
        "constant/contactProperties": "friction { type Coulomb; mu 0.5; }",
        "0/motion": "\"0\" { " + ("velocity (0.5 1); angularVelocity 2;" if isPlane
                                  else "velocity (0.5 0.2 1); angularVelocity (1 2 3);") + " }",
        "system/blockTextureDict": f"dimensions {dimensions}; texture {{ {texture} }} "
                                   "supports { ground { type ground; } }",
        "system/schemes": "timeIntegration { type theta; theta 0.5; }",
        "system/solution": "contactDynamics { solver automatic; tolerance 1e-10; }",
        "system/controlDict": "application contactDynamics; startFrom startTime; startTime 0; stopAt endTime; "
                              "endTime 0.2; deltaT 0.01; writeControl runTime; writeInterval 0.1; functions { "
                              "motion { type blockMotion; blocks (0); writeControl timeStep; writeInterval 1; "
                              "writePrecision 15; } }"}
    for name, text in files.items():
        file = pathlib.Path(case) / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(header % file.name + text + "\n", encoding="ascii")


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def expectedPoints(dimensions, row):
    """Corners of the brick where a row of blockMotion's table puts it; those of the plane as a solid in x-z."""
    (low, high) = box[dimensions]
    if dimensions == 2:
        cosine, sine = math.cos(row["rz"]), math.sin(row["rz"])
        centre = [(a + b) / 2 for a, b in zip(low, high)]
        points = []
        for x in (low[0], high[0]):
            for y in (low[1], high[1]):
                arm = (x - centre[0], y - centre[1])
                place = (centre[0] + row["ux"] + cosine * arm[0] - sine * arm[1],
                         centre[1] + row["uy"] + sine * arm[0] + cosine * arm[1])
                points += [(place[0], depth, place[1]) for depth in (0, thickness)]
        return sorted(points)
    rotation = [row["rx"], row["ry"], row["rz"]]
    angle = math.hypot(*rotation)
    axis = [part / angle for part in rotation]
    centre = [(a + b) / 2 for a, b in zip(low, high)]
    points = []
    for x in (low[0], high[0]):
        for y in (low[1], high[1]):
            for z in (low[2], high[2]):
                arm = [x - centre[0], y - centre[1], z - centre[2]]
                turned = cross(axis, arm)
                along = sum(a * b for a, b in zip(axis, arm))
                points.append(tuple(centre[i] + row["u" + "xyz"[i]] + math.cos(angle) * arm[i]
                                    + math.sin(angle) * turned[i] + (1 - math.cos(angle)) * along * axis[i]
                                    for i in range(3)))
    return sorted(points)


def pointsOf(format_, text, dimensions):
    """All places of the first block in a file, each once."""
    if format_ == "obj":
        first = text.split("o block_")[1]
        places = [map(float, line.split()[1:]) for line in first.splitlines() if line.startswith("v ")]
    elif format_ == "compasJson":
        vertices = json.loads(text)["data"]["graph"]["data"]["node"]["0"]["block"]["data"]["vertex"]
        places = [[vertex[axis] for axis in "xyz"] for vertex in vertices.values()]
    elif format_ == "dxf":
        groups = text.splitlines()
        places, place, layer = [], {}, None
        for code, value in zip(map(int, groups[0::2]), groups[1::2]):
            if code == 8:
                layer = value
            elif layer == "blocks" and 10 <= code < 40:
                place[code // 10] = float(value)
                if len(place) == 3:
                    places.append([place[1], place[2], place[3]])
                    place = {}
            elif code == 0:
                place = {}
        if dimensions == 2:  # a drawing: closed polylines, the place of POLYLINE itself says nothing
            places = [[x, depth, y] for x, y, _ in places[1:] for depth in (0, thickness)]
    elif format_ == "gltf":
        gltf = json.loads(text)
        data = base64.b64decode(gltf["buffers"][0]["uri"].split(",")[1], validate=True)
        mesh = gltf["meshes"][gltf["nodes"][0]["mesh"]]
        accessor = gltf["accessors"][mesh["primitives"][0]["attributes"]["POSITION"]]
        view = gltf["bufferViews"][accessor["bufferView"]]
        values = struct.unpack_from(f"<{3 * accessor['count']}f", data, view["byteOffset"])
        places = [[x, -z, y] for x, y, z in zip(values[0::3], values[1::3], values[2::3])]
    elif format_ == "lmgc90":
        rows = text.split("\nblock([")[1].split("], [")[0].splitlines()[1:]
        places = [[float(value) for value in re.findall(number, row)] for row in rows if row.strip()]
    else:
        lines = text.split("block create polyhedron")[1].split("; block")[0]
        places = [[float(value) for value in word.split(",")] for word in lines.split() if word.count(",") == 2]
    return sorted({tuple(round(value, 12) + 0.0 for value in place) for place in places})


def rotated(quaternion, place):
    x, y, z, w = quaternion
    twice = [2 * value for value in cross([x, y, z], place)]
    return [p + w * t + c for p, t, c in zip(place, twice, cross([x, y, z], twice))]


def animatedPoints(text, node):
    """Of each moment of a glTF animation its time, and the corners of a node with z upwards."""
    gltf = json.loads(text)
    data = base64.b64decode(gltf["buffers"][0]["uri"].split(",")[1], validate=True)

    def vectors(index):
        accessor = gltf["accessors"][index]
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        values = struct.unpack_from(f"<{width * accessor['count']}f", data,
                                    gltf["bufferViews"][accessor["bufferView"]]["byteOffset"])
        return [list(values[i:i + width]) for i in range(0, len(values), width)]

    animation, = gltf["animations"]
    moved = {channel["target"]["path"]: animation["samplers"][channel["sampler"]]
             for channel in animation["channels"] if channel["target"]["node"] == node}
    corners = vectors(gltf["meshes"][gltf["nodes"][node]["mesh"]]["primitives"][0]["attributes"]["POSITION"])
    times = [time for time, in vectors(moved["translation"]["input"])]
    moments = []
    for time, to, turn in zip(times, *(vectors(moved[path]["output"]) for path in ("translation", "rotation"))):
        places = [[a + b for a, b in zip(rotated(turn, corner), to)] for corner in corners]
        moments.append((time, sorted({(round(x, 4), round(-z, 4) + 0.0, round(y, 4)) for x, y, z in places})))
    return moments


class ExportedMotion(CaseTest):
    application = "exportBlocks"

    def check(self, dimensions):
        case = pathlib.Path(self.root.name) / f"flight{dimensions}"
        writeCase(case, dimensions)
        for self.application in ("blockTexture", "contactDynamics"):
            self.run_(case)
        self.application = "exportBlocks"
        lines = self.read(case, "postProcessing/motion/0/block0.dat").splitlines()
        names = [name.split("[")[0] for name in lines[0].lstrip("# ").split()]
        table = [dict(zip(names, map(float, line.split()))) for line in lines[1:]]
        rotationAt = {}
        for time, option in (("0.1", "0.1"), ("0.2", "latestTime"), ("0.2", "0.2")):
            row = next(row for row in table if abs(row["Time"] - float(time)) < 1e-9)
            rotationAt[time] = row["rz"]
            expected = expectedPoints(dimensions, row)
            for format_, ending in endings.items():
                with self.subTest(dimensions=dimensions, time=option, format=format_):
                    self.run_(case, "-format", format_, "-time", option)
                    text = self.read(case, f"export/blocks_{time}.{ending}")
                    found = pointsOf(format_, text, dimensions)
                    self.assertEqual(len(found), 8)
                    most = max(abs(a - b) for p, q in zip(found, expected) for a, b in zip(p, q))
                    self.assertLess(most, 1e-5 if format_ == "gltf" else 1e-11)
        self.assertGreater(abs(rotationAt["0.2"] - rotationAt["0.1"]), 0.1)  # it does turn
        moments = animatedPoints(self.exported(case, "-format", "gltf", "-animation"), 0)
        self.assertEqual([round(time, 6) for time, _ in moments], [0, 0.1, 0.2])
        for time, found in moments[1:]:
            expected = expectedPoints(dimensions, next(row for row in table if abs(row["Time"] - time) < 1e-6))
            self.assertEqual(len(found), 8)
            self.assertLess(max(abs(a - b) for p, q in zip(found, expected) for a, b in zip(p, q)), 1e-4)
        twice = animatedPoints(self.exported(case, "-format", "gltf", "-animation", "-magnification", "2"), 0)
        self.assertEqual(twice[0], moments[0])
        self.assertNotEqual(twice[2], moments[2])
        self.assertIn("in the format gltf only", self.run_(case, "-animation", status=1).stderr)
        done = self.run_(case, "-time", "0.15", status=1)
        self.assertIn("There is no state or start of time 0.15 in this case.\n\nTimes: 0 0.1 0.2\n", done.stderr)

    def test_ofTheStart(self):
        """Of 0/motion, without which the blocks start as built."""
        case = pathlib.Path(self.root.name) / "start"
        writeCase(case, 2)
        self.application = "blockTexture"
        self.run_(case)
        self.application = "exportBlocks"
        motion = case / "0/motion"
        motion.write_text("0 { displacement (0.3 2); rotation 0.5; }\n", encoding="ascii")
        self.run_(case, "-time", "0")
        found = pointsOf("obj", self.read(case, "export/blocks_0.obj"), 2)
        expected = expectedPoints(2, {"ux": 0.3, "uy": 2, "rz": 0.5})
        self.assertLess(max(abs(a - b) for p, q in zip(found, expected) for a, b in zip(p, q)), 1e-11)
        motion.unlink()
        self.assertIn("There is no state or start of time 0", self.run_(case, "-time", "0", status=1).stderr)

    def test_ofOtherInputIsWarnedOf(self):
        case = pathlib.Path(self.root.name) / "other"
        writeCase(case, 2)
        for self.application in ("blockTexture", "contactDynamics"):
            self.run_(case)
        self.application = "exportBlocks"
        shows = ("-time", "latestTime"), ("-format", "gltf", "-animation")

        def said(options):
            done = self.run_(case, *options)
            return done.stdout + done.stderr

        for options in ((), *shows):
            self.assertNotIn("Warning", said(options))
        properties = case / "constant/contactProperties"
        properties.write_text("friction { type Coulomb; mu 0.6; }\n", encoding="ascii")
        for options in shows:
            self.assertRegex(said(options), r"results at time .*0.2 are those of other input .*: "
                                            r"constant/contactProperties has changed\.")
        self.assertNotIn("Warning", said(()))
        properties.write_text("friction { type Coulomb; mu 0.6;\n", encoding="ascii")
        for options in shows:
            self.assertRegex(said(options), r"of contactDynamics are those of the input of now is unknown")

    def test_saysWhatAFormatLeavesOut(self):
        case = pathlib.Path(self.root.name) / "left"
        writeCase(case, 2)
        self.application = "blockTexture"
        self.run_(case)
        self.application = "exportBlocks"
        properties = case / "constant/contactProperties"
        properties.write_text("friction { type Coulomb; mu 0.5; flowRule nonAssociative; }\n", encoding="ascii")
        done = self.run_(case, "-format", "lmgc90")
        self.assertNotIn("Warning", done.stdout + done.stderr)
        properties.write_text("friction { type Coulomb; mu 0.5; }\nrestitution { normal 0.5; }\ncohesion { strength 1e5; }\n"
                              "tension { strength 1e4; }\n", encoding="ascii")
        done = self.run_(case, "-format", "lmgc90")
        self.assertRegex(done.stdout + done.stderr, r"leaves out restitution, cohesion, tension\.")
        self.assertIn("flowRule", done.stdout + done.stderr)
        self.assertIn("densities", self.run_(case, "-format", "3dec").stdout)
        self.assertIn("-animation", self.run_(case, "-magnification", "2", status=1).stderr)

    def exported(self, case, *options):
        self.run_(case, *options)
        return self.read(case, "export/motion.gltf")

    def test_ofThePlane(self):
        self.check(2)

    def test_ofSpace(self):
        self.check(3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
