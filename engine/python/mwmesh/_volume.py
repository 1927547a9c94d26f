# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Whatever holds labels, as a volume of the library."""

import os

import numpy as np

from . import _core
from ._errors import UsageError

#: Arrays are indexed [z, y, x], as .npy, HDF5, Zarr and TIFF have them, unless told otherwise.
AXES = ("zyx", "xyz")


def _is_image(source):
    """Whether it is a nibabel image."""
    return hasattr(source, "dataobj") and hasattr(source, "affine")


def _image_array(image):
    """The labels of a nibabel image as they are stored where nothing scales them."""
    proxy = image.dataobj
    slope, inter = getattr(proxy, "slope", 1), getattr(proxy, "inter", 0)
    if hasattr(proxy, "get_unscaled") and (slope, inter) == (1, 0):
        return proxy.get_unscaled()
    return np.asanyarray(proxy)


def _image_unit(image):
    units = getattr(image.header, "get_xyzt_units", None)
    return {"mm": "mm", "meter": "m", "micron": "um"}.get(units()[0], "") if units else ""


def _space(spacing, origin, affine, frame, unit):
    if affine is not None:
        if spacing is not None or origin is not None:
            raise UsageError("affine: spacing and origin follow from it, leave them out")
        matrix = np.asarray(affine, dtype=float)
        if matrix.shape not in ((3, 4), (4, 4)):
            raise UsageError("affine: expected a matrix of 4 x 4 or 3 x 4")
        space = _core.space_of_affine(matrix[:3].tolist(), frame or "own")
    else:
        space = _core.Space()
        if spacing is not None:
            space.spacing = _three(spacing, "spacing")
        if origin is not None:
            space.origin = _three(origin, "origin")
        space.frame = frame or "own"
    space.unit = unit or ""
    return space


def _three(values, what):
    numbers = [float(v) for v in np.broadcast_to(np.asarray(values, dtype=float), (3,))]
    if np.ndim(values) == 0 and what == "origin":
        raise UsageError("origin: expected (x, y, z)")
    return numbers


def _chunk(array):
    """The shape of what an array is stored in, in the order of its axes; zeros where it does not
    say."""
    chunks = getattr(array, "chunks", None)
    if not chunks or len(chunks) != 3:
        return [0, 0, 0]
    return [int(c if np.ndim(c) == 0 else c[0]) for c in chunks]


def _whole_numbers(values):
    """As integers of 64 bits; raises where a float is none."""
    if values.dtype.kind == "f":
        whole = values.astype(np.int64)
        if not np.array_equal(whole, values):
            raise UsageError("array: labels must be whole numbers")
        return whole
    if values.dtype.kind == "u" or values.dtype.kind == "b":
        return values.astype(np.uint64)
    return values.astype(np.int64)


def _region_volume(array, axes, space, names):
    shape = [int(n) for n in array.shape]
    chunk = _chunk(array)
    if axes == "zyx":
        shape, chunk = shape[::-1], chunk[::-1]

    def fetch(x0, y0, z0, x1, y1, z1):
        if axes == "zyx":
            values = np.asarray(array[z0:z1, y0:y1, x0:x1])
        else:
            values = np.asarray(array[x0:x1, y0:y1, z0:z1]).T
        return np.ascontiguousarray(_whole_numbers(values))

    return _core.volume_of_region(fetch, np.dtype(array.dtype), shape, chunk, space, names)


def _array_volume(array, axes, space, names):
    if array.dtype.byteorder not in "=|" and not array.dtype.isnative:
        array = array.astype(array.dtype.newbyteorder("="))
    return _core.volume_of_array(array.T if axes == "zyx" else array, space, names)


def _name_rows(names):
    return [_core.LabelName(int(label) & (2**64 - 1), str(name))
            for label, name in (names or {}).items()]


def _file_volume(path, spacing, origin, frame, dataset, scale, crop):
    box = None
    if crop is not None:
        low, high = crop
        box = ([int(v) for v in low], [int(v) for v in high])
    return _core.open_volume(
        os.fspath(path), dataset or "", scale,
        None if spacing is None else _three(spacing, "spacing"),
        None if origin is None else _three(origin, "origin"), frame or "file", box)


def as_volume(source, *, spacing=None, origin=None, affine=None, frame=None, unit=None, axes=None,
              names=None, dataset=None, scale=None, crop=None):
    """The library's volume of a path, a nibabel image, a numpy array, or an array that is read by
    region (h5py, Zarr, dask: what has shape, dtype and slices).  See mwmesh.mesh()."""
    if isinstance(source, _core.Volume):
        return source
    if isinstance(source, (str, os.PathLike)):
        if affine is not None or unit is not None or axes is not None:
            raise UsageError("affine, unit and axes are for arrays: files tell their own")
        volume = _file_volume(source, spacing, origin, frame, dataset, scale, crop)
        return volume.with_names(_name_rows(names)) if names else volume
    if dataset is not None or scale is not None or crop is not None:
        raise UsageError("dataset, scale and crop are for files: slice the array")
    if _is_image(source):
        if affine is None and spacing is None and origin is None:
            affine, frame = source.affine, frame or "ras"
        unit = _image_unit(source) if unit is None else unit
        source, axes = _image_array(source), axes or "xyz"
    axes = axes or ("xyz" if affine is not None else "zyx")
    if axes not in AXES:
        raise UsageError(f"axes {axes}: expected zyx or xyz")
    if not hasattr(source, "shape") or not hasattr(source, "dtype"):
        source = np.asarray(source)
    if len(source.shape) != 3:
        raise UsageError(f"array: has {len(source.shape)} axes, expected 3; take one volume of it")
    space = _space(spacing, origin, affine, frame, unit)
    make = _array_volume if isinstance(source, np.ndarray) else _region_volume
    return make(source, axes, space, _name_rows(names))
