#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Solves cone programs, as libs/conic/ProgramFile.h describes their files, with CVXOPT's coneqp: one for each line

    PROGRAM SOLUTION TOLERANCE

of standard input, answered by a line, `solved` or a reason why it was not. SOLUTION gets CPU seconds, iterations,
alpha, the contact forces and the displacements, one after the other.
"""
import re
import signal
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


def solve_in_forces(program, tolerance):
    """Limit analysis of points with strengths, in the forces c and alpha, both over the largest load:
      minimise -alpha   subject to   A c - alpha L = f,   -T <= c_n <= N,   |c_t| <= C + mu c_n
    The multipliers of the equations are -y."""
    forces = int(program["dimensions"])
    rows = 3 if forces == 2 else 6
    contacts = program["contacts"]
    points = len(contacts)
    size = rows * int(program["bodies"])
    scale = max(map(abs, program["load"] + program["liveLoad"])) or 1.0
    unknowns = forces * points + 1
    i, j, x = [], [], []
    for point, (one, other, onOne, onOther) in enumerate(contacts):
        for body, part in ((int(one), onOne), (int(other), onOther)):
            for row in range(rows if body >= 0 else 0):
                for k in range(forces):
                    if part[row * forces + k]:
                        i.append(rows * body + row)
                        j.append(forces * point + k)
                        x.append(part[row * forces + k])
    for row, entry in enumerate(program["liveLoad"]):
        if entry:
            i.append(row)
            j.append(unknowns - 1)
            x.append(-entry / scale)
    a = spmatrix(x, i, j, (size, unknowns))
    b = matrix([entry / scale for entry in program["load"]])
    # Linear rows first, then the cones (C + mu n, t): G x + s = h.
    i, j, x, h = [], [], [], []
    for point, (_, tension, crushing) in enumerate(program["strength"]):
        for sign, limit in ((-1.0, tension), (1.0, crushing)):
            if limit != float("inf"):
                i.append(len(h))
                j.append(forces * point)
                x.append(sign)
                h.append(limit / scale)
    linear = len(h)
    for point, (cohesion, _, _) in enumerate(program["strength"]):
        for k in range(forces):
            i.append(len(h))
            j.append(forces * point + k)
            x.append(-1.0 if k else -program["friction"][point])
            h.append(0.0 if k else cohesion / scale)
    g = spmatrix(x, i, j, (len(h), unknowns))
    q = matrix([0.0] * (unknowns - 1) + [-1.0])
    dims = {"l": linear, "q": [forces] * points, "s": []}
    solvers.options.update(show_progress=False, abstol=tolerance, reltol=tolerance, feastol=tolerance, maxiters=100)
    start = time.process_time()
    answer = solvers.conelp(q, g, matrix(h), dims, a, b)
    seconds = time.process_time() - start
    return (seconds, answer["iterations"], answer["x"][unknowns - 1], [scale * c for c in answer["x"][:unknowns - 1]],
            [-entry / scale for entry in answer["y"]])


def solve_in_displacements(program, tolerance):
    """Where the matrix that CVXOPT factorises is as sparse as the blocks touch:
      minimise 1/2 y'My - f'y   subject to   z = g - B'y in K,   L'y = 1
    with multipliers s in K of z and -alpha of L'y = 1. c = T s: in the plane the two edges of the cone, in space a
    second-order cone. Loads are over the largest, inertia over its largest."""
    forces = int(program["dimensions"])
    rows = 3 if forces == 2 else 6
    bodies = int(program["bodies"])
    contacts = program["contacts"]
    points = len(contacts)
    load = program["load"]
    live = program.get("liveLoad")
    gap = program.get("gap", [0.0] * (forces * points))
    scale = max(map(abs, load + (live or []))) or 1.0
    heaviest = max((abs(number) for block in program.get("inertia", []) for number in block), default=1.0)
    inertia = program.get("inertia")
    length = scale / heaviest if inertia else 1.0  # of displacements
    size = rows * bodies

    def basis(mu):
        if forces == 2:
            return [[1, 1], [mu, -mu]]
        return [[1, 0, 0], [0, mu, 0], [0, 0, mu]]

    i, j, x = [], [], []
    h = []
    for point, (one, other, onOne, onOther) in enumerate(contacts):
        cone = basis(program["friction"][point])
        for column in range(forces):
            for body, part in ((int(one), onOne), (int(other), onOther)):
                for row in range(rows if body >= 0 else 0):
                    entry = sum(part[row * forces + k] * cone[k][column] for k in range(forces))
                    if entry:
                        i.append(forces * point + column)
                        j.append(rows * body + row)
                        x.append(entry)
            h.append(sum(gap[forces * point + k] * cone[k][column] for k in range(forces)) / length)
    g = spmatrix(x, i, j, (forces * points, size))
    p = spmatrix([], [], [], (size, size))
    for body, block in enumerate(inertia or []):
        for row in range(rows):
            for column in range(rows):
                if block[row * rows + column]:
                    p[rows * body + row, rows * body + column] = block[row * rows + column] / heaviest
    q = matrix([-entry / scale for entry in load])
    a = matrix([entry / scale for entry in live], (1, size)) if live else spmatrix([], [], [], (0, size))
    b = matrix([1.0]) if live else matrix(0.0, (0, 1))
    dims = {"l": forces * points, "q": [], "s": []} if forces == 2 else {"l": 0, "q": [3] * points, "s": []}
    solvers.options.update(show_progress=False, abstol=tolerance, reltol=tolerance, feastol=tolerance, maxiters=100)
    start = time.process_time()
    answer = solvers.coneqp(p, q, g, matrix(h), dims, a, b)
    seconds = time.process_time() - start
    force = []
    for point in range(points):
        cone = basis(program["friction"][point])
        s = answer["z"][forces * point:forces * (point + 1)]
        force += [scale * sum(cone[k][column] * s[column] for column in range(forces)) for k in range(forces)]
    # L over `scale` does unit work on y, so L itself does `scale`.
    y = [entry * length / (scale if live else 1.0) for entry in answer["x"]]
    return seconds, answer["iterations"], -answer["y"][0] if live else 0.0, force, y


def solve(program_file, solution_file, tolerance):
    with open(program_file, encoding="utf-8") as file:
        program = parse(file.read())
    in_forces = "strength" in program and "liveLoad" in program and "inertia" not in program and "gap" not in program
    method = solve_in_forces if in_forces else solve_in_displacements
    seconds, iterations, alpha, force, displacement = method(program, tolerance)
    with open(solution_file, "w", encoding="utf-8") as file:
        print(seconds, iterations, alpha, file=file)
        for entry in force + displacement:
            print(repr(float(entry)), file=file)


def give_up(*_):
    raise TimeoutError(f"no answer within {longest} s")


longest = 300
signal.signal(signal.SIGALRM, give_up)
for line in sys.stdin:
    program_file, solution_file, tolerance = line.split()
    signal.alarm(longest)
    try:
        solve(program_file, solution_file, float(tolerance))
        answer = "solved"
    except Exception as error:  # CVXOPT ends some programs so: the next may be another
        answer = " ".join(repr(error).split())
    signal.alarm(0)
    print(answer, flush=True)
