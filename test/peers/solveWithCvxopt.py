#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Solves a cone program, as libs/conic/ProgramFile.h describes the file, with CVXOPT's coneqp.

    solveWithCvxopt.py PROGRAM SOLUTION TOLERANCE

SOLUTION gets CPU seconds, iterations, alpha, the contact forces and the displacements, one after the other.
"""
import re
import sys
import time

from cvxopt import matrix, solvers, spmatrix


def parse(text):
    """The entries of a dictionary of words, numbers and nested lists, N(...) and (...) alike."""
    text = re.sub(r"//[^\n]*", "", text)
    tokens = re.findall(r"[(){};]|[^\s(){};]+", text)
    place = 0

    def value():
        nonlocal place
        token = tokens[place]
        place += 1
        if token == "(":
            items = []
            while tokens[place] != ")":
                items.append(value())
            place += 1
            return items
        return float(token)

    entries = {}
    while place < len(tokens):
        key = tokens[place]
        place += 1
        if tokens[place] == "{":
            while tokens[place] != "}":
                place += 1
            place += 1
            continue
        if re.fullmatch(r"\d+", tokens[place]) and tokens[place + 1] == "(":
            place += 1  # the length of the list
        entries[key] = value()
        place += 1
    return entries


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        program = parse(file.read())
    tolerance = float(sys.argv[3])
    forces = int(program["dimensions"])
    rows = 3 if forces == 2 else 6
    bodies = int(program["bodies"])
    contacts = program["contacts"]
    points = len(contacts)
    load = program["load"]
    live = program.get("liveLoad")
    gap = program.get("gap", [0.0] * (forces * points))
    # Unknowns: displacements y (with inertia only), s of each point in a standard cone, alpha.
    #   minimise 1/2 y'My + g's - alpha   subject to   M y + B s - alpha L = f,   s in K
    # c = T s: in the plane the two edges of the cone, in space a second-order cone. Loads over the largest,
    # inertia over its largest.
    scale = max(map(abs, load + (live or []))) or 1.0
    heaviest = max((abs(number) for block in program.get("inertia", []) for number in block), default=1.0)
    length = scale / heaviest  # of displacements with inertia
    inertia = program.get("inertia")
    first = rows * bodies if inertia else 0
    size = first + forces * points + (1 if live else 0)

    def basis(mu):
        if forces == 2:
            return [[1, 1], [mu, -mu]]
        return [[1, 0, 0], [0, mu, 0], [0, 0, mu]]

    i, j, x = [], [], []
    q = [0.0] * size
    for point, (one, other, onOne, onOther) in enumerate(contacts):
        cone = basis(program["friction"][point])
        for column in range(forces):
            for body, part in ((int(one), onOne), (int(other), onOther)):
                for row in range(rows if body >= 0 else 0):
                    entry = sum(part[row * forces + k] * cone[k][column] for k in range(forces))
                    if entry:
                        i.append(rows * body + row)
                        j.append(first + forces * point + column)
                        x.append(entry)
            q[first + forces * point + column] = sum(gap[forces * point + k] * cone[k][column]
                                                     for k in range(forces)) / (length if inertia else 1)
    p = spmatrix([], [], [], (size, size))
    if inertia:
        for body, block in enumerate(inertia):
            for row in range(rows):
                for column in range(rows):
                    entry = block[row * rows + column] / heaviest
                    if entry:
                        p[rows * body + row, rows * body + column] = entry
                        i.append(rows * body + row)
                        j.append(rows * body + column)
                        x.append(entry)
    if live:
        q[-1] = -1.0
        for row, entry in enumerate(live):
            if entry:
                i.append(row)
                j.append(size - 1)
                x.append(-entry / scale)
    a = spmatrix(x, i, j, (rows * bodies, size))
    b = matrix([entry / scale for entry in load])
    g = spmatrix(-1.0, range(forces * points), range(first, first + forces * points), (forces * points, size))
    h = matrix(0.0, (forces * points, 1))
    dims = {"l": forces * points, "q": [], "s": []} if forces == 2 else {"l": 0, "q": [3] * points, "s": []}
    solvers.options.update(show_progress=False, abstol=tolerance, reltol=tolerance, feastol=tolerance, maxiters=100)
    start = time.process_time()
    answer = solvers.coneqp(p, matrix(q), g, h, dims, a, b)
    seconds = time.process_time() - start
    force = []
    for point in range(points):
        cone = basis(program["friction"][point])
        s = answer["x"][first + forces * point:first + forces * (point + 1)]
        force += [scale * sum(cone[k][column] * s[column] for column in range(forces)) for k in range(forces)]
    # Multipliers of the balance are -y; with inertia y itself is there, of the scale of lengths.
    y = [-entry / scale for entry in answer["y"]]
    if inertia:
        y = [length * entry for entry in answer["x"][:first]]
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        print(seconds, answer["iterations"], answer["x"][size - 1] if live else 0.0, file=file)
        for entry in force + y:
            print(repr(float(entry)), file=file)


main()
