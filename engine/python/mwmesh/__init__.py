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
import sys
from collections.abc import Mapping, Set

import numpy as np

from . import _core

try:
    from ._stamp import STAMP as _stamp
except ImportError:  # modules that no build has put beside the core say nothing of it
    _stamp = None
if _stamp not in (None, getattr(_core, "stamp", "")):
    raise ImportError(f"mwmesh: {_core.__file__} and the Python modules beside it are of different "
                      "builds: build the target mwmesh_python again, or reinstall the package")

from ._errors import (CancelledError, CheckFailedError, Error, InputError, InternalError,
                      MissingPackageError, ResourceError, UsageError)
from ._mesh import Materials, Mesh, Picture, Surface, Verdict
from ._values import (check_names, count, file_options, label, naming, numbers, one_or_more,
                      path_bytes, switch, text, unexpected, whole)
from ._session import Session
from ._volume import PLACE, as_volume

__version__ = _core.__version__
__all__ = [
    "CancelledError", "CheckFailedError", "Error", "InputError", "InternalError", "Materials",
    "Mesh", "MissingPackageError", "Picture", "ResourceError", "Surface", "UsageError", "Verdict", "as_volume", "mesh", "mesh_to_file",
    "Session", "read", "settings", "synth",
]


def __dir__():
    return [*__all__, "__version__", "__doc__"]


def _setting_text(value):
    if value is None:
        return "none"
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if not isinstance(value, (float, np.floating)):
        return str(value)
    number = float(value)
    return str(int(number)) if number.is_integer() else repr(number)


def _size_text(volume, value):
    """Sizes as the command line has them, with labels by name or by number."""
    if isinstance(value, dict):
        return ",".join(f"{_size_place(volume, key)}={_setting_text(size)}"
                        for key, size in value.items())
    with naming("size"):
        return _core.with_label_numbers(volume, _setting_text(value))


def _size_place(volume, key):
    """Returns the text for the key of a size: a label, an interface (a, b), or "*" for others."""
    if key == "*":
        return key
    return "|".join(str(label(volume, k, "size"))
                    for k in (key if isinstance(key, tuple) else (key,)))


def _options(volume, threads=0, memory=None, labels=None, background=None, merge=None,
             drop_specks=None, workdir=None, resume=False, keep=None, keep_bytes=None,
             from_kept=False, changed=(), sample=None, certify="auto", report=True, parts="all",
             split=(), cohesive=(), open_hinges=False, weld=None, force=False):
    options = _core.Options()
    options.threads = whole(threads, "threads", 32)
    if memory is not None:
        options.memory = _bytes(memory, "memory")
    options.labels = _labels(volume, labels, "labels")
    if background is not None:
        options.background = label(volume, background, "background")
    options.parts = text(parts, "parts") if isinstance(parts, str) else str(whole(parts, "parts"))
    if options.parts not in ("all", "largest") and not (options.parts.isdecimal()
                                                        and int(options.parts)):
        raise unexpected("parts", "all, largest, or a number of tets", parts)
    options.split = _pairs_text(volume, split, "split")
    options.cohesive = _pairs_text(volume, cohesive, "cohesive")
    options.open_hinges = switch(open_hinges, "open_hinges")
    if merge is not None and not isinstance(merge, Mapping):
        raise unexpected("merge", "{label: label that it becomes}", merge)
    options.merge = {label(volume, a, "merge"): label(volume, b, "merge")
                     for a, b in (merge or {}).items()}
    specks = drop_specks if isinstance(drop_specks, tuple) else (drop_specks, 6)
    if len(specks) != 2 or specks[1] not in (6, 26):
        raise unexpected("drop_specks", "voxels, or (voxels, 26)", drop_specks)
    options.drop_specks = count(specks[0] or 0, "drop_specks")
    options.specks_joined_by_corners = specks[1] == 26
    options.weld = _labels(volume, weld, "weld")
    options.workdir = path_bytes(workdir, "workdir") if workdir is not None else ""
    options.resume = switch(resume, "resume")
    options.keep = path_bytes(keep, "keep") if keep is not None else ""
    if keep_bytes is not None:
        options.keep_bytes = _bytes(keep_bytes, "keep_bytes")
    options.from_kept = switch(from_kept, "from_kept")
    if not isinstance(changed, (list, tuple)):
        raise unexpected("changed", "a list of boxes", changed)
    options.changed = [_box(box, "changed") for box in changed]
    options.sample = _samples({} if sample is None else sample)
    known = {"auto": _core.Certify.auto, "on": _core.Certify.on, "off": _core.Certify.off}
    if not isinstance(certify, str) or certify not in known:
        raise unexpected("certify", "auto, on or off", certify)
    options.certify = known[certify]
    options.report = switch(report, "report")
    options.force = switch(force, "force")
    return options


