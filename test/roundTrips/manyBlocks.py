#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""A wall of 100,000 bricks from its OBJ file: blocks, supports, joints and files written in seconds.

manyBlocks.py BIN
"""
import pathlib
import resource
import subprocess
import sys
import tempfile

application = pathlib.Path(sys.argv[1]).resolve() / "blockTexture"
length, depth, height = 0.25, 0.125, 0.065
alongWall, through, courses = 100, 25, 40
corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
faces = ((1, 4, 3, 2), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8))
mostSeconds = 60  # of processor time; 7 on a machine of 2026


def obj():
    first = 0
    for course in range(courses):
        for row in range(through):
            for brick in range(alongWall):
                x, y, z = length * (brick + course % 2 / 2), depth * row, height * course
                yield f"o brick_{first // 8}\n"
                for a, b, c in corners:
                    yield f"v {x + a * length!r} {y + b * depth!r} {z + c * height!r}\n"
                for face in faces:
                    yield "f " + " ".join(str(first + vertex) for vertex in face) + "\n"
                first += 8


with tempfile.TemporaryDirectory() as scratch:
    case = pathlib.Path(scratch)
    (case / "system").mkdir()
    (case / "wall.obj").write_text("".join(obj()), encoding="ascii")
    (case / "system/blockTextureDict").write_text(
        'dimensions 3;\ntexture { type import; file "wall.obj"; }\nsupports { ground { type ground; } }\n',
        encoding="ascii")
    done = subprocess.run([application, "-case", case], capture_output=True, text=True, check=False)
    print(done.stdout[-600:] + done.stderr)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = used.ru_utime + used.ru_stime
    blocks = alongWall * through * courses
    print(f"{blocks} blocks, {(case / 'wall.obj').stat().st_size / 1e6:.0f} MB of OBJ: {seconds:.1f} s of processor "
          f"time, {used.ru_maxrss / 1024:.0f} MB")
    # On the ground, beside and behind each other in a course, and half on each of two below.
    joints = (alongWall * through + courses * ((alongWall - 1) * through + alongWall * (through - 1))
              + (courses - 1) * through * (2 * alongWall - 1))
    if done.returncode != 0 or f"Blocks: {blocks} free, 1 fixed\nJoints: {joints} with {4 * joints} " not in done.stdout:
        sys.exit(f"Not the wall that was written, which has {joints} joints")
    if seconds > mostSeconds:
        sys.exit(f"More than {mostSeconds} s")
