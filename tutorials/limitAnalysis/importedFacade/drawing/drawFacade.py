#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the facade as an architect's program would: closed polylines in millimetres, arcs as bulges, layers by material.

drawFacade.py OUT.dxf OUT.svg

A doorway of 1.5 m under a round arch of nine voussoirs; courses on both sides end at the joints of the arch, as courses
of dressed stone do.
"""
import math
import sys

width, centre, spring = 4000.0, 2000.0, 1500.0
inner, outer = 750.0, 1050.0
voussoirs = 9
polylines = []  # (layer, [(x, y, bulge)])


def onRing(radius, angle):
    return centre + radius * math.cos(angle), spring + radius * math.sin(angle)


def box(layer, left, right, low, high):
    polylines.append((layer, [(left, low, 0), (right, low, 0), (right, high, 0), (left, high, 0)]))


# Pillars: courses of 250 mm, of one long stone or two.
for side in (0, 1):
    left, right = (0, centre - inner) if side == 0 else (centre + inner, width)
    for course in range(6):
        low, high = 250.0 * course, 250.0 * (course + 1)
        cuts = [left, left + (right - left) * (0.4 if course % 2 else 0.6), right]
        for from_, to in zip(cuts, cuts[1:]):
            box("pillars", from_, to, low, high)

# The arch: from right to left, inner arcs run back.
angles = [math.pi * i / voussoirs for i in range(voussoirs + 1)]
bulge = math.tan(math.pi / voussoirs / 4)
for first, second in zip(angles, angles[1:]):
    polylines.append(("voussoirs", [(*onRing(inner, first), 0), (*onRing(outer, first), bulge),
                                    (*onRing(outer, second), 0), (*onRing(inner, second), -bulge)]))

# Courses beside the arch, between the heights of its joints; each ends with the arc.
for i in range(4):
    low, high = spring + outer * math.sin(angles[i]), spring + outer * math.sin(angles[i + 1])
    for side in (0, 1):
        atLow, atHigh = outer * math.cos(angles[i]), outer * math.cos(angles[i + 1])
        wall = width - centre
        cut = (wall + atLow) / 2 + (100 if i % 2 else -100)  # from the axis
        cut = max(cut, atLow + 150)
        mirror = 1 if side == 1 else -1
        corners = [(cut, low, 0), (cut, high, 0), (atHigh, high, -bulge), (atLow, low, 0)]
        polylines.append(("bricks", [(centre + mirror * x, y, mirror * b) for x, y, b in corners]))
        a, b = sorted((centre + mirror * cut, centre + mirror * wall))
        box("bricks", a, b, low, high)

# Over the keystone, and a parapet.
low, high = spring + outer * math.sin(angles[4]), spring + outer + 250
edge = outer * math.cos(angles[4])
polylines.append(("bricks", [(centre - 500, low, 0), (centre - edge, low, -bulge), (centre + edge, low, 0),
                             (centre + 500, low, 0), (centre + 500, high, 0), (centre - 500, high, 0)]))
for left, right in ((0, 750), (750, 1500), (2500, 3250), (3250, 4000)):
    box("bricks", left, right, low, high)
for left in range(0, 4000, 800):
    box("parapet", left, left + 800, high, high + 300)


def group(code, value):
    return f"{code:3}\n{value}\n"


def dxf():
    layers = sorted({layer for layer, _ in polylines})
    text = group(0, "SECTION") + group(2, "HEADER") + group(9, "$ACADVER") + group(1, "AC1015") + group(9, "$INSUNITS")
    text += group(70, 4) + group(0, "ENDSEC") + group(0, "SECTION") + group(2, "TABLES") + group(0, "TABLE")
    text += group(2, "LAYER") + group(70, len(layers))
    for colour, layer in enumerate(layers, start=1):
        text += group(0, "LAYER") + group(2, layer) + group(70, 0) + group(62, colour) + group(6, "CONTINUOUS")
    text += group(0, "ENDTAB") + group(0, "ENDSEC") + group(0, "SECTION") + group(2, "ENTITIES")
    for layer, corners in polylines:
        text += group(0, "LWPOLYLINE") + group(8, layer) + group(90, len(corners)) + group(70, 1)
        for x, y, b in corners:
            text += group(10, f"{x:.6f}") + group(20, f"{y:.6f}")
            if b:
                text += group(42, f"{b:.12f}")
    text += group(0, "TEXT") + group(8, "bricks") + group(10, 0) + group(20, -200) + group(40, 100) + group(1, "facade")
    return text + group(0, "ENDSEC") + group(0, "EOF")


def svg():
    colours = {"pillars": "#c9bfae", "voussoirs": "#b98d5f", "bricks": "#c4785b", "parapet": "#a9a9a0"}
    text = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-50 -50 4100 3250" width="410">\n'
    for layer, corners in polylines:
        path = f"M{corners[0][0]:.1f},{3100 - corners[0][1]:.1f}"
        for i, (_, _, b) in enumerate(corners):
            x, y, _ = corners[(i + 1) % len(corners)]
            x0, y0, _ = corners[i]
            if b:
                chord = math.hypot(x - x0, y - y0)
                radius = chord * (1 + b * b) / (4 * abs(b))
                path += f"A{radius:.1f},{radius:.1f} 0 0 {1 if b < 0 else 0} {x:.1f},{3100 - y:.1f}"
            else:
                path += f"L{x:.1f},{3100 - y:.1f}"
        text += f'<path d="{path}Z" fill="{colours[layer]}" stroke="#333" stroke-width="8"/>\n'
    return text + "</svg>\n"


with open(sys.argv[1], "w", encoding="ascii") as file:
    file.write(dxf())
with open(sys.argv[2], "w", encoding="ascii") as file:
    file.write(svg())
