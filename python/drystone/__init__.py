# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Drystone's cases from Python: run applications, read tables and frames.

    import drystone
    wall = drystone.Case("wall")
    wall.run("blockTexture")
    wall.run("limitAnalysis")
    print(wall.table("limitAnalysis")["alpha"][0])
    for frame in wall.frames():            # the mechanism, or a motion
        print(frame.time, frame.largestDisplacement())

Dictionaries are edited by the application caseDictionary (`wall.set`), or by foamlib, which reads them too.
Pure Python; with NumPy installed numbers are arrays, and `table.pandas()` needs pandas.
"""
from ._numbers import numpy as _numpy
from .case import Case, RunError
from .frames import Frame, readFrame, readSeries
from .tables import Table, readTable

__all__ = ["Case", "Frame", "RunError", "Table", "readFrame", "readSeries", "readTable"]
__version__ = "0.1.0"
hasNumPy = _numpy is not None  # else numbers are lists