def _bytes(value, name):
    """The bytes that a number or a text like "8GiB" means."""
    size = value if isinstance(value, str) else str(whole(value, name, 80))
    with naming(name):
        return _core.bytes_of_text(size)


def _labels(volume, value, name):
    """The labels of a list or of one label; none without a value."""
    if value is None:
        return []
    labels = [label(volume, one, name) for one in one_or_more(value)]
    if not labels:
        raise UsageError(f"{name}: the list is empty")
    return labels


def _pairs_text(volume, value, name):
    """"*", or pairs of labels."""
    if isinstance(value, str) and value == "*":
        return value
    if isinstance(value, str) or not isinstance(value, (list, tuple, Set)):
        raise unexpected(name, "pairs of labels, or *", value)
    for pair in value:
        if not isinstance(pair, tuple) or len(pair) != 2:
            raise unexpected(name, "pairs of labels such as (1, 2)", pair)
    pairs = [tuple(label(volume, one, name) for one in pair) for pair in value]
    if any(a == b for a, b in pairs):
        raise UsageError(f"{name}: two labels make a pair")
    if name == "cohesive" and len({frozenset(pair) for pair in pairs}) < len(pairs):
        raise UsageError(f"{name}: a pair is there twice")
    return ",".join(f"{a}|{b}" for a, b in pairs)


def _samples(sample):
    """Returns NAME=FILE;NAME=FILE as bytes, from {name: file}."""
    if not isinstance(sample, Mapping):
        raise unexpected("sample", "{name: file}", sample)
    parts = [text(name, "sample").encode() + b"=" + path_bytes(file, "sample")
             for name, file in sample.items()]
    if any(b";" in part for part in parts):
        raise UsageError("sample: a path with ';' in it is not taken, rename the file or link to it")
    return b";".join(parts)


def _box(box, name):
    """((x0, y0, z0), (x1, y1, z1)), whole numbers."""
    corners = numbers(box, name, "((x0, y0, z0), (x1, y1, z1))", (2, 3))
    return tuple([whole(n, name) for n in corner] for corner in corners)


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


_OPTIONS = ("threads", "memory", "labels", "background", "merge", "drop_specks", "workdir",
            "resume", "keep", "keep_bytes", "from_kept", "changed", "sample", "certify", "report",
            "parts", "split", "cohesive", "open_hinges", "weld", "force")


