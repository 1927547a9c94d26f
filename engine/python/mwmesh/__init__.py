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

from . import _handles
from ._errors import (CancelledError, CheckFailedError, Error, InputError, InternalError,
                      MissingPackageError, ResourceError, UsageError)
from ._homogenise import homogenise
from ._library import encoded
from ._mesh import Materials, Mesh, Picture, Surface, Verdict
from ._options import TABLE, arguments_of, documented, options_of
from ._session import Session
from ._values import check_names, count, numbers, path_bytes, text, unexpected, whole
from ._volume import PLACE, as_volume

__version__ = _handles.__version__
__all__ = [
    "CancelledError", "CheckFailedError", "Error", "InputError", "InternalError", "Materials",
    "Mesh", "MissingPackageError", "Picture", "ResourceError", "Surface", "UsageError", "Verdict", "as_volume", "homogenise", "mesh",
    "mesh_to_file", "Session", "read", "settings", "synth",
]


def __dir__():
    return [*__all__, "__version__", "__doc__"]


class _Bar:
    """A progress bar of the package tqdm."""

    def __init__(self, tqdm):
        self._bar = tqdm(unit=" windows", leave=False)

    def __call__(self, done, total, _seconds_left):
        self._bar.total = total
        self._bar.update(done - self._bar.n)

    def close(self):
        self._bar.close()


class _Line:
    """Progress as a line of text, where tqdm is missing."""

    def __call__(self, done, total, seconds_left):
        left = "" if seconds_left is None else f", about {seconds_left:.0f} s left"
        print(f"\r{done}/{total} windows{left:<28}", end="", file=sys.stderr, flush=True)

    def close(self):
        print(file=sys.stderr)


def _progress(wanted):
    """Returns the function that shows progress.  wanted: None (a bar on a terminal), True, False,
    or a function."""
    if callable(wanted):
        return wanted
    if wanted not in (None, True, False):
        raise unexpected("progress", "True, False or a function", wanted)
    if not (sys.stderr.isatty() if wanted is None else wanted):
        return None
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Line()
    return _Bar(tqdm)


def _run(call, source, uses, arguments, progress):
    """Returns call(volume, options, progress)."""
    place = {k: arguments.pop(k) for k in (*PLACE, "names") if k in arguments}
    known = [name for use in uses for name in arguments_of(use) if name not in PLACE]
    known.sort(key=lambda name: name not in settings())
    check_names(arguments, known, (*PLACE, "names", "progress"))
    volume = as_volume(source, **place)
    place.pop("names", None)
    if isinstance(source, (str, os.PathLike)):  # the same options for all
        arguments.update((k, v) for k, v in place.items() if k in TABLE and v is not None)
    options = options_of(volume, arguments)
    bar = _progress(progress)
    try:
        return call(volume, options, bar)
    finally:
        if isinstance(bar, (_Bar, _Line)):
            bar.close()


