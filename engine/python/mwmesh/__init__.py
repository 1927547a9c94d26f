# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Labelled voxels to one conforming tetrahedral mesh, with the topology of every label kept.

>>> import mwmesh
>>> grains = mwmesh.synth("voronoi", (20, 16, 12), labels=5, seed=1)  # an array [z, y, x]
>>> mesh = mwmesh.mesh(grains, spacing=(1, 1, 2), max_distance=1)
>>> sorted(mesh.volumes()) == list(mesh.label_list())
True
>>> bool(mesh.verify(grains, spacing=(1, 1, 2)))
True
"""

import json
import os
import sys

from . import _core
from ._errors import (CancelledError, CheckFailedError, Error, InputError, InternalError,
                      ResourceError, UsageError)
from ._mesh import Mesh, Surface, Verdict
from ._volume import as_volume

__version__ = _core.__version__
__all__ = [
    "CancelledError", "CheckFailedError", "Error", "InputError", "InternalError", "Mesh",
    "ResourceError", "Surface", "UsageError", "Verdict", "as_volume", "mesh", "mesh_to_file",
    "read", "settings", "synth",
]


def _setting_text(value):
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):  # sizes by label
        return ",".join(f"{label}={_setting_text(size)}" for label, size in value.items())
    if isinstance(value, float):
        return repr(value)
    return str(value)


def _label(label):
    """As the library has them: 64 bits, negative ones in two's complement."""
    return int(label) & (2**64 - 1)


def _options(threads=0, memory=None, labels=None, background=None, merge=None, drop_specks=None,
             workdir=None, resume=False, certify="auto", report=True):
    options = _core.Options()
    options.threads = threads
    if memory is not None:
        options.memory = memory if isinstance(memory, int) else _core.bytes_of_text(memory)
    if labels is not None:
        options.labels = [_label(label) for label in labels]
        if not options.labels:
            raise UsageError("labels: the list is empty")
    if background is not None:
        options.background = _label(background)
    options.merge = {_label(a): _label(b) for a, b in (merge or {}).items()}
    specks, corners = drop_specks if isinstance(drop_specks, tuple) else (drop_specks, 6)
    options.drop_specks = specks or 0
    if corners not in (6, 26):
        raise UsageError("drop_specks: expected voxels, or (voxels, 26)")
    options.specks_joined_by_corners = corners == 26
    options.workdir = os.fspath(workdir) if workdir is not None else ""
    options.resume = resume
    known = {"auto": _core.Certify.auto, "on": _core.Certify.on, "off": _core.Certify.off}
    if certify not in known:
        raise UsageError(f"certify {certify}: expected auto, on or off")
    options.certify = known[certify]
    options.report = report
    return options


class _Bar:
    """tqdm, where it is there."""

    def __init__(self, tqdm):
        self._bar = tqdm(unit=" windows", leave=False)

    def __call__(self, done, total, _seconds_left):
        self._bar.total = total
        self._bar.update(done - self._bar.n)

    def close(self):
        self._bar.close()


def _progress(wanted):
    """wanted: None (a bar on a terminal), True, False, or a function."""
    if callable(wanted):
        return wanted
    if wanted is False or (wanted is None and not sys.stderr.isatty()):
        return None
    try:
        from tqdm.auto import tqdm
    except ImportError:
        if wanted:
            raise
        return None
    return _Bar(tqdm)


_PLACE = ("spacing", "origin", "affine", "frame", "unit", "axes", "names", "dataset", "scale",
          "crop")
_OPTIONS = ("threads", "memory", "labels", "background", "merge", "drop_specks", "workdir",
            "resume", "certify", "report")


def _run(call, volume, arguments, progress):
    place = {k: arguments.pop(k) for k in _PLACE if k in arguments}
    options = {k: arguments.pop(k) for k in _OPTIONS if k in arguments}
    settings_text = {k: _setting_text(v) for k, v in arguments.items()}
    bar = _progress(progress)
    try:
        return call(as_volume(volume, **place), settings_text, _options(**options), bar)
    finally:
        if isinstance(bar, _Bar):
            bar.close()


def mesh(volume, *, progress=None, **arguments):
    """Meshes a labelled volume.

    volume
        a path of any format that ``mwmesh info`` reads; a numpy array, which is not copied; a
        nibabel image; or what has shape, dtype and slices (h5py, Zarr, dask), which is read box by
        box.  Labels are integers, or floats that are whole numbers.
    spacing, origin
        (x, y, z): edges of a voxel, and the first corner of the first voxel.
    affine
        4 x 4, from indices of voxels (x, y, z), at their centres, to the world, instead of both.
    axes
        how arrays are indexed: "zyx" (as in .npy, HDF5, Zarr, TIFF), or "xyz" (as in NIfTI; the
        default with an affine and for nibabel images).
    frame, unit, names
        "ras" or "lps"; "mm", "um" and so on; {label: name}.
    dataset, scale, crop
        of files: the array within, the level of a pyramid, ((x0, y0, z0), (x1, y1, z1)).
    merge, drop_specks
        {label: label that it becomes}; then components of fewer voxels take the label around them,
        joined by faces, or with (voxels, 26) by corners too.
    labels, background
        the labels that the mesh is to have, or the one that it is not; all are meshed.
    threads, memory
        0: all cores; bytes or "8GiB", beside the arrays of volume and mesh [half of what is free].
    workdir, resume
        a folder for what does not fit, and to go on from after an interrupted run.
    certify
        "auto", "on" or "off": the mesh is checked before it is returned, see CheckFailedError.
    report
        False: quality and shape are not measured, Mesh.report is None.
    progress
        None: a bar of tqdm on a terminal; True, False; or a function of done and total windows, and
        of the seconds left (or None).
    others
        the settings of ``mwmesh mesh``, listed by :func:`settings`: max_distance=1.5,
        quality_floor=0.2, surface="voxel", topology="interfaces", size={3: 0.5}, ...

    Returns a :class:`Mesh`.  The same volume and settings give the same mesh for any number of
    threads, memory and workdir.  Ctrl-C ends the run.
    """
    return Mesh._of(_run(_core.mesh, volume, arguments, progress))


def mesh_to_file(volume, path, *, element="tet4", progress=None, **arguments):
    """As :func:`mesh`, into a file, so that the mesh is never whole in memory.  Returns the report.
    element: "tet4" or "tet10"."""

    def call(*run):
        return _core.mesh_to_file(os.fspath(path), *run, element)

    report = _run(call, volume, arguments, progress)
    return json.loads(report) if report else None


def read(path):
    """A mesh from a file of any format of ``mwmesh convert``."""
    return Mesh._of(_core.read_mesh(os.fspath(path)))


def synth(kind, shape, labels=2, seed=0):
    """A random volume, an array [z, y, x]; kind: "voronoi", "tubes", "spheres", "noise" or
    "checkerboard"; shape: (x, y, z).

    >>> import mwmesh
    >>> mwmesh.synth("noise", (4, 3, 2), labels=2, seed=1).shape
    (2, 3, 4)
    """
    return _core.synth(kind, [int(n) for n in shape], labels, seed)


def settings():
    """{name: (help, default, choices)} of all settings that a mesh depends on."""
    return {name: (text, default, choices)
            for name, text, default, choices in _core.settings()}
