# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Values of Python, and of NumPy without importing it, as dictionaries of a case have them."""
import collections.abc
import math
import numbers
import os
import re


def textOf(value):
    """The text of a value: yes and no, numbers, (0 -9.81) and ((0 1) (1 2)) of sequences and arrays, { a 1; } of a
    mapping, "name" of a path; a text is taken as it is."""
    if isinstance(value, str):
        return value
    if getattr(value, "shape", None) == () and not isinstance(value, numbers.Number):
        value = value[()]  # an array without dimensions, or numpy.bool_
    if isinstance(value, bool) or type(value).__name__ in ("bool_", "bool"):
        return "yes" if value else "no"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        if not math.isfinite(value):
            raise ValueError(f"{value} is no finite number: a dictionary cannot have it")
        return str(float(value)) if isinstance(value, numbers.Rational) else str(value)
    if isinstance(value, os.PathLike):
        return f'"{os.fspath(value)}"'
    if isinstance(value, collections.abc.Mapping):
        return "{ " + "".join(_entry(key, inner) for key, inner in value.items()) + "}"
    isOrdered = isinstance(value, collections.abc.Iterable) and not isinstance(value, (bytes, bytearray, collections.abc.Set))
    if isOrdered:
        return "(" + " ".join(textOf(part) for part in value) + ")"
    raise TypeError(f"{value!r} of type {type(value).__name__} is no value of a dictionary: give a number, True or False, "
                    "a text, a sequence or array of these, or a mapping")


def _entry(key, value):
    if not isinstance(key, str) or not re.fullmatch(r'"[^"\n]*"|[^\s;{}()"/$#]+', key):
        raise ValueError(f"{key!r} cannot be the key of an entry: give a word")
    text = textOf(value)
    return f"{key} {text} " if isinstance(value, collections.abc.Mapping) else f"{key} {text}; "
