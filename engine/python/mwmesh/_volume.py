# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Makes volumes of the library from files, arrays and images."""

import os
import warnings

import numpy as np

from . import _handles
from ._errors import InputError, UsageError
from ._library import encoded
from ._options import arguments_of, options_of
from ._values import (check_names, named, numbers, path_bytes, text, three, unexpected, unmasked,
                      whole_numbers)

#: Arrays are indexed [z, y, x], as .npy, HDF5, Zarr and TIFF have them, unless told otherwise.
AXES = ("zyx", "xyz")
#: The frames of arrays and images; files have "file" for "own".
FRAMES = ("own", "ras", "lps", "voxel")
#: How far a label in floats may be from the whole number that it is taken for.
_ROUNDING = 1e-3
#: The arguments that say where an array lies, and all that say where a source lies or which part of
#: it the volume is.
_OF_ARRAYS = ("spacing", "origin", "affine", "frame", "unit", "axes")
PLACE = (*_OF_ARRAYS, *(name for name in arguments_of("open") if name not in _OF_ARRAYS))


def _is_image(source):
    """Returns True if the source is a nibabel image."""
    return hasattr(source, "dataobj") and hasattr(source, "affine")


def _image_array(image):
    """Returns the labels of a nibabel image, as they are stored if nothing scales them."""
    proxy = image.dataobj
    slope, inter = getattr(proxy, "slope", 1), getattr(proxy, "inter", 0)
    if hasattr(proxy, "get_unscaled") and (slope, inter) == (1, 0):
        return proxy.get_unscaled()
    return np.asanyarray(proxy)


def _image_affine(image, frame):
    """Returns the affine of a nibabel image, whose frame is RAS, in that frame."""
    affine = np.asarray(image.affine, dtype=float)
    return np.diag([-1.0, -1.0, 1.0, 1.0]) @ affine if frame == "lps" else affine


def _image_spacing(image):
    """Returns the edges of a voxel where the header states them beside the affine, as in NIfTI."""
    if "pixdim" not in getattr(image, "header", ()):
        return None
    edges = [abs(float(str(np.float32(edge)))) for edge in image.header["pixdim"][1:4]]
    return edges if all(0 < edge < np.inf for edge in edges) else None


def _image_unit(image):
    units = getattr(image.header, "get_xyzt_units", None)
    return {"mm": "mm", "meter": "m", "micron": "um"}.get(units()[0], "") if units else ""


def _affine_rows(affine):
    """Returns the first three rows of an affine."""
    matrix = numbers(affine, "affine", "a matrix of 4 x 4 or 3 x 4", (3, 4), (4, 4))
    if len(matrix) == 4 and not np.array_equal(matrix[3], [0, 0, 0, 1]):
        raise UsageError("affine: the last of four rows must be 0, 0, 0, 1")
    return matrix[:3]


def _space(spacing, origin, affine, frame, unit, stated=None):
    """Returns where a volume lies; stated are edges of a voxel that replace the affine's."""
    if affine is not None and (spacing is not None or origin is not None):
        raise UsageError("affine: spacing and origin follow from it, leave them out")
    if affine is not None:
        space = _handles.space_of_affine(_affine_rows(affine), frame or "own", stated)
    else:
        space = _handles.Space()
        space.spacing[:] = three(1 if spacing is None else spacing, "spacing")
        space.origin[:] = three(0 if origin is None else origin, "origin")
        for axis in range(3):
            space.axes[axis][axis] = 1
        space.frame = b"own" if frame == "voxel" else frame.encode() or b"own"
    space.unit = encoded(unit, "unit")
    return space


def _chunk(array):
    """Returns the shape of an array's chunks, in the order of its axes; zeros where it does not say
    that it has chunks."""
    chunks = getattr(array, "chunks", None)
    if not chunks or len(chunks) != 3:
        return [0, 0, 0]
    return [int(c if np.ndim(c) == 0 else c[0]) for c in chunks]


def _region_labels(values, first):
    """Returns the labels of a region [z, y, x], of which first is the first voxel, as 64 bits."""
    if values.dtype.kind == "f":
        whole = np.rint(values)
        with np.errstate(invalid="ignore"):
            wrong = np.argwhere(~(np.abs(values - whole) <= _ROUNDING)
                                | (whole.astype(np.int64) != whole))
        if len(wrong):
            voxel = tuple(int(a + b) for a, b in zip(first, wrong[0][::-1]))
            raise InputError(f"array: voxel {voxel}: value {values[tuple(wrong[0])]} is no whole "
                             "number of 64 bits; is this an image, or probabilities?")
        if (whole != values).any():
            warnings.warn(f"labels: numbers within {_ROUNDING} of whole ones are rounded to them",
                          RuntimeWarning)
        values = whole
    return whole_numbers(values, "array")


