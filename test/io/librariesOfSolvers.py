#!/usr/bin/env python3
# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Solvers and report do not load VTK's libraries, which would take longer than the limit analysis of a wall, and no application
loads cairo and what that brings before it draws with it.

librariesOfSolvers.py BIN
"""
import os
import subprocess
import sys

failures = []
for application, isUser in (("limitAnalysis", False), ("contactDynamics", False), ("report", False), ("blockTexture", True)):
    listed = subprocess.run(["ldd", os.path.join(sys.argv[1], application)], capture_output=True, text=True, check=True).stdout
    print(f"{application}: {len(listed.splitlines())} libraries, {listed.count('libvtk')} of VTK's")
    if ("libvtk" in listed) != isUser or "libcairo" in listed or "libfontconfig" in listed:
        failures.append(application)
sys.exit(f"not as expected: {' '.join(failures)}" if failures else 0)
