#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what LimitAnalysisBenchmark kept: factorisations, and time in units F of one factorisation, by our own factor and
by CHOLMOD's, over blocks.

    test/benchmark/drawLimitAnalysis.py limitAnalysis.csv limitAnalysis.svg
"""
import csv
import math
import sys

width, height, margin = 640, 400, 60
series = {"factorisations": "#1f5f9f", "solve[F]": "#b03a2e", "solve[CHOLMOD F]": "#d58a2b"}
names = {"factorisations": "factorisations", "solve[F]": "time [F]", "solve[CHOLMOD F]": "time [CHOLMOD's F]"}


def readResults(path):
    """Rows (name, blocks, value of each series) of walls that stand, of the CSV, whose head is not of the table."""
    with open(path) as file:
        lines = file.read().splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("name,"))
    return [(row["name"].split("/")[0], float(row["blocks"]), {key: float(row[key]) for key in series})
            for row in csv.DictReader(lines[start:])
            if row["blocks"] and row["name"].startswith(("paperWall", "squareWall"))]


def decades(values):
    return math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    rows = readResults(sys.argv[1])
    fromX, toX = decades([blocks for _, blocks, _ in rows])
    fromY, toY = decades([value for _, _, values in rows for value in values.values()])

    def x(blocks):
        return margin + (width - 2 * margin) * (math.log10(blocks) - fromX) / (toX - fromX)

    def y(value):
        return height - margin - (height - 2 * margin) * (math.log10(value) - fromY) / (toY - fromY)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
           'font-size="12">', f'<rect width="{width}" height="{height}" fill="white"/>']
    for exponent in range(fromX, toX + 1):
        at = x(10.0**exponent)
        out.append(f'<path d="M{at:.1f} {margin}V{height - margin}" stroke="#ddd"/>'
                   f'<text x="{at:.1f}" y="{height - margin + 18}" text-anchor="middle">{10**exponent}</text>')
    for exponent in range(fromY, toY + 1):
        at = y(10.0**exponent)
        out.append(f'<path d="M{margin} {at:.1f}H{width - margin}" stroke="#ddd"/>'
                   f'<text x="{margin - 6}" y="{at + 4:.1f}" text-anchor="end">{10**exponent}</text>')
    out.append(f'<text x="{width / 2}" y="{height - 15}" text-anchor="middle">blocks</text>')
    for index, (key, colour) in enumerate(series.items()):
        square = [(x(blocks), y(values[key])) for name, blocks, values in rows if name == "squareWall"]
        if square:
            out.append(f'<polyline points="{" ".join(f"{a:.1f},{b:.1f}" for a, b in square)}" fill="none" '
                       f'stroke="{colour}" stroke-width="1.5"/>')
        for name, blocks, values in rows:
            fill = colour if name == "squareWall" else "white"
            out.append(f'<circle cx="{x(blocks):.1f}" cy="{y(values[key]):.1f}" r="3.5" fill="{fill}" '
                       f'stroke="{colour}"/>')
        out.append(f'<text x="{margin + 10}" y="{height - margin - 68 + 18 * index}" fill="{colour}">{names[key]}</text>')
    out.append(f'<text x="{margin + 10}" y="{height - margin - 14}">open: the paper\'s walls, filled: square walls</text>')
    out.append("</svg>")
    with open(sys.argv[2], "w") as file:
        file.write("\n".join(out) + "\n")


main()
