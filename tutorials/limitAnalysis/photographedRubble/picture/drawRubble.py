#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a wall of rubble as a camera would see it: dark stones of uneven grey, light mortar, noise.

drawRubble.py OUT.png

Stones are the cells of scattered points, longer than high; a pixel that is nearly as far from the second point as from
the first is mortar.
"""
import random
import struct
import sys
import zlib

width, height = 480, 320
left, right, top, bottom = 30, 450, 25, 295
columns, rows = 9, 8
flat = 2.2  # stones are this much longer than high
chance = random.Random(5)

points = []
for row in range(rows):
    for column in range(-1, columns + 1):
        x = left + (column + 0.5 + 0.5 * (row % 2) + chance.uniform(-0.22, 0.22)) * (right - left) / columns
        y = top + (row + 0.5 + chance.uniform(-0.15, 0.15)) * (bottom - top) / rows
        points.append((x, y, chance.randint(60, 105)))

pixels = bytearray()
for y in range(height):
    pixels.append(0)  # no filter in this row
    for x in range(width):
        value = 225
        if left <= x < right and top <= y < bottom:
            near = sorted(((px - x) ** 2 + (flat * (py - y)) ** 2, shade) for px, py, shade in points)[:2]
            if near[1][0] ** 0.5 - near[0][0] ** 0.5 > 5:
                value = near[0][1]
        pixels.append(max(0, min(255, value + 7 * chance.randint(-2, 2))))


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


with open(sys.argv[1], "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0))
               + chunk(b"IDAT", zlib.compress(bytes(pixels), 9)) + chunk(b"IEND", b""))
