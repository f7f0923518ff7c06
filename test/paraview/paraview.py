# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""etc/paraview/drystone.py on a mechanism: its picture shows blocks, contact points and forces, larger motions with a larger
magnification. Skipped (77) where there is no pvbatch."""
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

applications, root = (os.path.abspath(path) for path in sys.argv[1:3])
sticking, sliding = (0.12, 0.35, 0.65), (0.80, 0.15, 0.10)  # colours of drystone.py


def pixels(path):
    """Width, and the rows of (red, green, blue) of a PNG of 8 bits without a palette."""
    with open(path, "rb") as file:
        content = file.read()
    at, data = 8, b""
    while at < len(content):
        length, kind = struct.unpack_from(">I4s", content, at)
        body = content[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack_from(">IIBB", body)
            assert depth == 8 and colour in (2, 6), "not a PNG of true colours"
        data += body if kind == b"IDAT" else b""
        at += 12 + length
    size = 3 if colour == 2 else 4
    raw, rows, above = zlib.decompress(data), [], bytes(size * width)
    for y in range(height):
        kind, line = raw[y * (size * width + 1)], bytearray(raw[y * (size * width + 1) + 1:(y + 1) * (size * width + 1)])
        for i in range(len(line)):
            a, b = line[i - size] if i >= size else 0, above[i]
            c = above[i - size] if i >= size else 0
            nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            line[i] = (line[i] + (0, a, b, (a + b) // 2, nearest)[kind]) & 255
        above = bytes(line)
        rows.append([tuple(above[i:i + 3]) for i in range(0, len(above), size)])
    return width, rows


def near(pixel, colour):
    """Of a lit surface: the same hue, darker."""
    strongest = max(colour)
    scale = max(pixel) / (255 * strongest)
    return 0.35 < scale <= 1.05 and all(abs(p - 255 * scale * c) < 20 for p, c in zip(pixel, colour))


def main():
    pvbatch = shutil.which("pvbatch")
    if not pvbatch:
        print("pvbatch (ParaView) is not installed: skipped")
        return 77
    # A server that resets when its last client leaves refuses the next one meanwhile.
    server = ["xvfb-run", "-a", "-s", "-noreset -screen 0 1600x1000x24"]
    command = [pvbatch] if os.environ.get("DISPLAY") or not shutil.which("xvfb-run") else [*server, pvbatch]
    with tempfile.TemporaryDirectory() as folder:
        case = os.path.join(folder, "wall")
        shutil.copytree(os.path.join(root, "tutorials/limitAnalysis/masonryPanels/wall1"), case,
                        ignore=shutil.ignore_patterns("VTK", "postProcessing", "log.*", "assembly"))
        for application in ("blockTexture", "limitAnalysis"):
            subprocess.run([os.path.join(applications, application), "-case", case], check=True, capture_output=True)
        shown = {}
        for magnification in ("1", "3"):
            picture, state = os.path.join(folder, magnification + ".png"), os.path.join(folder, magnification + ".pvsm")
            subprocess.run(command + [os.path.join(root, "etc/paraview/drystone.py"), case, "--picture", picture,
                                      "--state", state, "--magnify", magnification], check=True, timeout=200)
            with open(state, encoding="utf-8") as file:
                text = file.read()
            for name in ("motion", "joints", "forces"):
                assert f'name="{name}"' in text, name
            shown[magnification] = pixels(picture)[1]
        # The state that the run has written, in a case that was copied to another place while its own is gone.
        moved, picture = os.path.join(folder, "moved"), os.path.join(folder, "state.png")
        os.rename(case, moved)
        subprocess.run(command + [os.path.join(moved, "VTK/paraviewState.py"), "--picture", picture], check=True, timeout=200)
        assert pixels(picture)[1] == shown["1"], "the state shows something else than the macro"
    counts = {colour: sum(near(pixel, colour) for row in shown["1"] for pixel in row) for colour in (sticking, sliding)}
    print(counts)
    assert counts[sticking] > 200, "no arrows of sticking points are seen"
    different = sum(a != b for one, three in zip(shown["1"], shown["3"]) for a, b in zip(one, three))
    assert different > 20000, f"the magnification changes {different} pixels"
    return 0


if __name__ == "__main__":
    sys.exit(main())
