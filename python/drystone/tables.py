# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Tables under postProcessing/: a heading `# Time[s] ux[m] ...`, then rows of numbers."""
import re
from pathlib import Path

from ._numbers import numbers


class Table:
    """Columns by name; `units` has the unit of each. A column of words, such as names of load combinations, is a list."""

    def __init__(self, columns, units):
        self.columns = columns
        self.units = units

    def __getitem__(self, name):
        try:
            return self.columns[name]
        except KeyError:
            raise KeyError(f"no column {name}; there are: {' '.join(self.columns)}") from None

    def __len__(self):
        return len(next(iter(self.columns.values()), []))

    def pandas(self):
        """A pandas.DataFrame, its columns named with their units."""
        import pandas
        return pandas.DataFrame({f"{name}[{self.units[name]}]" if self.units[name] else name: column
                                 for name, column in self.columns.items()})


def wordsOf(line):
    """The words of a row; what is between quotes is one, without them."""
    return [quoted or word for quoted, word in re.findall(r'"([^"]*)"(?!\S)|(\S+)', line)]


def readTable(file):
    """Reads a table. The last row of a run that was killed may be cut off; it is left out.

    Raises ValueError for a file that is no such table."""
    text = Path(file).read_text(encoding="utf-8")
    lines = text[:text.rfind("\n") + 1].splitlines()  # a last line without its end is cut off, be it in a number
    if not lines or not lines[0].startswith("# "):
        raise ValueError(f"{file} is no table: it lacks a heading '# name[unit] ...'")
    headings = [re.fullmatch(r"(.*?)(?:\[(.*)\])?", word).groups() for word in lines[0][2:].split()]
    rows = [wordsOf(line) for line in lines[1:] if line and not line.startswith("#")]
    rows = [row for row in rows if len(row) == len(headings)]
    columns = {name: numbers([row[i] for row in rows]) for i, (name, _) in enumerate(headings)}
    return Table(columns, {name: unit or "" for name, unit in headings})