def _run(call, volume, arguments, progress):
    place = {k: arguments.pop(k) for k in (*PLACE, "names") if k in arguments}
    options = {k: arguments.pop(k) for k in _OPTIONS if k in arguments}
    check_names(arguments, settings(), (*PLACE, "names", *_OPTIONS, "progress"))
    volume = as_volume(volume, **place)
    settings_text = {k: _size_text(volume, v) if k == "size" else _setting_text(v)
                     for k, v in arguments.items() if k != "size" or v is not None}
    bar = _progress(progress)
    try:
        chosen = _options(volume, **options)
        chosen.object = _labels(volume, place.get("object"), "object")
        return call(volume, settings_text, chosen, bar)
    finally:
        if isinstance(bar, (_Bar, _Line)):
            bar.close()


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
        it replaces spacing and origin.  That of ``mwmesh info --json`` is about their first corners:
        add half of each of its first three columns to the last one.
    axes
        how arrays are indexed: "zyx" (as in .npy, HDF5, Zarr, TIFF), or "xyz" (as in NIfTI; the
        default with an affine and for nibabel images).
    frame, unit, names
        "ras" or "lps", or "voxel" to keep nothing but the spacing ("own" for arrays and "file" for
        files: the frame that they have); "mm", "um" and so on; {label: name}, a list of the names
        of labels 0, 1, 2 and so on, or a file of ``mwmesh mesh --names``, which may have colours.
        Labels are given by number or by name, wherever they are, except for object.
    dataset, scale, crop, overlap, values, object, trust_paths, cache, use_form
        for files: the array to read, the level of a pyramid, the box ((x0, y0, z0), (x1, y1, z1))
        to keep, as the data set counts voxels (engine/MANUAL.md), which label a voxel of several masks gets ("first", "last", or "all": one for each
        set of masks), what the numbers are ("labels", or "probabilities" of classes or signed
        "distances" of labels, whose crossings then place the interfaces), labels that alone matter
        and that the mesh is to have (a number or a list of numbers; all others become 0; coarser scales tell
        where to read), whether files that headers name may be outside of their folder, and a folder
        that keeps what servers send for later runs ("DIR", or "DIR,SIZE" with the most bytes);
        without it chunks are fetched two or three times, once in each pass over the volume; and the
        place of a NIfTI file that counts, "sform" or "qform".
    merge, drop_specks, weld
        {label: label that it becomes}; then components of fewer voxels than drop_specks take the
        label around them.  Voxels are joined by faces, with (voxels, 26) by corners too.  Then
        voxels of the label (or list of labels) weld are filled where others hang together by an
        edge or a corner alone.
    labels, background
        the labels that the mesh is to have, or the one that is left out; all of them are meshed.
    parts, split, cohesive, open_hinges
        "all", "largest" or the least number of tets of a part, which is what faces join; pairs of
        labels, [(1, 2), ("Liver", "Lesion")], whose interfaces open because their points are
        doubled, or "*" for all; pairs that are split, too, and get wedges of no thickness, from the
        first label to the second (:attr:`Mesh.wedges`); whether points at which parts hang are doubled, too.  The report
        counts parts and hinges ("parts").
    threads, memory
        number of threads (0: all cores); bytes, or a text like "8GiB", in addition to the arrays of
        volume and mesh (half of what is free by default).
    workdir, resume
        a folder for spilled blocks and checkpoints; whether to go on from the checkpoint in it, or
        from what a run that was interrupted left in keep.
    keep, keep_bytes, from_kept, changed
        a folder, used instead of workdir, that holds what a later run of the volume, edited, need
        not do again (set order="colour"); the most bytes that it takes when a run ends, as memory has them; whether
        an earlier run has left something there; and a list of boxes
        ((x0, y0, z0), (x1, y1, z1)) that have all changes since the last call that returned, also
        those of calls that raised.  :class:`Session` does it all.
    sample
        {name: image file}: the image's mean in each tet becomes Mesh.values[name]; the file may end
        in ":min", ":max" or ":mode".  It lies where it says itself, a .npy on the volume's voxels.
    certify
        "auto", "on" or "off": the mesh is checked before it is returned, see CheckFailedError.
    report
        False: quality and shape are not measured, and Mesh.report is None.
    force
        True: meshes a volume that looks like the grey values of an image, which else is an error.
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
    return Mesh._of(_run(_core.mesh, volume, arguments, progress))


def mesh_to_file(volume, path, *, element="tet4", materials=None, deck=False, pairs=None,
                 progress=None, **arguments):
    """Meshes as :func:`mesh` does, into a file, so that the mesh is never whole in memory.  Returns
    the report.  element, materials, deck, pairs: those of :meth:`Mesh.save`."""

    file = path_bytes(path, "path")

    def call(*run):
        return _core.mesh_to_file(file, *run, file_options(element, True, materials, deck, pairs))

    report = _run(call, volume, arguments, progress)
    return json.loads(report) if report else None


def read(path):
    """Reads a mesh from a file of any format that ``mwmesh convert`` reads: .vtkhdf, .vtu, .mesh,
    .msh, .msh2 and .pvtu."""
    return Mesh._of(_core.read_mesh(path_bytes(path, "path")))


def synth(kind, shape, labels=2, seed=0):
    """Returns a random volume as an array [z, y, x].  kind: "voronoi", "tubes", "spheres", "noise"
    or "checkerboard".  shape: (x, y, z).

    >>> import mwmesh
    >>> mwmesh.synth("noise", (4, 3, 2), labels=2, seed=1).shape
    (2, 3, 4)
    """
    extents = numbers(shape, "shape", "(x, y, z)", (3,))
    return _core.synth(text(kind, "kind"), [whole(n, "shape") for n in extents],
                       count(labels, "labels"), count(seed, "seed"))


def settings():
    """Returns {name: (help, default, choices)} of all settings that a mesh depends on."""
    return {name: (text, default, choices)
            for name, text, default, choices in _core.settings()}
