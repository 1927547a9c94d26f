# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The library's volumes, meshes and options; what they show are views that are not copied."""

import collections
import ctypes
import json
from ctypes import byref, c_double, c_int64, c_size_t, c_uint64, c_void_p
from typing import NamedTuple, Optional

import numpy as np

from ._errors import InputError, UsageError
from ._library import (LIB, VERSION, Column, Name, Reader, Space, call, decoded, encoded, run,
                       taken)

__version__ = VERSION
#: Types of numpy in the order of mw_type.
_TYPES = ("u1", "u2", "u4", "u8", "i1", "i2", "i4", "i8", "f4", "f8")
_INDEX = c_int64 * 3


class LabelName(NamedTuple):
    """A name of a label."""

    label: int  #: as 64 bits
    name: str
    colour: Optional[list] = None  #: red, green, blue and opacity


def _rows(count, names):
    """Returns the names behind a pointer."""
    return [LabelName(row.label, decoded(row.name), list(row.colour) if row.has_colour else None)
            for row in names[:count]] if count else []


def _names(rows):
    """Returns what _rows() takes, and how many there are."""
    colours = (row.colour or (0, 0, 0, 0) for row in rows)
    array = (Name * len(rows))(*(
        Name(row.label, encoded(row.name, "names"), tuple(colour), bool(row.colour))
        for row, colour in zip(rows, colours)))
    return array, len(rows)


class _Column:
    """A column of a handle, which numpy takes for an array that cannot be written.  The array keeps
    this, and this keeps the handle."""

    def __init__(self, owner, shape, column):
        self._owner = owner
        self.__array_interface__ = {"version": 3, "shape": shape, "data": (column.data, True),
                                    "typestr": np.dtype(_TYPES[column.type]).str}


def _view(owner, column):
    """Returns the numbers of a column."""
    shape = (column.rows, column.width) if column.width > 1 else (column.rows,)
    if column.rows > 0:
        return np.asarray(_Column(owner, shape, column))
    empty = np.empty(shape, _TYPES[column.type])
    empty.flags.writeable = False
    return empty


class _Handle:
    """What the library has made; it is freed when nothing refers to it any more."""

    _as_parameter_ = None

    def __init__(self, address):
        self._as_parameter_ = address

    def __del__(self):
        self._free(self._as_parameter_)


class Options(_Handle):
    """Values of options by name."""

    _free = LIB.mw_options_free

    def __init__(self):
        super().__init__(call("options_new"))

    def set(self, name, text):
        call("options_set", self, name.encode(), text)


def options_table():
    """Returns a dict for each option: "name", "kind", "help", "default" and so on."""
    return json.loads(LIB.mw_options_table())


class Volume(_Handle):
    """A volume, with what it reads: an array, or a function and what it raised."""

    _free = LIB.mw_volume_free

    def __init__(self, address, kept=None, failures=()):
        super().__init__(address)
        self._kept, self.failures = kept, failures

    @property
    def shape(self):
        shape = _INDEX()
        LIB.mw_volume_shape(self, shape)
        return list(shape)

    @property
    def space(self):
        space = Space()
        LIB.mw_volume_space(self, byref(space))
        space.owner = self  # has the texts
        return space

    @property
    def labels_are_signed(self):
        return bool(LIB.mw_volume_is_signed(self))

    @property
    def dtype(self):
        return _TYPES[LIB.mw_volume_type(self)]

    @property
    def names(self):
        names = ctypes.POINTER(Name)()
        return _rows(LIB.mw_volume_names(self, byref(names)), names)

    def labels(self):
        """Returns all labels, indexed [z, y, x]."""
        labels = np.empty(self.shape[::-1], np.uint64)
        call("volume_read", self, _INDEX(), _INDEX(*self.shape), labels.ctypes.data)
        return labels.view(np.int64) if self.labels_are_signed else labels

    def with_names(self, rows):
        made = call("volume_with_names", self, *_names(rows))
        return Volume(made, self._kept, self.failures)

    def read_names(self, path):
        return Volume(call("volume_read_names", self, path), self._kept, self.failures)

    def find_label(self, text):
        label = c_uint64()
        call("volume_find_label", self, text, byref(label))
        return label.value


def _type_of(dtype):
    code = f"{dtype.kind}{dtype.itemsize}".replace("b1", "u1")
    if code not in _TYPES:
        raise UsageError(f"array: labels of type {dtype!r}: expected integers, or floats of 32 or "
                         "64 bits that are whole numbers; convert others, as with "
                         'astype("float32")')
    return _TYPES.index(code)


def space_of_affine(rows, frame, spacing):
    space = Space()
    spacing = None if spacing is None else (c_double * 3)(*spacing)
    call("space_of_affine", np.ascontiguousarray(rows).ctypes.data, frame.encode(), spacing,
         byref(space))
    return space


def open_volume(path, options):
    return run("volume_open", Volume, path, options)


