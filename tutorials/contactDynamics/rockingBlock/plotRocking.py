#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the rotation of a freely rocking block: plotRocking.py block1.dat PICTURE

The line is what contactDynamics has computed; the circles are Housner's equation, integrated from one impact to the next
by the method of Runge and Kutta of order 4 in steps of 1e-4 s, each impact at its instant to the last digits.
"""
import math
import sys

radius, slenderness, gravity = math.hypot(0.25, 1), math.atan(0.25), 9.81
square = 3 * gravity / (4 * radius)
impactRatio = 1 - 1.5 * math.sin(slenderness) ** 2


def advanced(state, side, step):
    """Rotation and its rate after a step about the corner of this side (1 or -1)."""
    def rate(y):
        return y[1], -square * side * math.sin(slenderness - side * y[0])

    def moved(slope, length):
        return state[0] + length * slope[0], state[1] + length * slope[1]

    first = rate(state)
    second = rate(moved(first, step / 2))
    third = rate(moved(second, step / 2))
    fourth = rate(moved(third, step))
    return tuple(state[i] + step / 6 * (first[i] + 2 * second[i] + 2 * third[i] + fourth[i]) for i in range(2))


def housner(start, end, step=1e-4):
    """Rotations at the multiples of the step, and the instants of the impacts."""
    time, state, side = 0.0, (start, 0.0), 1
    rotations, impacts = [start], []
    for index in range(1, round(end / step) + 1):
        rest = index * step - time
        after = advanced(state, side, rest)
        while side * after[0] < 0:
            short, long = 0.0, rest
            for _ in range(60):
                middle = (short + long) / 2
                short, long = (middle, long) if side * advanced(state, side, middle)[0] > 0 else (short, middle)
            upright = advanced(state, side, long)
            time += long
            impacts.append(time)
            side, state, rest = -side, (0.0, impactRatio * upright[1]), rest - long
            after = advanced(state, side, rest)
        time, state = index * step, after
        rotations.append(state[0])
    return rotations, impacts


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = [tuple(map(float, row.split())) for row in file if not row.startswith("#")]
    instants, rotations = [row[0] for row in rows], [row[3] for row in rows]
    exact, impacts = housner(slenderness / 2, instants[-1])
    worst = max(abs(rotation - exact[round(instant / 1e-4)]) for instant, rotation in zip(instants, rotations))

    left, top, width, height, reach = 70, 60, 640, 300, 0.14
    out = []

    def x(time):
        return left + width * time / instants[-1]

    def y(rotation):
        return top + height * (reach - rotation) / (2 * reach)

    def text(across, down, words, anchor="middle", size=12):
        out.append(f'<text x="{across:.1f}" y="{down:.1f}" text-anchor="{anchor}" font-size="{size}">{words}</text>')

    def line(x1, y1, x2, y2, colour):
        out.append(f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}"/>')

    text(left, 24, "Free rocking of a block 0.5 x 2.0 m from half its critical angle: theta 1, deltaT 1e-4 s", "start", 15)
    text(left, 44, f"line: contactDynamics; circles: Housner's equation, {len(impacts)} impacts; "
                   f"largest difference {worst:.1e} rad", "start")
    for i in range(round(2 * instants[-1]) + 1):
        line(x(i / 2), top, x(i / 2), top + height, "#e2e2e2")
        text(x(i / 2), top + height + 18, f"{i / 2:g}")
    for i in range(-2, 3):
        line(left, y(0.05 * i), left + width, y(0.05 * i), "#e2e2e2" if i else "#888888")
        text(left - 8, y(0.05 * i) + 4, f"{0.05 * i:g}", "end")
    text(left + width / 2, top + height + 38, "time [s]")
    out.append(f'<text transform="translate(18 {top + height / 2}) rotate(-90)" text-anchor="middle" font-size="12">'
               "rotation [rad]</text>")
    path = " ".join(f"{x(t):.1f},{y(r):.1f}" for t, r in list(zip(instants, rotations))[::50])
    out.append(f'<polyline points="{path}" fill="none" stroke="#0072B2" stroke-width="2"/>')
    for index in range(0, len(exact), 1000):
        out.append(f'<circle cx="{x(index * 1e-4):.1f}" cy="{y(exact[index]):.1f}" r="4" fill="none" stroke="#D55E00"/>')
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{left + width + 30}" height="{top + height + 56}" '
                   'font-family="sans-serif"><rect width="100%" height="100%" fill="white"/>\n' + "\n".join(out) + "\n</svg>\n")


if __name__ == "__main__":
    main()
