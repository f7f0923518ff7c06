# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Writes twentySpans/system/blocks: the stones of a viaduct, and its two abutments last, corner by corner.

    python3 blocks.py [SPANS]    semicircular arches on piers; default: 20
"""
import math
import pathlib
import sys

SPANS = int(sys.argv[1]) if len(sys.argv) > 1 else 20
RADIUS, RING, VOUSSOIRS = 4.0, 0.6, 25  # of the centreline; thickness [m]
BETWEEN = 0.2  # two arches, at their springings [m]
STONES, COURSE = 12, 0.6  # of a pier; height of one [m]

INSIDE, OUTSIDE = RADIUS - RING / 2, RADIUS + RING / 2
PITCH = 2 * OUTSIDE + BETWEEN
SPRINGING = STONES * COURSE


def box(left, right, bottom, top):
    return [(left, bottom), (right, bottom), (right, top), (left, top)]


def voussoir(span, number):
    def corner(radius, joint):
        angle = math.pi * (1 - joint / VOUSSOIRS)
        return span * PITCH + radius * math.cos(angle), SPRINGING + radius * math.sin(angle)

    return [corner(INSIDE, number), corner(INSIDE, number + 1), corner(OUTSIDE, number + 1), corner(OUTSIDE, number)]


def pier(number):
    """Under the springings of two arches."""
    middle = PITCH * (number - 0.5)
    half = BETWEEN / 2 + RING
    return [box(middle - half, middle + half, COURSE * stone, COURSE * (stone + 1)) for stone in range(STONES)]


blocks = [voussoir(span, number) for span in range(SPANS) for number in range(VOUSSOIRS)]
blocks += [stone for number in range(1, SPANS) for stone in pier(number)]
end = PITCH * (SPANS - 1) + OUTSIDE
blocks += [box(-OUTSIDE - 2, -OUTSIDE + RING, 0, SPRINGING), box(end - RING, end + 2, 0, SPRINGING)]

lines = ["    (" + " ".join(f"({x:.12g} {y:.12g})" for x, y in block) + ")" for block in blocks]
pathlib.Path("twentySpans/system/blocks").write_text("\n".join(["blocks", "(", *lines, ");", ""]), encoding="utf-8")
print(f"{len(blocks)} blocks")
