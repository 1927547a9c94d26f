# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""One volume, edited again and again."""

import os
import shutil
import tempfile
import threading
import warnings
import weakref

import numpy as np

from . import _handles
from ._errors import UsageError
from ._values import numbers, unexpected, unmasked, whole
from ._volume import PLACE, array_of, as_volume, native


def _extent(mask):
    """The corners of the smallest box that has all True of an array, or None."""
    if not mask.any():
        return None
    spans = []
    for axis in range(mask.ndim):
        others = tuple(a for a in range(mask.ndim) if a != axis)
        where = np.flatnonzero(mask.any(axis=others))
        spans.append((int(where[0]), int(where[-1]) + 1))
    return spans


class Session:
    """A volume and its mesh, which follow edits at the cost of what an edit reaches.

    array
        labels, as :func:`mesh` takes them: an array, an image, or a file, whose labels the session
        copies into an array of its own (:attr:`Session.array`).  That of a file is indexed [z, y, x].
    keep
        a new folder for what is kept, which stays afterwards and is also that of ``mwmesh mesh
        --from``: after another run in it, an update reads the whole array, and its delta, which
        is about the labels of that run, comes with a RuntimeWarning.  None: a temporary folder,
        which goes with the session.
    from_kept
        whether to begin with what an earlier session or run has left in keep; the array is read
        whole, and may have been edited meanwhile.
    settings
        everything else that :func:`mesh` takes, except report, the order of windows, object, and
        values and overlaps that give a voxel more than one label.

    Each mesh is, byte for byte, the one that ``mesh(array, **settings)`` would give
    if that had the labels as they are now.

    >>> import mwmesh
    >>> session = mwmesh.Session(mwmesh.synth("voronoi", (20, 16, 12), labels=5, seed=1), window=8)
    >>> mesh, delta = session.update(((3, 3, 3), (6, 6, 6)), 2)
    >>> delta["box"]["to"]
    [6, 6, 6]
    """

    def __init__(self, array, *, keep=None, from_kept=False, **settings):
        for name in ("changed", "report", "workdir", "resume", "order"):
            if name in settings:
                raise UsageError(f"{name}: a session settles that itself")
        for name, only in (("values", "labels"), ("overlap", "one label for each voxel")):
            if settings.get(name) not in (None, "labels", "first", "last"):
                raise UsageError(f"{name}: a session edits {only}, not {settings[name]!r}")
        if settings.get("object") is not None:
            raise UsageError("object: a session has a box that stays; give crop and labels instead")
        if from_kept and keep is None:
            raise UsageError("from_kept: needs the folder of an earlier session, name it with keep")
        if keep is None:
            keep = tempfile.mkdtemp(prefix="mwmesh-session-")
            weakref.finalize(self, shutil.rmtree, keep, ignore_errors=True)
        self._keep = keep
        place = {name: settings.pop(name) for name in (*PLACE, "names") if name in settings}
        self._settings = settings
        made = as_volume(array, **place)
        self._space, self._names = made.space, made.names
        self._array, self._is_zyx = array_of(array, made, place)
        self._turn = threading.RLock()  # held by the thread that updates
        self._is_updating = False
        self._refused = []  # boxes of updates that raised, which may be in the folder all the same
        self._kept = None  # which labels this session has left in the folder
        self._last = self._run(from_kept=from_kept)

    def __reduce_ex__(self, protocol):
        raise UsageError("a session has a folder of its own and cannot be copied; "
                         "begin another one with session.array")

    @property
    def array(self):
        """The labels as they are now; a view that cannot be written."""
        view = self._array.view()
        view.flags.writeable = False
        return view

    @property
    def mesh(self):
        """The :class:`Mesh` of the labels as they are now."""
        return self._last

    def update(self, *edit):
        """update(box, values) writes values (the number of a label, or an array of them, indexed
        as the session's) into box, ((x0, y0, z0), (x1, y1, z1)); update(array) replaces all labels.

        Returns the new :class:`Mesh` and the delta, a dict: "box" and "voxels_changed"; "labels"
        that gained or lost voxels, with voxels and Betti numbers before and after; "contacts" whose
        faces changed in number; and the size of the "mesh".  When it raises, array and mesh are as
        they were, and the next update first makes the folder so, too.  Updates from several threads
        come one after the other.
        """
        with self._turn:
            if self._is_updating:
                raise UsageError("update: a function that an update calls may not update again")
            self._is_updating = True
            try:
                return self._update(edit)
            finally:
                self._is_updating = False

    def _update(self, edit):
        before = self._array
        after = self._edited(*edit)
        self._restore()
        spans = _extent(before != after)
        box = [(0, 1), (0, 1), (0, 1)] if spans is None else spans
        if self._is_zyx:
            box = box[::-1]
        changed = (tuple(lo for lo, _ in box), tuple(hi for _, hi in box))
        self._array = after
        try:
            self._last = self._run(from_kept=True, changed=[changed])
        except BaseException:
            self._array = before
            self._refused.append(changed)
            raise
        return self._last, self._last.report["delta"]

    def _restore(self):
        """Makes the folder that of the array again, after updates that raised.  The run of such an
        update may have been complete, as where the function for progress raised at the end; only
        a run tells."""
        if self._refused:
            self._run(from_kept=True, changed=self._refused, report=False, progress=False)
            self._refused = []

    def _run(self, **arguments):
        from . import mesh
        if self._kept is not None and self._kept != self._labels_kept():
            arguments.pop("changed", None)  # another run was here: all labels are read
            warnings.warn(f"{self._keep}: another run was here since the last update; the delta "
                          "tells what changed since that run", RuntimeWarning, stacklevel=4)
        made = mesh(self._volume(), keep=self._keep,
                    **{**self._settings, "order": "colour", **arguments})
        self._kept = self._labels_kept()
        return made

    def _volume(self):
        """The labels as they are now, where the session's volume lies."""
        array = self._array.T if self._is_zyx else self._array
        return _handles.volume_of_array(array, self._space, self._names)

    def _labels_kept(self):
        """What tells the file of labels in the folder from those of other runs."""
        try:
            found = os.stat(os.path.join(self._keep, "labels"))
        except OSError:
            return None
        return found.st_ino, found.st_mtime_ns, found.st_size

    def _edited(self, *edit):
        if len(edit) == 1:
            array = native(edit[0])
            if array.shape != self._array.shape or array.dtype != self._array.dtype:
                raise unexpected("array", f"shape {self._array.shape} of {self._array.dtype}",
                                 f"{array.shape} of {array.dtype}")
            return array
        if len(edit) != 2:
            raise UsageError("update: expected a box and values, or an array")
        corners = numbers(edit[0], "box", "((x0, y0, z0), (x1, y1, z1))", (2, 3))
        lo, hi = ([whole(n, "box") for n in corner] for corner in corners)
        if self._is_zyx:
            lo, hi = lo[::-1], hi[::-1]
        for first, end, extent in zip(lo, hi, self._array.shape):
            if not 0 <= first <= end <= extent:
                raise unexpected("box", "corners inside the array, the lower first", edit[0])
        array = self._array.copy()
        part = array[tuple(slice(a, b) for a, b in zip(lo, hi))]
        part[...] = self._labels(edit[1], part)
        return array

    def _labels(self, values, part):
        """The labels that update() was given for a part of the array, in its type."""
        given = np.asarray(unmasked(values, "values"))
        if given.dtype.kind not in "biu":
            raise unexpected("values", "the number of a label, or an array of them", values)
        labels = given.astype(self._array.dtype)
        if not (np.array_equal(labels, given) and self._is_exact(given)):
            raise unexpected("values", f"labels that {self._array.dtype} can hold", values)
        try:
            return np.broadcast_to(labels, part.shape)
        except ValueError:
            raise unexpected("values", f"a label, or an array of shape {part.shape}",
                             labels) from None

    def _is_exact(self, labels):
        """Whether the array holds these labels to the last digit.  Floats do not hold all of them,
        and numpy compares whole numbers with floats as floats."""
        number = self._array.dtype.type
        return self._array.dtype.kind != "f" or all(
            int(number(label)) == label for label in np.unique(labels).tolist())
