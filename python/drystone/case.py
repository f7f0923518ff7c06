# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""A case directory and the applications that run in it."""
import os
import re
import shutil
import stat
import subprocess
from pathlib import Path

from ._values import textOf
from .frames import readSeries
from .tables import readTable


class RunError(RuntimeError):
    """An application ended with a failure; `status` is its exit status, the text what it said."""

    def __init__(self, application, status, text):
        super().__init__(f"{application} ended with exit status {status}:\n{text}")
        self.status = status


def isTime(name):
    """Whether a folder has the name of a time, in any format of controlDict: 0.5, 1e-05."""
    return re.fullmatch(r"\d+\.?\d*([eE][+-]?\d+)?", name) is not None


class Case:
    """A case directory. The applications are those on the PATH, or in `applications`."""

    def __init__(self, directory, applications=None):
        self.directory = Path(directory)
        self.applications = applications

    def _program(self, name):
        program = shutil.which(name, path=None if self.applications is None else str(self.applications))
        if program is None:
            raise FileNotFoundError(f"{name} is not on the PATH: add build/bin of Drystone, or install it")
        return program

    def run(self, application, *options):
        """Runs an application in the case, keeps its output in log.<application>, and returns it.

        Raises RunError when the exit status is not 0, FileNotFoundError where there is no such case."""
        if not self.directory.is_dir():
            raise FileNotFoundError(f"there is no case directory {self.directory}")
        done = subprocess.run([self._program(application), "-case", str(self.directory), *options],
                              capture_output=True, text=True, check=False)
        (self.directory / ("log." + Path(application).name)).write_text(done.stdout + done.stderr, encoding="utf-8")
        if done.returncode != 0:
            raise RunError(application, done.returncode, done.stderr or done.stdout[-1000:])
        return done.stdout

    def get(self, dictionary, entry):
        """The text of an entry: case.get("constant/contactProperties", "friction/mu")."""
        done = subprocess.run([self._program("caseDictionary"), "-case", str(self.directory), dictionary, "-entry", entry,
                               "-value"], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RunError("caseDictionary", done.returncode, done.stderr)
        return done.stdout.strip()

    def set(self, dictionary, entry, value):
        """Gives an entry a value; comments and layout of the file are kept.

        True and False are written yes and no, sequences and arrays (0 -9.81) and ((0 1) (1 2)), mappings { a 1; }; a
        text is taken as it is. Raises TypeError or ValueError for what a dictionary cannot have."""
        done = subprocess.run([self._program("caseDictionary"), "-case", str(self.directory), dictionary, "-entry", entry,
                               "-set", textOf(value)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RunError("caseDictionary", done.returncode, done.stderr)

    def table(self, function, file=None, time=None):
        """A table of postProcessing/<function>/<time>/; by default its only one, or the one named like the function, of
        the latest start."""
        folder = self.directory / "postProcessing" / function
        if time is None:
            starts = sorted((float(path.name), path.name) for path in folder.iterdir() if path.is_dir())
            if not starts:
                raise FileNotFoundError(f"{folder} holds no results")
            time = starts[-1][1]
        folder = folder / str(time)
        if file is None:
            files = sorted(folder.glob("*.dat"))
            named = folder / (function + ".dat")
            if len(files) != 1 and named not in files:
                raise FileNotFoundError(f"{folder} holds {', '.join(path.name for path in files)}: name one")
            file = (named if named in files else files[0]).name
        return readTable(folder / file)

    def frames(self, name="blocks"):
        """The frames of VTK/<name>.vtp.series."""
        return readSeries(self.directory / "VTK", name)

    def copy(self, directory, replace=False):
        """A new case with the input of this one: without results, logs and times but 0. With `replace` an older case
        in its place, as of a cell that is run again, is removed; not the case itself, nor a folder that it is in."""
        source, target = self.directory.resolve(), Path(directory).resolve()
        if target == source or target in source.parents:
            raise ValueError(f"{directory} is this case, or a folder that it is in: give the copy another place")
        if source in target.parents:
            raise ValueError(f"{directory} is in this case: give the copy a place outside")
        if replace and (Path(directory) / "system").is_dir():
            shutil.rmtree(directory)
        def isResult(folder, names):
            atTop = Path(folder) == self.directory
            return [name for name in names if atTop and (
                name in ("VTK", "postProcessing", "report.html") or name.startswith("log.")
                or (name != "0" and isTime(name)))]
        def copyWritable(file, to):
            shutil.copy2(file, to)
            os.chmod(to, os.stat(to).st_mode | stat.S_IWUSR)  # entries of a copy of a protected case can be set
        shutil.copytree(self.directory, directory, ignore=isResult, copy_function=copyWritable)
        return Case(directory, self.applications)
