#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Damaged copies of imported files, one process each: blocks, or an error that says what is wrong; no crash, no hang.

damagedImports.py BIN ROOT few|all [COPIES]     few: 4 copies of each file, all: 2,000
"""
import concurrent.futures
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

applications, root = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
copies = int(sys.argv[4]) if len(sys.argv) > 4 else 4 if sys.argv[3] == "few" else 2000
words = [b"nan", b"-1", b"0", b"1e308", b"2147483648", b"1e-320", b"{", b"]", b"\"", b"\n", b"<", b"\0", b"999999999999"]

plane = {"dxf": "type import;", "svg": "type import;",
         "png": "type image; points ((0 0) (10 0)); distance 1; leastArea 3; mortar 4;"}
solid = {"obj": "", "ply": "", "stl": "", "compasJson": "interfaces contacts;"}


def samples():
    """(format, bytes) of each sample file: the corpus of fuzzing, and the files of tutorials where they are small."""
    for format_ in [*plane, *solid]:
        for file in sorted((root / "test/fuzz" / format_).iterdir()):
            if not re.fullmatch("[0-9a-f]{10,}", file.name):  # those with a number for a name come from fuzzing
                yield f"{format_}/{file.name}", format_, file.read_bytes()
    ending = {".obj": "obj", ".json": "compasJson", ".dxf": "dxf", ".svg": "svg", ".png": "png"}
    for file in sorted((root / "tutorials").glob("**/constant/triSurface/*")) + sorted(
            (root / "tutorials").glob("**/structures/*")):
        if file.suffix in ending and file.stat().st_size < 200000:
            yield str(file.relative_to(root)), ending[file.suffix], file.read_bytes()


def damaged(data, chance):
    data = bytearray(data)
    for _ in range(chance.randint(1, 5)):
        at = chance.randrange(len(data) + 1)
        length = chance.randint(0, 40)
        kind = chance.randrange(6)
        if kind == 0:
            data[at:at] = bytes([chance.randrange(256)])
        elif kind == 1:
            del data[at:at + length]
        elif kind == 2:
            data[at:at] = data[at:at + length]
        elif kind == 3:
            data[at:at] = chance.choice(words)
        elif kind == 4:
            data = data[:at]
        elif at < len(data):
            data[at] ^= 1 << chance.randrange(8)
    return bytes(data)


def attempt(sample, format_, data, number, scratch):
    """\return what is wrong with the outcome, or None"""
    case = pathlib.Path(scratch) / f"{os.getpid()}-{number % 64}-{sample.replace('/', '_')}"
    (case / "system").mkdir(parents=True, exist_ok=True)
    (case / "constant").mkdir(exist_ok=True)
    chance = random.Random(f"{sample} {number}")
    (case / "constant/sample").write_bytes(damaged(data, chance))
    texture = plane.get(format_) or f"type import; {solid[format_]}"
    extra = f"format {format_};" if format_ != "png" else ""
    (case / "system/blockTextureDict").write_text(
        f"dimensions {2 if format_ in plane else 3};\ntexture {{ {texture} {extra} file \"constant/sample\"; }}\n")
    try:
        done = subprocess.run([applications / "blockTexture", "-case", case], capture_output=True, timeout=60, check=False)
    except subprocess.TimeoutExpired:
        return f"{sample} copy {number}: more than 60 s"
    errors = done.stderr.decode(errors="replace")
    if done.returncode == 0 or (done.returncode == 1 and "--> DRYSTONE FATAL" in errors and "file:" in errors):
        return None
    return f"{sample} copy {number}: exit status {done.returncode}\n{errors[-800:]}"


def main():
    tried = 0
    faults = []
    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ThreadPoolExecutor(2) as pool:
        for sample, format_, data in samples():
            jobs = [pool.submit(attempt, sample, format_, data, number, scratch) for number in range(copies)]
            tried += len(jobs)
            faults += [fault for fault in (job.result() for job in jobs) if fault]
    for fault in faults[:20]:
        print(fault)
    print(f"{tried} damaged copies, {len(faults)} faults")
    return 1 if faults or tried == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
