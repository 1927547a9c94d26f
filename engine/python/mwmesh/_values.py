# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Converts arguments to the types that the library takes.  A value of another type is an error that
names the argument; the library checks which numbers are allowed, the same for all its callers."""

import contextlib
import difflib
import operator
import os
from collections.abc import Iterable

import numpy as np

from ._handles import LabelName
from ._errors import Error, UsageError
from ._library import checked, encoded


def about(name, error):
    """Returns the error, which tells the argument that it is about."""
    error.option = name
    return error


def unexpected(name, expected, value):
    """Returns the error for a value that is not what was expected."""
    got = f"an array of shape {value.shape}" if isinstance(value, np.ndarray) else repr(value)
    return about(name, UsageError(f"{name}: expected {expected}, got {got}"))


def check_names(arguments, known, others=()):
    """Refuses arguments that are neither known nor one of the others, and guesses what was meant."""
    for name in arguments:
        if name in known or name in others:
            continue
        near = difflib.get_close_matches(name, [*known, *others], 1)
        guess = f"did you mean {near[0]}?" if near else "there are " + ", ".join(known)
        raise UsageError(f"{name}: no such argument or setting; {guess}")


@contextlib.contextmanager
def naming(name):
    """Puts the name of the argument in front of the library's errors that do not begin with it."""
    try:
        yield
    except Error as error:
        told = str(error) if str(error).startswith(f"{name}: ") else f"{name}: {error}"
        raise about(name, type(error)(told)) from None


def whole(value, name, bits=64):
    """Returns a whole number from an int, a number of numpy, or a float without a fraction.  What
    a signed number of these bits cannot hold becomes the nearest, which the library refuses."""
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        if isinstance(value, (float, np.floating)) and float(value).is_integer():
            value = int(value)
        limit = 1 << bits - 1
        return min(max(operator.index(value), -limit), limit - 1)
    except TypeError:
        raise unexpected(name, "a whole number", value) from None


def count(value, name):
    """Returns a whole number from 0 to 2^64 - 1."""
    number = whole(value, name, 80)
    if 0 <= number < 1 << 64:
        return number
    raise unexpected(name, "a whole number from 0 to 2^64 - 1", value)


def switch(value, name):
    """Returns True or False."""
    if isinstance(value, (bool, np.bool_, int)) and value in (0, 1):
        return bool(value)
    raise unexpected(name, "True or False", value)


def text(value, name):
    """Returns a string; None gives an empty one."""
    if value is None or isinstance(value, str):
        return value or ""
    raise unexpected(name, "a string", value)


def path_bytes(value, name):
    """Returns the bytes of a path."""
    try:
        return checked(os.fsencode(value), name)
    except TypeError:
        raise unexpected(name, "a path", value) from None


def numbers(value, name, expected, *shapes):
    """Returns an array of numbers of one of these shapes; None stands for any length."""
    try:
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        raise unexpected(name, expected, value) from None
    for shape in shapes:
        if len(shape) == array.ndim and all(n in (None, m) for n, m in zip(shape, array.shape)):
            return array
    raise unexpected(name, expected, value)


def three(value, name):
    """Returns (x, y, z) from three numbers or from one for all of them."""
    return np.broadcast_to(numbers(value, name, "three numbers, or one", (), (3,)), 3).tolist()


def whole_numbers(values, name):
    """Returns an array as integers of 64 bits: int64 if it is signed or of floats, else uint64."""
    values = np.asarray(values)
    if values.dtype.kind in "bu":
        return values.astype(np.uint64)
    if values.dtype.kind == "i":
        return values.astype(np.int64)
    if values.dtype.kind == "f":
        with np.errstate(invalid="ignore"):
            integers = values.astype(np.int64)
        if np.array_equal(integers, values):
            return integers
    raise UsageError(f"{name}: expected whole numbers")


def unmasked(array, name="array"):
    """Returns the array.  Refuses a masked one, as nothing says what its masked voxels are."""
    if isinstance(array, np.ma.MaskedArray):
        raise UsageError(f"{name}: is masked; fill it with a label: {name}.filled(0)")
    return array


def one_or_more(value):
    """Returns the labels of a list, or of one label; a string is one name."""
    is_one = isinstance(value, str) or not isinstance(value, Iterable)
    return [value] if is_one or getattr(value, "ndim", 1) == 0 else value


def label(of, value, name):
    """Returns the label of a volume or a mesh that has this number or name, as 64 bits."""
    digits = value if isinstance(value, str) else str(whole(value, name, 80))
    with naming(name):
        return of.find_label(encoded(digits, name))


def named(of, names):
    """Returns a volume or a mesh with names.  names: {label: name}, a list of the names of labels 0,
    1, 2 and so on, or a file of them."""
    if names is None:
        return of
    if isinstance(names, (str, bytes, os.PathLike)):
        return of.read_names(path_bytes(names, "names"))
    if isinstance(names, (set, frozenset)):
        raise unexpected("names", "{label: name}, a list, or a file", names)
    try:
        rows = names.items() if hasattr(names, "items") else enumerate(names)
    except TypeError:
        raise unexpected("names", "{label: name}, a list, or a file", names) from None
    return of.with_names([LabelName(label(of, key, "names"), text(name, "names"))
                          for key, name in rows])
