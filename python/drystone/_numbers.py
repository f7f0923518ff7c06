# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers as NumPy arrays where NumPy is installed, else as lists."""
try:
    import numpy
except ImportError:
    numpy = None


def numbers(words):
    """The numbers that the words are; the words themselves where one of them is no number."""
    try:
        values = [float(word) for word in words]
    except ValueError:
        return list(words)
    return values if numpy is None else numpy.array(values)


def rows(values, components):
    """Rows of as many numbers each; of one component the numbers themselves."""
    if numpy is not None:
        array = numpy.array(values)
        return array if components == 1 else array.reshape(-1, components)
    values = list(values)
    return values if components == 1 else [tuple(values[i:i + components]) for i in range(0, len(values), components)]
