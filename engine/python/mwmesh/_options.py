# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The options of the library, whose table says which there are, as arguments of Python."""

import inspect
import os
from collections.abc import Mapping, Set

import numpy as np

from ._handles import Options, options_table
from ._errors import NAMES, UsageError
from ._library import checked, encoded
from ._values import (label, naming, numbers, one_or_more, path_bytes, switch, text, three,
                      unexpected, whole, whole_numbers)

#: All options by name, in the order of the documentation.
TABLE = {row["name"]: row for row in options_table()}


def arguments_of(use):
    """Returns the arguments that stand for options of a use: "open", "mesh", "write", "verify".
    Older names, which have no group, are left to files of options; "names" is as_volume()'s."""
    return [NAMES.get(name, name) for name, row in TABLE.items()
            if use in row["calls"] and row["group"] and name != "names"]


def _plain(value):
    if value is None:
        return "none"
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if not isinstance(value, (float, np.floating)):
        return str(value)
    number = float(value)
    return str(int(number)) if number.is_integer() else repr(number)


def _joined(values):
    return ",".join(map(_plain, values))


def _label(of, value, name):
    """Returns a label as text: what files of the volume's type call it."""
    bits = label(of, value, name)
    return str(bits - (bits >> 63 << 64 if of.labels_are_signed else 0))


def _labels(of, value: "_Label | Iterable[_Label]", name):
    labels = [_label(of, one, name) for one in one_or_more(value)]
    if not labels:
        raise UsageError(f"{name}: the list is empty")
    return ",".join(labels)


def _background(of, value: "_Label", name):
    return value if isinstance(value, str) and value == "none" else _label(of, value, name)


def _object(_of, value: "int | Iterable[int]", name):
    return _joined(whole_numbers(np.ravel(value), name).tolist())


def _merge(of, value: "Mapping[_Label, _Label]", name):
    if not isinstance(value, Mapping):
        raise unexpected(name, "{label: label that it becomes}", value)
    return ";".join(f"{_label(of, a, name)}={_label(of, b, name)}" for a, b in value.items())


def _specks(_of, value: "_Specks", name):
    least, joined = value if isinstance(value, tuple) and len(value) == 2 else (value, 6)
    if joined not in (6, 26):
        raise unexpected(name, "voxels, or (voxels, 26)", value)
    number = 0 if least is None else whole(least, name, 80)
    return f"{number}/{int(joined)}" if number else ""


def _pairs(of, value: "_Pairs", name):
    """"*", or pairs of labels."""
    if isinstance(value, str) and value == "*":
        return value
    if isinstance(value, str) or not isinstance(value, (list, tuple, Set)):
        raise unexpected(name, "pairs of labels, or *", value)
    for pair in value:
        if not isinstance(pair, tuple) or len(pair) != 2:
            raise unexpected(name, "pairs of labels such as (1, 2)", pair)
    return ",".join("|".join(_label(of, one, name) for one in pair) for pair in value)


def _sizes(of, value, name):
    """Sizes as the command line has them, with labels by name or by number."""
    if np.ndim(value) != 0:
        raise unexpected(name, "a number, {label: size} or '@' and the path of a table or an image",
                         value)
    if not isinstance(value, dict):
        return _plain(value)
    return ",".join(f"{_size_place(of, key)}={_plain(size)}" for key, size in value.items())


def _size_place(of, key):
    """Returns the text for the key of a size: a label, an interface (a, b), or "*" for others."""
    keys = key if isinstance(key, tuple) else (key,)
    return key if key == "*" else "|".join(_label(of, one, "size") for one in keys)


def _samples(_of, value: "Mapping[str, str | os.PathLike[str]]", name):
    if not isinstance(value, Mapping):
        raise unexpected(name, "{name: file}", value)
    parts = [encoded(text(key, name), name) + b"=" + path_bytes(file, name)
             for key, file in value.items()]
    if any(b";" in part for part in parts):
        raise UsageError(f"{name}: a path with ';' in it is not taken, rename the file or link to it")
    return b";".join(parts)