@documented("open", "mesh")
def mesh(volume, *, progress=None, **arguments):
    """Meshes a labelled volume.

    volume
        a path of any format that ``mwmesh info`` reads, or an address (``https://``, ``gs://``,
        ``s3://``) of a Zarr, N5 or precomputed volume; a numpy array, which is not copied; a
        nibabel image; or an object with shape, dtype and slices (h5py, Zarr, dask), which is read
        box by box.  Labels are integers, or floats within 0.001 of whole numbers, to which they
        are rounded with a RuntimeWarning.
    spacing, origin
        (x, y, z), or one number for all: edges of a voxel, and the first corner of the first voxel.
    affine
        a 4 x 4 matrix that takes the indices (x, y, z) of voxels, at their centres, to the world;
        it replaces spacing and origin.  ``mwmesh info`` calls it affine_of_centres.
    axes
        how arrays are indexed: "zyx" (as in .npy, HDF5, Zarr, TIFF), or "xyz" (as in NIfTI; the
        default with an affine and for nibabel images).
    frame, unit, names
        "ras" or "lps", or "voxel" to keep nothing but the spacing ("own" for arrays and "file" for
        files: the frame that they have); "mm", "um" and so on; {label: name}, a list of the names
        of labels 0, 1, 2 and so on, or a file of ``mwmesh mesh --names``, which may have colours.
        Labels are given by number or by name, wherever they are, except for object.
    crop, object, cache
        for files: the box ((x0, y0, z0), (x1, y1, z1)), as the data set counts voxels
        (engine/MANUAL.md); a number or a list of numbers; "DIR", or "DIR,SIZE" with the most bytes.
        Without a cache chunks are fetched two or three times, once in each pass over the volume.
    merge, drop_specks, interpolate_slices, weld
        applied in this order: {label: label that it becomes}; a number of voxels, or (voxels, 26)
        where they are joined by corners, too; True; a label or a list of labels.
    labels, background
        the labels that the mesh is to have, or the one that is left out; all of them are meshed.
        Label 0 is left out where the names say that it is nothing (they call it "background", or
        all other labels have a name), unless background is "none".
    parts, split, cohesive
        "all", "largest" or the least number of tets of a part, which is what faces join; pairs of
        labels, [(1, 2), ("Liver", "Lesion")], or "*".  Wedges go from the first label to the second
        (:attr:`Mesh.wedges`).  The report counts parts and hinges ("parts").
    memory
        bytes, or a text like "8GiB", in addition to the arrays of volume and mesh (half of what is
        free by default).
    keep, from_kept, changed
        a folder, used instead of workdir, that holds what a later run of the volume, edited, need
        not do again; whether an earlier run has left something there; and a list of boxes that have
        all changes since the last call that returned, also those of calls that raised.
        :class:`Session` does it all.
    sample
        {name: image file}: the image's mean in each tet becomes Mesh.values[name]; the file may end
        in ":min", ":max" or ":mode".  It lies where it says itself, a .npy on the volume's voxels.
    report
        False: quality and shape are not measured, and Mesh.report is None.
    progress
        None: a bar of tqdm (or else a line of text) on a terminal; True, False; or a function of
        done and total windows, and of the seconds left (or None).
    others
        the settings of ``mwmesh mesh``, listed by :func:`settings`: max_distance=1.5,
        quality_floor=0.2, surface="voxel", topology="interfaces", size={"Liver": 3},
        count=100_000 (about that number of tets), across=3 (edges across thin parts, at least), ...

    Returns a :class:`Mesh`.  The same volume and settings give the same mesh for any number of
    threads, memory and workdir.  Ctrl-C ends the run.
    """
    return Mesh._of(_run(_handles.make_mesh, volume, ("mesh",), arguments, progress))


def mesh_to_file(volume, path, *, progress=None, **arguments):
    """Meshes as :func:`mesh` does, into a file, so that the mesh is never whole in memory.  Returns
    the report.  element, materials, deck, pairs, ascii: those of :meth:`Mesh.save`."""
    file = path_bytes(path, "path")
    report = _run(lambda *run: _handles.mesh_to_file(file, *run), volume, ("mesh", "write"), arguments,
                  progress)
    return json.loads(report) if report else None


def read(path):
    """Reads a mesh from a file of any format that ``mwmesh convert`` reads: .vtkhdf, .vtu, .mesh,
    .msh, .msh2 and .pvtu."""
    return Mesh._of(_handles.read_mesh(path_bytes(path, "path")))


def synth(kind, shape, labels=2, seed=0):
    """Returns a random volume as an array [z, y, x].  kind: "voronoi", "tubes", "spheres", "noise"
    or "checkerboard".  shape: (x, y, z).

    >>> import mwmesh
    >>> mwmesh.synth("noise", (4, 3, 2), labels=2, seed=1).shape
    (2, 3, 4)
    """
    extents = [whole(n, "shape") for n in numbers(shape, "shape", "(x, y, z)", (3,))]
    try:
        return _handles.synth(encoded(text(kind, "kind"), "kind"), extents, count(labels, "labels"),
                           count(seed, "seed"))
    except (ValueError, MemoryError) as error:
        if isinstance(error, Error):
            raise
        raise unexpected("shape", "three extents whose voxels memory holds", shape) from None


def settings():
    """Returns {name: (help, default, choices)} of all settings that a mesh depends on."""
    return {name: (row["help"], row["default"] or "", row["choices"])
            for name, row in TABLE.items() if row["setting"]}
