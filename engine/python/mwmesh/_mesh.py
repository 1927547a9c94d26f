# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""A tetrahedral mesh of labels in memory."""

import base64
import collections
import html
import importlib
import json
import os
import subprocess
import sys
import warnings
from typing import NamedTuple

import numpy as np

from . import _handles
from ._errors import MissingPackageError, UsageError
from ._options import arguments_of, documented, options_of
from ._values import label as label_bits
from ._values import (check_names, named, numbers, one_or_more, path_bytes, switch, unexpected,
                      whole, whole_numbers)
from ._volume import PLACE, as_volume

#: The corners of a tet's faces, seen counterclockwise from outside.
_FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])


class Surface(NamedTuple):
    """Points, and triangles as rows of points, counterclockwise from outside."""

    points: np.ndarray
    triangles: np.ndarray


class Materials(NamedTuple):
    """Tets by equal ranges of a value; row i of all but `numbers` is of material i + 1."""

    numbers: np.ndarray  #: the material of each tet, from 1 on; 0 where it has no value
    begins: np.ndarray  #: the least value of each material
    ends: np.ndarray  #: where the next one begins; the last material has its end
    means: np.ndarray  #: of the values by volume; NaN without tets
    tets: np.ndarray  #: how many
    volumes: np.ndarray


class _Facets(NamedTuple):
    """Triangles between two labels, or between one and the outside of the box."""

    triangles: np.ndarray  # rows of points, counterclockwise from the side of `other`
    others: np.ndarray  # the same as `other` has them, counterclockwise from the side of `label`
    label: np.ndarray  # index of the label inside
    other: np.ndarray  # index of the label outside; -1: none