def _check_sign(labels, dtype):
    """Refuses labels of a region that the array's type cannot have; the library, which has
    the bits of labels alone, refuses those that are too large for it."""
    is_signed = np.dtype(dtype).kind in "if"
    limit = np.iinfo(np.int64).max
    if labels.size and (labels.max() > limit if is_signed else labels.min() < 0):
        raise InputError(f"array: a region has a label that {np.dtype(dtype)}, the type of the "
                         "array, cannot hold; give the array the type of its labels")


def _region_volume(array, axes, space):
    shape = [int(n) for n in array.shape]
    chunk = _chunk(array)
    if axes == "zyx":
        shape, chunk = shape[::-1], chunk[::-1]

    def fetch(x0, y0, z0, x1, y1, z1):
        if axes == "zyx":
            values = np.asarray(unmasked(array[z0:z1, y0:y1, x0:x1]))
        else:
            values = np.asarray(unmasked(array[x0:x1, y0:y1, z0:z1])).T
        labels = _region_labels(values, (x0, y0, z0))
        _check_sign(labels, array.dtype)
        return np.ascontiguousarray(labels)

    return _handles.volume_of_region(fetch, np.dtype(array.dtype), shape, chunk, space)


def _array_volume(array, axes, space):
    if any(stride == 0 and count > 1 for stride, count in zip(array.strides, array.shape)):
        array = np.ascontiguousarray(array)
    if array.dtype.byteorder not in "=|" and not array.dtype.isnative:
        array = array.astype(array.dtype.newbyteorder("="))
    return _handles.volume_of_array(array.T if axes == "zyx" else array, space)


def _volume(source, place):
    given = {name: value for name, value in place.items() if value is not None}
    if isinstance(source, (str, os.PathLike)):
        if given.keys() & {"affine", "unit", "axes"}:
            raise UsageError("affine, unit and axes are for arrays: files tell their own")
        return _handles.open_volume(path_bytes(source, "volume"), options_of(None, given))
    others = [name for name in PLACE
              if name not in _OF_ARRAYS and given.get(name, False) is not False]
    if others:
        raise UsageError(f"{', '.join(others)}: for files only, and this is an array"
                         + ("; slice it" if "crop" in others else ""))
    spacing, origin, affine, frame, unit, axes = map(given.get, _OF_ARRAYS)
    frame, unit_text = text(frame, "frame"), text(unit, "unit")
    stated = None
    if _is_image(source):
        if spacing is not None or origin is not None:
            raise UsageError("spacing, origin: an image tells where it lies; give affine instead")
        if affine is None and source.affine is None:
            raise UsageError("affine: the image has none, give one")
        if affine is None:
            stated = _image_spacing(source)
            affine, frame = _image_affine(source, frame), frame or "ras"
        unit_text = _image_unit(source) if unit is None else unit_text
        source, axes = _image_array(source), axes or "xyz"
    axes = axes or ("xyz" if affine is not None else "zyx")
    if axes not in AXES:
        raise unexpected("axes", "zyx or xyz", axes)
    if frame and frame not in FRAMES:
        raise unexpected("frame", "own, ras, lps or voxel", frame)
    if not hasattr(source, "shape") or not hasattr(source, "dtype"):
        source = np.asarray(source)
    if len(source.shape) != 3:
        raise UsageError(f"array: has {len(source.shape)} axes, expected 3; take one volume of it")
    space = _space(spacing, origin, affine, frame, unit_text, stated)
    make = _array_volume if isinstance(source, np.ndarray) else _region_volume
    return make(unmasked(source), axes, space)


def native(array):
    """Returns a copy of an array in the machine's byte order."""
    array = np.asarray(unmasked(array))
    return np.array(array, dtype=array.dtype.newbyteorder("="), order="C")


def array_of(source, volume, place):
    """Returns a copy of the labels of a source, as an array of its own type, and whether that is
    indexed [z, y, x].  volume: as_volume(source, **place)."""
    if isinstance(source, (str, os.PathLike, _handles.Volume)):
        labels = volume.labels()
        stored = labels.astype(volume.dtype)
        # Scaled numbers need not fit the type of what is stored.
        return (stored if np.array_equal(stored, labels) else labels), True
    is_image = _is_image(source)
    usual = "xyz" if is_image or place.get("affine") is not None else "zyx"
    array = native(_image_array(source) if is_image else source)
    return array, (place.get("axes") or usual) == "zyx"


def as_volume(source, *, names=None, **place):
    """Returns a volume from a path, a nibabel image, a numpy array, or an array that is read by
    region (h5py, Zarr, dask: an object with shape, dtype and slices).  See mwmesh.mesh()."""
    check_names(place, PLACE)
    if not isinstance(source, _handles.Volume):
        source = _volume(source, place)
    elif place:
        raise UsageError(f"{next(iter(place))}: the volume has its place already")
    return named(source, names)