def _box(_of, value: "_Box", name):
    """((x0, y0, z0), (x1, y1, z1)), whole numbers."""
    corners = numbers(value, name, "((x0, y0, z0), (x1, y1, z1))", (2, 3), (6,))
    return _joined(whole(number, name) for number in corners.ravel())


def _boxes(of, value: "Sequence[_Box]", name):
    if not isinstance(value, (list, tuple)):
        raise unexpected(name, "a list of boxes", value)
    return ";".join(_box(of, box, name) for box in value)


def _whole(_of, value: "int", name):
    return str(whole(value, name, 80))


def _switch(_of, value: "bool", name):
    return _plain(switch(value, name))


def _text(_of, value: "_Text", name):
    return path_bytes(value, name) if isinstance(value, (bytes, os.PathLike)) else text(value, name)


def _size(of, value: "int | str", name):
    return value if isinstance(value, str) else _whole(of, value, name)


def _number(_of, value: "float", _name):
    return _plain(value)


def _three(_of, value: "float | _Three", name):
    return _joined(three(value, name))


def _shape(_of, value: "Sequence[int]", name):
    return _joined(whole(n, name) for n in three(value, name))


def _deck(_of, value: "bool | _Text", name):
    return value if isinstance(value, str) else "static" if switch(value, name) else "none"


def _setting(_of, value: "_Setting", _name):
    return _plain(value)


#: What makes the text of a value.  The annotation of `value` is its type in __init__.pyi, where
#: `_Text` stands for the choices of the option, and for any text or path where it has none.
_KINDS = {
    "integer": _whole, "switch": _switch, "text": _text, "labels": _labels, "box": _box,
    "size": _size, "number_or_text": _size, "number": _number, "numbers": _three, "shape": _shape,
}
_SPECIAL = {
    "background": _background, "object": _object, "merge": _merge, "drop_specks": _specks,
    "weld": _labels, "size": _sizes, "split": _pairs, "cohesive": _pairs, "sample": _samples,
    "changed": _boxes, "deck": _deck,
}


def maker_of(row):
    """Returns what makes the text of a value of an option."""
    return _SPECIAL.get(row["name"]) or (_setting if row["setting"] else _KINDS[row["kind"]])


def _choices(row):
    return f" ({', '.join(row['choices'])})" if row["choices"] else ""


def documented(*uses):
    """Lets the docstring of a function end with a line for each argument that stands for an option."""
    names = dict.fromkeys(name for use in uses for name in arguments_of(use))
    rows = {NAMES.get(name, name): row for name, row in TABLE.items()}

    def add(function):
        if function.__doc__:  # not with python -OO
            lines = (f"    {name}: {rows[name]['help']}{_choices(rows[name])}\n" for name in names)
            function.__doc__ = (f"{inspect.cleandoc(function.__doc__)}\n\n"
                                f"Arguments in the words of mwmesh --help-all:\n\n{''.join(lines)}")
        return function

    return add


def options_of(of, arguments):
    """Returns the library's options for arguments of Python.  of: the volume whose labels they name.
    None stands for "none" where that is a number, and for nothing where there is no default."""
    options = Options()
    for name, value in _library_names(arguments).items():
        row = TABLE[name]
        if value is None and row["default"] is None and row["kind"] != "number_or_none":
            continue
        known = NAMES.get(name, name)
        told = maker_of(row)(of, value, known)
        if not isinstance(told, bytes):
            told = checked(os.fsencode(told), known)
        if told:
            with naming(known):
                options.set(name, told)
    return options


def _library_names(arguments):
    """Returns arguments by the library's names."""
    arguments = dict(arguments)
    for name, known in NAMES.items():
        if known in arguments:
            arguments[name] = switch(arguments.pop(known), known)
    if arguments.pop("from", False):
        if arguments.get("keep") is None:
            raise UsageError("from_kept: needs the folder that a run has kept something in, name it "
                             "with keep")
        arguments["from"] = arguments.pop("keep")
    return arguments