def _areas(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def _restored(points, tets, labels, names, record, in_parts, values):
    """Returns a mesh from the parts of its pickle."""
    mesh = Mesh(points, tets, labels)
    mesh._core.with_names([_handles.LabelName(*row) for row in names])
    mesh._core.set_record(record, in_parts)
    for name, column in values.items():
        mesh._core.set_values(name, column)
    return mesh


def _distinct(names):
    """Returns {name: label} from {label: name}; a name that several labels have gets the label
    behind it, as in files."""
    uses = collections.Counter(names.values())
    out = {name: label for label, name in names.items() if uses[name] == 1}
    for label, name in names.items():
        if uses[name] > 1:
            key = f"{name} ({label})"
            while key in out:
                key += f" ({label})"
            out[key] = label
    return out


def _package(name):
    try:
        return importlib.import_module(name)
    except ImportError:
        raise MissingPackageError(
            f"this needs the package {name.removesuffix('modules')}, which is not there: "
            f"pip install {name.removesuffix('modules')}") from None


class Picture(bytes):
    """A PNG, which a notebook shows."""

    def _repr_png_(self):
        return bytes(self)


def _can_draw():
    """Returns whether vtk draws here.  Where it cannot, it ends the process, so another one tries."""
    attempt = ("import vtkmodules.vtkRenderingOpenGL2\n"
               "from vtkmodules.vtkRenderingCore import vtkRenderWindow\n"
               "window = vtkRenderWindow()\n"
               "window.SetOffScreenRendering(1)\n"
               "window.Render()\n")
    try:
        done = subprocess.run([sys.executable, "-c", attempt], stdin=subprocess.DEVNULL,
                              capture_output=True, timeout=60)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return done.returncode == 0


def _has_display():
    """Returns whether there is a screen to open a window on, by what the environment says."""
    return sys.platform != "linux" or bool(os.environ.get("DISPLAY"))


def _window(grid):
    """Returns an interactor of vtk that shows the grid when it is started."""
    importlib.import_module("vtkmodules.vtkInteractionStyle")
    importlib.import_module("vtkmodules.vtkRenderingOpenGL2")
    from vtkmodules.vtkRenderingCore import (vtkActor, vtkDataSetMapper, vtkRenderer,
                                             vtkRenderWindow, vtkRenderWindowInteractor)
    mapper = vtkDataSetMapper()
    mapper.SetInputData(grid)
    mapper.SetScalarRange(grid.GetCellData().GetScalars().GetRange())
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    renderer.SetBackground(1, 1, 1)
    window = vtkRenderWindow()
    window.SetSize(1000, 800)
    window.AddRenderer(renderer)
    interactor = vtkRenderWindowInteractor()
    interactor.SetRenderWindow(window)
    return interactor


class Verdict:
    """The result of a verification.  It is true when all checks hold."""

    def __init__(self, text):
        #: The keys of ``mwmesh verify --report`` without version, settings and performance.
        self.report = json.loads(text)
        self.passed = self.report["passed"]
        #: (name, passed, detail) of each check.
        self.checks = [(check["name"], check["passed"], check["detail"])
                       for check in self.report["checks"]]

    def __bool__(self):
        return self.passed

    def __repr__(self):
        rows = [f"{'ok  ' if passed else 'FAIL'}  {name}: {detail}"
                for name, passed, detail in self.checks]
        return "\n".join(rows)


class Mesh:
    """A conforming tetrahedral mesh with a label for each tet.

    >>> import mwmesh
    >>> mesh = mwmesh.mesh(mwmesh.synth("voronoi", (12, 10, 8), labels=3, seed=1))
    >>> mesh.points.shape[1], mesh.tets.shape[1], len(mesh.labels) == len(mesh.tets)
    (3, 4, True)
    >>> round(sum(mesh.volumes().values()), 6)
    960.0
    """

    def __init__(self, points, tets, labels, names=None):
        """Makes a mesh from arrays, which are copied: (n, 3) coordinates, (m, 4) rows of points
        with positive orientation, m labels."""
        points = numbers(points, "points", "rows of three numbers", (None, 3), (0,))
        points = points.reshape(-1, 3)
        tets, labels = whole_numbers(tets, "tets"), whole_numbers(labels, "labels")
        if tets.size and (tets.min() < 0 or tets.max() >= len(points)):
            raise UsageError(f"tets: rows of points are 0 to {len(points) - 1}")
        self._core = _handles.Mesh.of_arrays(points, tets, labels.view(np.uint64),
                                          labels.dtype.kind == "i")
        named(self._core, names)
        self._begin()

    @classmethod
    def _of(cls, core):
        mesh = cls.__new__(cls)
        mesh._core = core
        mesh._begin()
        return mesh

    def _begin(self):
        report = self._core.report
        #: The keys of ``mwmesh mesh --report``; None where there is none.  Its "settings" are those
        #: of :func:`settings` without preset, with threads, memory and workdir.
        self.report = json.loads(report) if report else None
        self._known = {}

    def __reduce__(self):
        rows = [tuple(row) for row in self._core.names]
        arrays = self.points, self.tets, self.labels
        run = self._core.record, self._core.in_parts
        return _restored, (*arrays, rows, *run, self.values), {"report": self.report}

    @property
    def points(self):
        """The (n, 3) world coordinates.  All arrays here are views of a mesh that cannot change."""
        return self._core.points

    @property
    def tets(self):
        """The (m, 4) rows of points of each tet; orientation is positive."""
        return self._core.tets

    @property
    def labels(self):
        """The m labels, int64 where the volume's are signed, else uint64."""
        return self._core.labels

    @property
    def values(self):
        """The m numbers of each image that was sampled, {name: float64}; NaN outside of it.  A mesh
        that was read has those of its file."""
        return self._core.values

    @property
    def wedges(self):
        """The (k, 6) rows of points of the wedges that mesh(cohesive=...) asked for: a triangle
        whose normal points to the other side, and the points above it in the same order, which lie
        where the triangle lies."""
        return self._cohesive()[0]

    @property
    def wedge_labels(self):
        """The (k, 2) labels under each wedge and on top of it."""
        return self._cohesive()[1]

    def _cohesive(self):
        if "wedges" not in self._known:
            rows, labels = self._core.column("wedges"), self._core.column("wedge_labels")
            self._known["wedges"] = rows.view(np.int64), labels
        return self._known["wedges"]

    def __repr__(self):
        return (f"<mwmesh.Mesh: {len(self.points)} points, {len(self.tets)} tets, "
                f"{len(self.label_list())} labels>")

    def __str__(self):
        """Returns what ``mwmesh mesh`` says of its mesh."""
        report = json.dumps(self.report).encode() if self.report else None
        return self._core.summary(report).rstrip("\n")

    @property
    def names(self):
        """The names of labels that have one: {label: name}."""
        kind = self.labels.dtype.type
        return {int(np.uint64(row.label).astype(kind)): row.name
                for row in self._core.names if row.name}

    @property
    def masks(self):
        """The masks that were meshed with overlap="all": {name: labels of the mask}."""
        return {mask["name"]: mask["labels"] for mask in self._record().get("masks", [])}

    def _record(self):
        return json.loads(self._core.record or "{}")

    def _mask_cells(self):
        """Returns {"mask_NAME": for each tet whether it is in the mask, 1 or 0}, as files have it:
        with "_" for "/", and behind a name that values or another mask have."""
        out = {}
        for mask, labels in self.masks.items():
            name = f"mask_{mask}".replace("/", "_")
            while name in out or name in self.values:
                name += "_"
            inside = np.isin(self.labels, np.array(labels, self.labels.dtype))
            out[name] = inside.astype(np.uint8)
        return out

    @property
    def digest(self):
        """A hash of the content, which does not depend on format, order of rows or machine."""
        return self._core.digest()

    def label_list(self):
        """Returns the labels that the mesh has, ascending."""
        return self._ranks()[0]

    def _ranks(self):
        if "ranks" not in self._known:
            self._known["ranks"] = np.unique(self.labels, return_inverse=True)
            self._known["ranks"][0].flags.writeable = False
        return self._known["ranks"]

    def tet_volumes(self):
        """Returns the volume of each tet."""
        a, b, c, d = (self.points[self.tets[:, i]] for i in range(4))
        return np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6

    def volumes(self):
        """Returns the volume of each label: {label: volume}."""
        labels, ranks = self._ranks()
        sums = np.bincount(ranks, weights=self.tet_volumes(), minlength=len(labels))
        return {int(label): float(v) for label, v in zip(labels, sums)}

    def materials(self, name, count, bounds=None):
        """Returns the :class:`Materials` of ``mwmesh mesh --materials``: `count` equal ranges of the
        values `name`, from the least to the largest or over bounds = (low, high), beyond which
        values are in the first or the last.

        >>> import mwmesh
        >>> mesh = mwmesh.mesh("labels.npy", sample={"hu": "ct.npy"})    # doctest: +SKIP
        >>> mesh.materials("hu", 50).means                               # doctest: +SKIP
        """
        if name not in self.values:
            raise UsageError(f"materials: tets have no values '{name}'")
        most = 10_000
        count = whole(count, "count")
        if not 1 <= count <= most:
            raise UsageError(f"materials: expected a count from 1 to {most}")
        values, volumes = self.values[name], self.tet_volumes()
        known = ~np.isnan(values)
        if bounds is None:
            bounds = (values[known].min(), values[known].max()) if known.any() else (0, 0)
            low, high = map(float, bounds)
        else:
            low, high = numbers(bounds, "bounds", "two finite numbers, the lower first", (2,)).tolist()
            if not -np.inf < low < high < np.inf:
                raise unexpected("bounds", "two finite numbers, the lower first", bounds)
        begins = low + (high - low) * (np.arange(count) / count)
        last = np.searchsorted(begins, values[known], side="right")
        rows = np.zeros(len(values), np.int32)
        rows[known] = np.clip(last, 1, count)
        tets = np.bincount(rows, minlength=count + 1)[1:]
        sums = np.bincount(rows, volumes, count + 1)[1:]
        weighted = np.bincount(rows, np.where(known, values, 0) * volumes, count + 1)[1:]
        means = np.full(count, np.nan)
        np.divide(weighted, sums, out=means, where=tets > 0)
        return Materials(rows, begins, np.append(begins[1:], high), means, tets, sums)

    def _facets(self):
        if "facets" in self._known:
            return self._known["facets"]
        ranks = self._ranks()[1].astype(np.int64)
        triangles = self.tets[:, _FACES].reshape(-1, 3)
        inside = np.repeat(ranks, 4)
        places = triangles
        if "doubled_vertices" in self._record():  # the two sides of an interface are apart
            places = np.unique(self.points, axis=0, return_inverse=True)[1].ravel()[triangles]
        keys = np.sort(places, axis=1)
        order = np.lexsort(keys.T[::-1])
        keys = keys[order]
        twin = np.flatnonzero((keys[1:] == keys[:-1]).all(axis=1))
        first, second = order[twin], order[twin + 1]
        alone = np.ones(len(order), dtype=bool)
        alone[twin] = alone[twin + 1] = False
        single = order[alone]
        differs = inside[first] != inside[second]
        first, second = first[differs], second[differs]
        # Each interface is told once, outside the smaller label.
        swap = inside[first] > inside[second]
        first, second = np.where(swap, second, first), np.where(swap, first, second)
        # Corners of the other side in the order of this one, backwards.
        match = places[second][:, None, :] == places[first][:, ::-1, None]
        others = np.take_along_axis(triangles[second], match.argmax(axis=2), axis=1)
        facets = _Facets(np.concatenate([triangles[first], triangles[single]]),
                         np.concatenate([others, triangles[single]]),
                         np.concatenate([inside[first], inside[single]]),
                         np.concatenate([inside[second], np.full(len(single), -1)]))
        self._known["facets"] = facets
        return facets

    def _rank(self, label):
        bits = np.uint64(label_bits(self._core, label, "label"))
        found = np.flatnonzero(self.label_list().view(np.uint64) == bits)
        if len(found) == 0:
            raise UsageError(f"label {label}: the mesh has none of it")
        return int(found[0])

    def facets(self, a, b):
        """Returns the triangles where labels a and b meet, (k, 3) rows of points of a,
        counterclockwise seen from b.  Where vertices were doubled b has others in the same places."""
        rank_a, rank_b = self._rank(a), self._rank(b)
        facets = self._facets()
        here = (facets.label == min(rank_a, rank_b)) & (facets.other == max(rank_a, rank_b))
        triangles = facets.triangles[here]
        return triangles if rank_a < rank_b else facets.others[here]

    def _box(self):
        """Returns the box of the volume: its origin and three edges."""
        box = self._record().get("box")
        if box is None:  # as of meshes of others: that of the points
            low = self.points.min(axis=0)
            box = {"origin": low, **dict(zip("xyz", np.diag(self.points.max(axis=0) - low)))}
        return box

    def _lie_on_box(self, triangles):
        """Returns for each triangle whether it lies on a side of the box of the volume."""
        box = self._box()
        on_side = np.zeros(len(triangles), dtype=bool)
        for axis in "xyz":
            edge = np.array(box[axis])
            share = (self.points[triangles] - box["origin"]) @ edge / (edge @ edge)
            for end in (0, 1):
                on_side |= (np.abs(share - end) <= 1e-9).all(axis=1)
        return on_side

    def surface(self, label, closed=True):
        """Returns the surface of a label; closed: with its facets on the sides of the box.

        >>> import mwmesh
        >>> mesh = mwmesh.mesh(mwmesh.synth("spheres", (20, 20, 20), labels=1, seed=1))
        >>> points, triangles = mesh.surface(1)
        >>> triangles.shape[1]
        3
        """
        rank = self._rank(label)
        facets = self._facets()
        out = facets.label == rank
        if not closed:
            out[out] &= ~self._lie_on_box(facets.triangles[out])
        back = facets.other == rank
        triangles = np.concatenate([facets.triangles[out], facets.others[back]])
        rows, corners = np.unique(triangles, return_inverse=True)
        return Surface(self.points[rows], corners.reshape(-1, 3))

    def contacts(self):
        """Returns the contact areas of the labels that touch: {(a, b): area} with a < b."""
        labels = self.label_list()
        facets = self._facets()
        touch = facets.other >= 0
        areas = _areas(self.points, facets.triangles[touch])
        pairs = facets.label[touch] * len(labels) + facets.other[touch]
        known, rows = np.unique(pairs, return_inverse=True)
        sums = np.bincount(rows, weights=areas, minlength=len(known))
        return {(int(labels[p // len(labels)]), int(labels[p % len(labels)])): float(s)
                for p, s in zip(known, sums)}

    @documented("write")
    def save(self, path, *, values=True, **options):
        """Writes a file of any format of ``mwmesh convert``, which appears under its name only once
        it is whole.  element: "tet4", "tet10" or "tet10-curved", which gives a mesh that was
        read from curved tets its nodes again.  values: False leaves out the values of tets, for which some
        formats have no place.  materials: "NAME=N" or "NAME=N:LO:HI" makes N sets of elements by
        ranges of a value, which a format with a place for values then has to have, too.  deck: with
        a job for CalculiX (.inp) or FEBio (.feb): "static" (or True) pulls the mesh, "periodic" and
        "conduction" are for :func:`mwmesh.homogenise`.  pairs: a file (.csv, or .inp with equations) for
        the nodes on the faces of a mesh that was made with ``periodic``, and those that they are
        images of.  ascii: a .msh as text.
        """
        check_names(options, arguments_of("write"))
        options.setdefault("write_values", switch(values, "values"))
        self._core.write(path_bytes(path, "path"), options_of(None, options))

    @documented("verify")
    def verify(self, volume, **arguments):
        """Checks the mesh against its volume.  The arguments are those of :func:`mwmesh.mesh` that
        say where the volume is and what its labels become, threads and memory.

        >>> import mwmesh
        >>> grains = mwmesh.synth("voronoi", (12, 10, 8), labels=3, seed=1)
        >>> bool(mwmesh.mesh(grains).verify(grains))
        True
        """
        check_names(arguments, arguments_of("verify"), (*PLACE, "names"))
        place = {name: arguments.pop(name) for name in PLACE if name in arguments}
        given = arguments.pop("names", self)
        volume = as_volume(volume, **place)
        volume = as_volume(volume, names=self._names_in(volume) if given is self else given)
        return Verdict(_handles.verify(self._core, volume, options_of(volume, arguments)))

    def _names_in(self, volume):
        """Returns the names of labels that a volume can have, as its labels are signed or not."""
        limit = np.iinfo(np.int64).max
        return {label: name for label, name in self.names.items()
                if (label <= limit if volume.labels_are_signed else label >= 0)}

    def _inner(self):
        """Returns the ranks of all labels except the one that has two thirds of the box's sides."""
        facets = self._facets()
        box = facets.other < 0
        box[box] = self._lie_on_box(facets.triangles[box])
        sums = np.bincount(facets.label[box], _areas(self.points, facets.triangles[box]),
                           len(self.label_list()))
        x, y, z = (np.array(self._box()[axis], float) for axis in "xyz")
        sides = 2 * sum(np.linalg.norm(np.cross(a, b)) for a, b in ((x, y), (y, z), (z, x)))
        inner = 3 * sums <= 2 * sides
        return np.flatnonzero(inner if inner.any() else ~inner)

    def plot(self, labels=None, **arguments):
        """Shows these labels (a list, or one) in a window, by default all except the one around
        them.  Uses pyvista if it is installed, whose plot() takes the arguments, else vtk.  With
        off_screen=True, and where no window can be opened, as without a display, it returns a
        :class:`Picture`: the bytes of a PNG, which a notebook shows."""
        ranks = self._inner() if labels is None else [self._rank(label) for label in one_or_more(labels)]
        seen = np.isin(self._ranks()[1], ranks)
        shown = Mesh(self.points, self.tets[seen], self.labels[seen], self.names)
        grid = shown.to_vtk()
        try:
            import pyvista
        except ImportError:
            pyvista = None
        is_off_screen = pyvista is None and arguments.get("off_screen")
        if is_off_screen or not ((pyvista or _has_display()) and _can_draw()):
            if not is_off_screen:
                warnings.warn("plot: no window can be opened here; this returns a picture (PNG)",
                              RuntimeWarning, stacklevel=2)
            return shown.picture(1000, 800)
        if pyvista is None:
            return _window(grid).Start()
        return pyvista.wrap(grid).plot(**{"scalars": "label", **arguments})

    def picture(self, width=1200, height=900):
        """Returns the :class:`Picture` (PNG) that ``mwmesh picture`` draws."""
        return Picture(self._core.picture(whole(width, "width", 32), whole(height, "height", 32)))

    def _repr_png_(self):
        """Returns the picture that a notebook shows, unless it would take long."""
        most = 2_000_000
        return self.picture(800, 600) if 0 < len(self.tets) <= most else None

    def _repr_html_(self):
        """Returns the picture and what print() says, which a notebook shows."""
        png = self._repr_png_()
        picture = f"<img src='data:image/png;base64,{base64.b64encode(png).decode()}'>" if png else ""
        return f"{picture}<pre>{html.escape(str(self))}</pre>"

    def _wedge_cells(self):
        """Returns the rows of wedges, the tet under each, and its interface's number from 1 on."""
        if "cohesive" not in self._record():
            return np.empty((0, 6), np.int64), np.empty(0, np.int64), np.empty(0, np.int64)
        rows, sides = self.wedges, self.wedge_labels
        tets = np.flatnonzero(np.isin(self.tets, rows).sum(axis=1) >= 3)
        facets = np.sort(self.tets[tets][:, _FACES], axis=2)
        all_facets = np.concatenate([facets.reshape(-1, 3), np.sort(rows[:, :3], axis=1)])
        place = np.unique(all_facets, axis=0, return_inverse=True)[1].ravel()
        tet_of = np.empty(place.max(initial=-1) + 1, np.int64)
        tet_of[place[:4 * len(tets)]] = np.repeat(tets, 4)
        begins = np.any(sides[1:] != sides[:-1], axis=1)
        numbers = np.cumsum(np.concatenate([[1], begins]))[:len(rows)]
        return rows, tet_of[place[4 * len(tets):]], numbers

    def to_meshio(self):
        """Returns a meshio.Mesh of the tets with cell data "label"; names are field data
        {name: [label, 3]}, where a name that several labels have becomes "name (label)".  Wedges
        come behind the tets, with cell data "cohesive": the number of their interface, which is 0
        for tets.  Their label and values are those of the tet under them.  Each of
        :attr:`masks` is cell data "mask_NAME", which is 1 for its tets and 0 for others."""
        meshio = _package("meshio")
        rows, under, numbers = self._wedge_cells()
        cells = [("tetra", self.tets)]
        columns = {"label": self.labels} | self.values | self._mask_cells()
        data = {name: [row] for name, row in columns.items()}
        if len(rows) > 0:
            cells.append(("wedge", rows))
            data = {name: [row, row[under]] for name, (row,) in data.items()}
            data["cohesive"] = [np.zeros(len(self.tets), np.int64), numbers]
        return meshio.Mesh(self.points, cells, cell_data=data,
                           field_data={name: np.array([label, 3], self.labels.dtype)
                                       for name, label in _distinct(self.names).items()})

    def to_vtk(self):
        """Returns a vtkUnstructuredGrid of the tets with the cell array "label".  Wedges come behind
        the tets as in files, with the cell array "cohesive": the number of their interface, which
        is 0 for tets.  Names and colours are the field arrays "label_id", "label_name" and
        "label_colour", with a row for each label.  Each of :attr:`masks` is a cell array
        "mask_NAME", which is 1 for its tets and 0 for others."""
        _package("vtkmodules")
        from vtkmodules.util import numpy_support
        from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
        from vtkmodules.vtkCommonDataModel import (VTK_TETRA, VTK_WEDGE, vtkCellArray,
                                                   vtkUnstructuredGrid)
        points = vtkPoints()
        points.SetData(numpy_support.numpy_to_vtk(self.points, deep=True))
        rows, under, numbers = self._wedge_cells()
        corners = np.repeat([4, 6], [len(self.tets), len(rows)])
        # VTK has the normal of a wedge's first triangle point out of it.
        nodes = np.concatenate([self.tets.ravel(), rows[:, [0, 2, 1, 3, 5, 4]].ravel()])
        cells = vtkCellArray()
        cells.SetData(
            numpy_support.numpy_to_vtkIdTypeArray(
                np.concatenate([[0], np.cumsum(corners)]).astype(np.int64), deep=True),
            numpy_support.numpy_to_vtkIdTypeArray(nodes, deep=True))
        grid = vtkUnstructuredGrid()
        grid.SetPoints(points)
        kinds = np.where(corners == 4, VTK_TETRA, VTK_WEDGE).astype(np.uint8)
        grid.SetCells(numpy_support.numpy_to_vtk(kinds, deep=True), cells)
        data = {"label": self.labels} | self.values | self._mask_cells()
        data = {name: np.concatenate([row, row[under]]) for name, row in data.items()}
        if len(rows) > 0:
            data["cohesive"] = np.concatenate([np.zeros(len(self.tets), np.int64), numbers])
        for name, row in data.items():
            array = numpy_support.numpy_to_vtk(row, deep=True)
            array.SetName(name)
            grid.GetCellData().AddArray(array)
        grid.GetCellData().SetActiveScalars("label")
        rows = self._core.names
        if not rows:
            return grid
        ids = np.array([row.label for row in rows], np.uint64).view(self.labels.dtype)
        names = vtkStringArray()
        for row in rows:
            names.InsertNextValue(row.name)
        colours = np.array([row.colour or (0, 0, 0, 0) for row in rows], np.uint8)
        for key, array in (("label_id", numpy_support.numpy_to_vtk(ids, deep=True)),
                           ("label_name", names),
                           ("label_colour", numpy_support.numpy_to_vtk(colours, deep=True))):
            array.SetName(key)
            grid.GetFieldData().AddArray(array)
        return grid

    def to_pyvista(self):
        """Returns a pyvista.UnstructuredGrid with the cell data "label"."""
        return _package("pyvista").wrap(self.to_vtk())