def volume_of_array(array, space, names=()):
    """Returns the volume of an array, indexed [x, y, z], in the machine's byte order."""
    # No step is ever taken along an axis of one voxel.
    strides = [step if count > 1 else array.itemsize
               for step, count in zip(array.strides, array.shape)]
    made = call("volume_of_array", array.ctypes.data, _type_of(array.dtype), _INDEX(*array.shape),
                _INDEX(*strides), byref(space))
    return Volume(made, array).with_names(names)


def volume_of_region(fetch, dtype, shape, chunk, space):
    """Returns the volume of fetch(x0, y0, z0, x1, y1, z1), which returns 64-bit labels [z, y, x],
    without gaps."""
    failures = collections.deque(maxlen=8)  # the latest ones, of all runs

    @Reader
    def read(_data, lo, hi, out):
        try:
            labels = fetch(*lo[:3], *hi[:3])
            if labels.shape != tuple(hi[axis] - lo[axis] for axis in (2, 1, 0)):
                raise InputError("volume: a region came back with another shape")
            ctypes.memmove(out, labels.ctypes.data, labels.nbytes)
        except BaseException as error:  # which the caller of the run gets
            failures.append(error)
            return 1
        return 0

    made = call("volume_of_reader", _type_of(dtype), _INDEX(*shape), _INDEX(*chunk), byref(space),
                read, None)
    return Volume(made, read, failures)


class Mesh(_Handle):
    """A mesh in memory."""

    _free = LIB.mw_mesh_free

    @classmethod
    def of_arrays(cls, points, tets, labels, is_signed):
        points, tets, labels = (np.ascontiguousarray(array, kind) for array, kind in (
            (points, np.float64), (tets, np.uint64), (labels, np.uint64)))
        if tets.ndim != 2 or tets.shape[1] != 4:
            raise UsageError("tets: expected 4 columns")
        if labels.shape != tets.shape[:1]:
            raise UsageError("labels: there must be one label a tet")
        return cls(call("mesh_of_arrays", points.ctypes.data, len(points), tets.ctypes.data,
                        labels.ctypes.data, len(tets), is_signed))

    def column(self, name):
        """Returns a column of mw_mesh_column()."""
        column = Column()
        call("mesh_column", self, name.encode(), byref(column))
        return _view(self, column)

    @property
    def points(self):
        return self.column("points")

    @property
    def tets(self):
        return self.column("tets").view(np.int64)

    @property
    def labels(self):
        return self.column("labels")

    @property
    def values(self):
        out, column = {}, Column()
        for i in range(LIB.mw_mesh_value_count(self)):
            name = decoded(LIB.mw_mesh_values(self, i, byref(column)))
            out[name] = _view(self, column)
        return out

    def set_values(self, name, numbers):
        numbers = np.ascontiguousarray(numbers, np.float64)
        call("mesh_set_values", self, encoded(name, "values"), numbers.ctypes.data, numbers.size)

    @property
    def names(self):
        names = ctypes.POINTER(Name)()
        return _rows(LIB.mw_mesh_names(self, byref(names)), names)

    def with_names(self, rows):
        call("mesh_set_names", self, *_names(rows))
        return self

    def read_names(self, path):
        call("mesh_read_names", self, path)
        return self

    @property
    def report(self):
        return decoded(LIB.mw_mesh_text(self, b"report"))

    @property
    def record(self):
        return decoded(LIB.mw_mesh_text(self, b"record"))

    @property
    def in_parts(self):
        return bool(LIB.mw_mesh_is_in_parts(self))

    def set_record(self, record, in_parts):
        call("mesh_set_record", self, encoded(record, "record"), in_parts)

    def summary(self, report):
        return decoded(taken(call("mesh_summary", self, report)))

    def digest(self):
        return decoded(taken(call("mesh_digest", self)))

    def picture(self, width, height):
        size = c_size_t()
        address = call("mesh_picture", self, width, height, byref(size))
        return taken(address, size.value)

    def write(self, path, options):
        call("mesh_write", self, path, options)

    def find_label(self, text):
        label = c_uint64()
        call("mesh_find_label", self, text, byref(label))
        return label.value


def read_mesh(path):
    return Mesh(call("mesh_read", path))


def make_mesh(volume, options, progress):
    return run("make_mesh", Mesh, volume, options, progress=progress)


def mesh_to_file(path, volume, options, progress):
    """Returns the text of the report."""
    report = c_void_p()
    return run("mesh_to_file", lambda _status: decoded(taken(report.value)), path, volume, options,
               progress=progress, out=(byref(report),))


def verify(mesh, volume, options):
    """Returns the text of the verdict."""
    return run("verify", lambda text: decoded(taken(text)), mesh, volume, options, out=(None,))


def synth(kind, shape, labels, seed):
    """Returns a random volume, indexed [z, y, x]."""
    voxels = np.empty(shape[::-1], np.uint64)
    call("synth", kind, _INDEX(*shape), labels, seed, voxels.ctypes.data)
    return voxels
