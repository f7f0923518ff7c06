# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of an animation, VTK/<name>.vtp.series: where the blocks are, and the fields of their cells."""
import base64
import json
import math
import struct
import xml.etree.ElementTree
import zlib
from pathlib import Path

from ._numbers import rows

_formats = {"Int8": "b", "UInt8": "B", "Int32": "i", "UInt32": "I", "Int64": "q", "UInt64": "Q", "Float32": "f",
            "Float64": "d"}


class Frame:
    """One moment: `time` [s] (of a mechanism its part from 0 to 1), `points` [m], and `fields` by name, one value or row
    a cell: blockId, displacement[m], rotation[rad] and more (of contacts: a point each); `pointFields` has those of the
    corners of blocks, and `polygons` of each cell the indices of its corners in `points`. `frame["displacement"]` is a
    field with its unit or without."""

    def __init__(self, time, points, fields, pointFields=None, polygons=()):
        self.time = time
        self.points = points
        self.fields = fields
        self.pointFields = pointFields or {}
        self.polygons = list(polygons)

    def __getitem__(self, name):
        for known, values in self.fields.items():
            if name in (known, known.partition("[")[0]):
                return values
        raise KeyError(f"no field {name}; there are: {' '.join(self.fields)}")

    def largestDisplacement(self):
        """Of the mass centre of any block [m]."""
        return max((math.hypot(*row) for row in self["displacement"]), default=0.0)


def _arrays(file):
    """The numbers of each DataArray of a .vtp file, in its element or, as in files of older versions, raw at the end, by
    its element."""
    content = Path(file).read_bytes()
    marker = content.find(b"<AppendedData")
    begin = content.find(b"_", marker) + 1
    end = content.rfind(b"</AppendedData>")
    if marker >= 0 and (begin == 0 or end < 0):
        raise ValueError(f"{file} is cut off")
    try:
        root = xml.etree.ElementTree.fromstring(content if marker < 0 else content[:begin] + content[end:])
    except xml.etree.ElementTree.ParseError as fault:
        raise ValueError(f"{file} was not written by Drystone: {fault}") from None
    order = "<" if root.get("byte_order") == "LittleEndian" else ">"
    size = struct.Struct(order + {"UInt32": "I", "UInt64": "Q"}[root.get("header_type", "UInt32")])
    compressed = root.get("compressor") is not None

    def bytesOf(element):
        """Header and data."""
        if element.get("format") == "appended":
            return content[begin + int(element.get("offset")):end]
        text = element.text.strip()
        # The header is encoded for itself: its first number says how many follow.
        count = size.unpack_from(base64.b64decode(text[:16]))[0] + 3 if compressed else 1
        letters = (count * size.size + 2) // 3 * 4
        return base64.b64decode(text[:letters]) + base64.b64decode(text[letters:])

    def read(element):
        raw = bytesOf(element)
        if compressed:
            count = size.unpack_from(raw)[0]
            at, data = (3 + count) * size.size, b""
            for i in range(count):
                length = size.unpack_from(raw, (3 + i) * size.size)[0]
                data += zlib.decompress(raw[at:at + length])
                at += length
        else:
            data = raw[size.size:size.size + size.unpack_from(raw)[0]]
        code = _formats[element.get("type")]
        return struct.unpack(f"{order}{len(data) // struct.calcsize(code)}{code}", data)

    return root, read


def readFrame(file, time=0.0):
    """Reads one .vtp file that Drystone wrote. Raises ValueError for another one."""
    root, read = _arrays(file)
    piece = root.find("PolyData/Piece")
    fields = {kind: {element.get("Name"): rows(read(element), int(element.get("NumberOfComponents", 1)))
                     for element in piece.iterfind(kind + "/DataArray")} for kind in ("CellData", "PointData")}
    points = rows(read(piece.find("Points/DataArray")), 3)
    if int(piece.get("NumberOfPolys", 0)) == 0:
        return Frame(time, points, {**fields["CellData"], **fields["PointData"]})
    indices, ends = (read(piece.find(f"Polys/DataArray[@Name='{name}']")) for name in ("connectivity", "offsets"))
    polygons = [indices[begin:end] for begin, end in zip((0, *ends), ends)]
    return Frame(time, points, fields["CellData"], fields["PointData"], polygons)


def readSeries(folder, name="blocks"):
    """The frames of <folder>/<name>.vtp.series, one after the other, read as they are requested."""
    folder = Path(folder)
    series = json.loads((folder / (name + ".vtp.series")).read_text(encoding="utf-8"))
    for entry in series["files"]:
        yield readFrame(folder / entry["name"], entry["time"])
