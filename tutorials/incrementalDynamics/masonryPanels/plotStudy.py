#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Draws study/fragility.dat: plotStudy.py TABLE PICTURE

a_g/alpha of each wall over the solver's tolerance (left) and over the gaps of the joints (right): above with the
associative law, below with Coulomb's. The marks at the right edge are the a_g of the paper.
"""
import math
import sys

colours = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#444444"]
paper = [0.641 / 0.642859, 0.568 / 0.579999, 0.387 / 0.403694, 0.307 / 0.331948, 0.229 / 0.239643, 0.302 / 0.347825]
nonAssociative = [0.638982 / 0.642859, 0.557416 / 0.579999, 0.355817 / 0.403694, 0.263736 / 0.331948,
                  0.208629 / 0.239643, 0.295 / 0.347825]
width, height, left, top = 340, 190, 64, 56
low, high = 0.70, 1.02


def main():
    rows = [list(map(float, line.split())) for line in open(sys.argv[1], encoding="utf-8") if line[0] != "#"]
    out = []

    def text(x, y, words, anchor="middle", size=12, more=""):
        out.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}" {more}>{words}</text>')

    def line(x1, y1, x2, y2, colour, more=""):
        out.append(f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" {more}/>')

    def panel(x0, y0, rule, ticks, positionOf, label):
        def y(ratio):
            return y0 + height * (high - ratio) / (high - low)

        for i in range(round((high - low) / 0.05) + 1):
            ratio = 0.70 + 0.05 * i
            line(x0, y(ratio), x0 + width, y(ratio), "#dddddd")
            text(x0 - 6, y(ratio) + 4, f"{ratio:.2f}", "end", 11)
        for i, words in enumerate(ticks):
            x = x0 + width * (i + 0.5) / len(ticks)
            line(x, y0, x, y0 + height, "#eeeeee")
            text(x, y0 + height + 15, words, size=11)
        text(x0 + width / 2, y0 + height + 31, label)
        out.append(f'<rect x="{x0}" y="{y0}" width="{width}" height="{height}" fill="none" stroke="#888888"/>')
        for wall in range(6):
            points = []
            for row in rows:
                place = positionOf(row)
                if row[0] == wall + 1 and row[1] == rule and place is not None and math.isfinite(row[5]):
                    points.append((x0 + width * (place + 0.5) / len(ticks), y(row[5])))
            points.sort()
            path = " ".join(f"{px:.1f},{py:.1f}" for px, py in points)
            out.append(f'<polyline points="{path}" fill="none" stroke="{colours[wall]}" stroke-width="1.5"/>')
            for px, py in points:
                out.append(f'<circle cx="{px:.1f}" cy="{py:.1f}" r="3" fill="{colours[wall]}"/>')
            mark = paper if rule == 0 else nonAssociative
            line(x0 + width - 12, y(mark[wall]), x0 + width + 6, y(mark[wall]), colours[wall], 'stroke-width="3"')

    tolerances = ["1e-12", "1e-10", "1e-8", "1e-6", "1e-4"]
    gaps = ["0", "1e-12", "1e-10", "1e-8", "1e-6"]

    def byTolerance(row):
        return round(math.log10(row[2]) + 12) / 2 if row[3] == 0 else None

    def byGap(row):
        return (0 if row[3] == 0 else (round(math.log10(row[3])) + 14) / 2) if row[2] == 1e-12 else None

    for rule, name, marks in ((0, "associative law", "marks: a_g of the paper"),
                              (1, "Coulomb's law (nonAssociative)", "marks: least multiplier without dilatancy")):
        y0 = top + rule * (height + 78)
        text(left, y0 - 8, f"{name}; {marks}", "start", 12, 'font-weight="bold"')
        panel(left, y0, rule, tolerances, byTolerance, "tolerance of the solver, joints that fit")
        panel(left + width + 70, y0, rule, gaps, byGap, "gaps of the joints, 0 to this [m], tolerance 1e-12")
    for wall in range(6):
        x = left + 2 * width + 100
        line(x, top + 14 + 20 * wall, x + 20, top + 14 + 20 * wall, colours[wall], 'stroke-width="2"')
        text(x + 26, top + 18 + 20 * wall, f"wall {wall + 1}", "start")
    text(left, 24, "a_g/alpha: acceleration that starts motion over the associative multiplier", "start", 15)
    total = (left + 2 * width + 190, top + 2 * (height + 78) - 20)
    picture = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{total[0]}" height="{total[1]}" '
               f'font-family="sans-serif"><rect width="100%" height="100%" fill="white"/>\n' + "\n".join(out) + "\n</svg>\n")
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(picture)


if __name__ == "__main__":
    main()
