#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Wedges between the two sides of an interface, as other tools read them and as solvers use them."""
import itertools
import json
import pathlib
import shutil
import sys
import unittest

from program import enter_folder, pull, refused, run, start

try:
    import numpy as np
    from netCDF4 import Dataset
    from scipy.sparse import coo_matrix
    from scipy.sparse.linalg import spsolve
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkPolygon
    from vtkmodules.vtkIOExodus import vtkExodusIIReader
    from vtkmodules.vtkIOHDF import vtkHDFReader
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

VTK_ORDER = {13: [0, 2, 1, 3, 5, 4], 31: [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9]}


def report(path):
    return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))


def grid_of(path):
    """The file as VTK reads it."""
    reader = {".vtu": vtkXMLUnstructuredGridReader, ".vtkhdf": vtkHDFReader,
              ".exo": vtkExodusIIReader}[pathlib.Path(path).suffix]()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def cells_of(grid):
    """Returns (types, nodes of each cell)."""
    ids = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    ends = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    return (vtk_to_numpy(grid.GetCellTypesArray()),
            [ids[a:b] for a, b in zip(ends[:-1], ends[1:])])


def vtk_mesh(path):
    """Returns points, {label: tets}, wedges from bottom to top, and their labels {interface: (n, 2)}."""
    grid = grid_of(path)
    types, nodes = cells_of(grid)
    data = grid.GetCellData()
    labels, cohesive = (vtk_to_numpy(data.GetArray(n)) for n in ("label", "cohesive"))
    pairs = vtk_to_numpy(grid.GetFieldData().GetArray("cohesive_labels"))
    is_tet = np.isin(types, (10, 24))
    np.testing.assert_array_equal(cohesive == 0, is_tet)
    np.testing.assert_array_equal(labels[~is_tet], pairs[cohesive[~is_tet] - 1, 0])
    tets = {int(label): np.array([nodes[i] for i in np.flatnonzero(is_tet & (labels == label))])
            for label in np.unique(labels)}
    wedges = np.array([nodes[i][VTK_ORDER[types[i]]] for i in np.flatnonzero(~is_tet)])
    return vtk_to_numpy(grid.GetPoints().GetData()), tets, wedges, pairs[cohesive[~is_tet] - 1]


def inp_mesh(path):
    """Returns nodes, elements {set: (type, rows of nodes)}; numbers of nodes are rows here."""
    nodes, elements = [], {}
    take = None
    for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
        items = [item.strip() for item in line.split(",")]
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            values = dict(item.split("=") for item in items[1:] if "=" in item)
            take = None
            if items[0] == "*NODE":
                take = lambda row: nodes.append([float(x) for x in row[1:]])
            elif items[0] == "*ELEMENT":
                rows = elements.setdefault(values["ELSET"], (values["TYPE"], []))[1]
                take = lambda row, rows=rows: rows.append([int(n) - 1 for n in row[1:]])
        elif take:
            take(items)
    return np.array(nodes), {name: (kind, np.array(rows)) for name, (kind, rows) in elements.items()}


def exodus_blocks(path):
    """Returns {name: (type, rows of nodes)}, and {name: id}."""
    with Dataset(path) as file:
        names = ["".join(c.decode() for c in row if c) for row in
                 np.ma.filled(file["eb_names"][:], b"")]
        blocks = {name: (file[f"connect{i}"].elem_type, file[f"connect{i}"][:].data - 1)
                  for i, name in enumerate(names, 1)}
        return blocks, dict(zip(names, file["eb_prop1"][:].tolist()))


class Formats(unittest.TestCase):
    """Three grains: wedges go from `left` to 2; label 3 lies across both and holds their rim."""

    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        v = np.ones((8, 8, 12), np.uint8)  # [z, y, x]
        v[:, :, 6:] = 2
        v[5:, :, :] = 3
        np.save("three.npy", v)
        pathlib.Path("names.csv").write_text("id,name\n1,left\n", encoding="utf-8")
        np.save("ct.npy", np.arange(v.size, dtype=np.float32).reshape(v.shape))
        for name in ("m.vtu", "m.vtkhdf", "m.msh", "m.msh2", "m.inp", "m.exo"):
            cls.write(name)
        cls.points, cls.tets, cls.wedges, cls.labels = vtk_mesh("m.vtu")

    @staticmethod
    def write(name, *more):
        values = () if name == "m.inp" else ("--sample", "hu=ct.npy")
        return run("mesh", "three.npy", "-o", name, "--names", "names.csv", "--cohesive", "left|2",
                   "--spacing", "1,2,1", "--size", "2.5", "--report", "r.json", *values, *more)

    def test_there_is_one_for_each_triangle_that_opens(self):
        """Both triangles are facets of one tet each, and lie at one place."""
        self.write("again.vtu")
        told = report("r.json")["parts"]["doubled"]
        self.assertEqual(told["wedges"], len(self.wedges))
        self.assertEqual(told["facets_without_wedge"], 0)
        self.assertIn(f"{len(self.wedges)} cohesive wedges", self.write("again.vtu"))
        np.testing.assert_array_equal(self.labels, [[1, 2]] * len(self.wedges))
        facets = {label: [frozenset(np.delete(t, i)) for t in tets for i in range(4)]
                  for label, tets in self.tets.items()}
        places = {label: {frozenset(map(tuple, self.points[list(f)])) for f in facets[label]}
                  for label in (1, 2)}
        self.assertEqual(len(places[1] & places[2]), len(self.wedges))
        for label, side in ((1, self.wedges[:, :3]), (2, self.wedges[:, 3:])):
            for triangle in side:
                self.assertEqual(facets[label].count(frozenset(triangle)), 1)
        np.testing.assert_array_equal(self.points[self.wedges[:, :3]], self.points[self.wedges[:, 3:]])
        a, b, c = (self.points[self.wedges[:, i]] for i in range(3))
        self.assertTrue((np.cross(b - a, c - a)[:, 0] > 0).all(), "from label 1 to label 2")
        shared = (self.wedges[:, :3] == self.wedges[:, 3:]).sum(axis=1)
        self.assertEqual(set(shared), {0, 1, 2}, "on the rim, which label 3 holds together")

    def test_vtk_sees_their_faces_from_outside(self):
        """The grain 2 is moved off, so that wedges get a thickness."""
        for name, options in (("m.vtu", ()), ("m.vtkhdf", ()), ("q.vtu", ("--element", "tet10"))):
            if options:
                self.write(name, *options)
            grid, (points, tets, wedges, _) = grid_of(name), vtk_mesh(name)
            moved = np.setdiff1d(tets[2], np.concatenate([tets[1].ravel(), tets[3].ravel()]))
            for row in moved:
                grid.GetPoints().SetPoint(row, points[row] + (0.25, 0, 0))
            types, _ = cells_of(grid)
            looked_at = 0
            for cell in np.flatnonzero(np.isin(types, (13, 31))):
                wedge = grid.GetCell(int(cell))
                corners = [wedge.GetPointId(i) for i in range(6)]
                if len(set(corners)) < 6:
                    continue
                looked_at += 1
                at = np.array([wedge.GetPoints().GetPoint(i) for i in range(6)])
                for f in range(5):
                    face = wedge.GetFace(f)
                    count = face.GetNumberOfEdges()
                    ends = np.array([face.GetPoints().GetPoint(i) for i in range(count)])
                    normal = np.cross(ends[1] - ends[0], ends[2] - ends[0])
                    self.assertGreater(normal @ (ends.mean(axis=0) - at.mean(axis=0)), 0, (name, f))
            self.assertGreater(looked_at, 10)

    def test_middles_of_edges_are_those_of_the_tets(self):
        for name in ("q.vtu", "q.vtkhdf"):
            self.write(name, "--element", "tet10")
            points, tets, wedges, _ = vtk_mesh(name)
            self.assertEqual(wedges.shape[1], 12)
            self.assertTrue(np.isin(wedges[:, 6:9], tets[1][:, 4:]).all())
            self.assertTrue(np.isin(wedges[:, 9:], tets[2][:, 4:]).all())
            for side, middles in ((wedges[:, :3], wedges[:, 6:9]), (wedges[:, 3:6], wedges[:, 9:])):
                np.testing.assert_allclose(points[middles], (points[side] + points[
                    np.roll(side, -1, axis=1)]) / 2, atol=1e-12)
            np.testing.assert_array_equal(wedges, vtk_mesh("q.vtu")[2])

    def test_every_format_has_the_same_wedges(self):
        np.testing.assert_array_equal(vtk_mesh("m.vtkhdf")[2], self.wedges)
        _, elements = inp_mesh("m.inp")
        kind, rows = elements["COHESIVE_left_2"]
        self.assertEqual(kind, "COH3D6")
        np.testing.assert_array_equal(rows, self.wedges)
        blocks, ids = exodus_blocks("m.exo")
        self.assertEqual(blocks["COHESIVE_left_2"][0], "WEDGE")
        np.testing.assert_array_equal(blocks["COHESIVE_left_2"][1], self.wedges)
        self.assertEqual(len(set(ids.values())), 4)
        of_vtk = grid_of("m.exo").GetBlock(0).GetBlock(3)
        self.assertEqual(set(cells_of(of_vtk)[0]), {13})
        for cell, corners in enumerate(self.wedges):
            found = [of_vtk.GetPoint(n) for n in cells_of(of_vtk)[1][cell]]
            np.testing.assert_array_equal(found, self.points[corners])
        self.assertGreater(ids["COHESIVE_left_2"], 3)

    def test_gmsh_reads_prisms_in_a_volume_of_their_own(self):
        try:
            import gmsh
        except ImportError:
            self.skipTest("no gmsh")
        for name in ("m.msh", "m.msh2", "text.msh"):
            if name == "text.msh":
                self.write(name, "--ascii")
            gmsh.initialize()
            gmsh.option.setNumber("General.Terminal", 0)
            try:
                gmsh.open(name)
                elements, nodes = gmsh.model.mesh.getElementsByType(6)
                np.testing.assert_array_equal(nodes.reshape(-1, 6) - 1, self.wedges)
                groups = {gmsh.model.getPhysicalName(d, t): (d, t)
                          for d, t in gmsh.model.getPhysicalGroups()}
                dimension, tag = groups["COHESIVE_left_2"]
                self.assertEqual(dimension, 3)
                self.assertEqual(len({t for _, t in groups.values()}), len(groups))
                (entity,) = gmsh.model.getEntitiesForPhysicalGroup(3, tag)
                _, tags, _ = gmsh.model.mesh.getElements(3, entity)
                self.assertEqual(set(tags[0]), set(elements))
                # Grain 2 is moved off: volumes are positive.
                own = np.setdiff1d(self.tets[2], np.concatenate([self.tets[1], self.tets[3]]))
                for row in own:
                    gmsh.model.mesh.setNode(row + 1, self.points[row] + (0.25, 0, 0), [])
                whole = np.array([len(set(w)) == 6 for w in self.wedges])
                _, determinants, _ = gmsh.model.mesh.getJacobians(6, [1 / 3, 1 / 3, 0], entity)
                self.assertGreater(np.array(determinants)[whole].min(), 0)
                self.assertGreater(whole.sum(), 10)
            finally:
                gmsh.finalize()

    def test_values_are_those_of_the_tet_under_them(self):
        grid = grid_of("m.vtu")
        types, nodes = cells_of(grid)
        values = vtk_to_numpy(grid.GetCellData().GetArray("hu"))
        labels = vtk_to_numpy(grid.GetCellData().GetArray("label"))
        under = {frozenset(np.delete(t, i)): value for t, value, kind, label in
                 zip(nodes, values, types, labels) if kind == 10 and label == 1 for i in range(4)}
        for wedge, value, kind in zip(nodes, values, types):
            if kind == 13:
                self.assertEqual(value, under[frozenset(wedge[:3])])
        with Dataset("m.exo") as file:
            np.testing.assert_array_equal(file["vals_elem_var1eb4"][0], values[types == 13])

    def test_the_mesh_is_read_as_ever(self):
        run("mesh", "three.npy", "-o", "s.vtu", "--names", "names.csv", "--split", "1|2",
            "--spacing", "1,2,1", "--size", "2.5")
        for name in ("m.vtu", "m.vtkhdf", "m.msh", "m.msh2"):
            self.assertEqual(run("digest", name), run("digest", "s.vtu"))
            self.assertIn("all checks hold", run("verify", "three.npy", name, "--spacing", "1,2,1"))
            one, other = (json.loads(run("info", n, "--json", "--contacts")) for n in (name, "s.vtu"))
            self.assertEqual(one["cohesive"], [[1, 2]])
            self.assertNotIn("cohesive", other)
            for key in ("contacts", "doubled_vertices", "tets", "parts", "volume"):
                self.assertEqual(one[key], other[key])

    def test_convert_keeps_them(self):
        for source in ("m.vtu", "m.vtkhdf", "m.msh", "m.msh2"):
            run("convert", source, "c.vtu")
            points, _, wedges, labels = vtk_mesh("c.vtu")
            np.testing.assert_array_equal(points, self.points)
            np.testing.assert_array_equal(wedges, self.wedges)
            np.testing.assert_array_equal(labels, self.labels)
            run("convert", source, "c.inp")
            self.assertEqual(pathlib.Path("c.inp").read_bytes().split(b"*NODE")[1],
                             pathlib.Path("m.inp").read_bytes().split(b"*NODE")[1])

    def test_formats_without_a_place_for_them_refuse(self):
        for name, more in itertools.chain(
                ((f"no.{e}", ()) for e in ("mesh", "bdf", "feb", "xdmf")),
                ((f"no.{e}", ("--element", "tet10")) for e in ("msh", "msh2", "inp", "exo"))):
            done = start("mesh", "three.npy", "-o", name, "--cohesive", "1|2", *more)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("no place for cohesive wedges", done.stderr)
            self.assertIn(".vtkhdf, .vtu have" if more else ".vtkhdf, .vtu, .msh, .msh2, .exo, .inp",
                          done.stderr)
            refused(["no place for cohesive wedges"], "convert", "m.vtu", name, *more, code=2)
            self.assertFalse(pathlib.Path(name).exists())
        done = start("convert", "m.vtu", "no.pvtu", "--pieces", "2")
        self.assertEqual(done.returncode, 2, done.stderr)

    def test_pairs_that_make_no_sense_are_refused(self):
        for value, what in (("1|77", "no label 77"), ("1", "pairs"), ("1|2,2|1", "twice")):
            refused([what], "mesh", "three.npy", "-o", "no.vtu", "--cohesive", value, code=2)

    def test_the_order_of_a_pair_is_that_of_the_wedges(self):
        run("mesh", "three.npy", "-o", "r.vtu", "--cohesive", "2|1,3|1", "--spacing", "1,2,1")
        points, tets, wedges, labels = vtk_mesh("r.vtu")
        self.assertEqual(set(map(tuple, labels)), {(2, 1), (3, 1)})
        a, b, c = (points[wedges[:, i]] for i in range(3))
        normals = np.cross(b - a, c - a)
        self.assertTrue((normals[labels[:, 0] == 2][:, 0] < 0).all())
        self.assertTrue((normals[labels[:, 0] == 3][:, 2] < 0).all())
        for label in (1, 2, 3):
            self.assertTrue(np.isin(wedges[labels[:, 0] == label][:, :3], tets[label]).all())
            self.assertTrue(np.isin(wedges[labels[:, 1] == label][:, 3:], tets[label]).all())

    def test_the_same_bytes_for_any_threads_and_memory(self):
        for name in ("t.vtu", "t.vtkhdf", "t.msh", "t.exo"):
            seen = set()
            for more in (("--threads", 1), ("--threads", 3), ("--memory", "160MiB")):
                run("mesh", "three.npy", "-o", name, "--cohesive", "*", *more)
                seen.add(pathlib.Path(name).read_bytes())
            self.assertEqual(len(seen), 1)


# A bar of two grains along x, pulled at its end.  With a Poisson's ratio of 0 it is a row of springs:
# the two halves, and the interface between them.
LENGTH, SIDE, YOUNG, SHEAR = 12.0, 5.0, 1000.0, 500.0


def bar():
    v = np.ones((5, 5, 12), np.uint8)
    v[:, :, 6:] = 2
    np.save("two.npy", v)


def stress_of(stretch, stiffness):
    return stretch / (LENGTH / YOUNG + 1 / stiffness)


def tet_stiffness(corners):
    gradients = np.linalg.inv(np.hstack([np.ones((4, 1)), corners]))[1:].T
    volume = abs(np.linalg.det(corners[1:] - corners[0])) / 6
    strain = np.zeros((6, 12))
    for i, (x, y, z) in enumerate(gradients):
        strain[:, 3 * i:3 * i + 3] = [[x, 0, 0], [0, y, 0], [0, 0, z], [y, x, 0], [0, z, y], [z, 0, x]]
    return volume * strain.T @ np.diag([YOUNG] * 3 + [SHEAR] * 3) @ strain


def wedge_stiffness(corners, opening, stiffness, closed):
    """Springs of the three pairs of corners, which carry a third of the area each.  Along the normal
    of the bottom they are soft when they open, and stiffer when they close."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    area = np.linalg.norm(normal) / 2
    normal /= 2 * area
    out = np.zeros((18, 18))
    for i in range(3):
        along = stiffness if opening[i] @ normal >= 0 else closed
        spring = area / 3 * (stiffness * np.eye(3) + (along - stiffness) * np.outer(normal, normal))
        low, high = slice(3 * i, 3 * i + 3), slice(9 + 3 * i, 12 + 3 * i)
        out[low, low] += spring
        out[high, high] += spring
        out[low, high] -= spring
        out[high, low] -= spring
    return out


def assembled(elements, matrices, nodes):
    rows = np.concatenate([np.repeat((3 * e[:, None] + np.arange(3)).ravel(), 3 * len(e))
                           for e in elements])
    columns = np.concatenate([np.tile((3 * e[:, None] + np.arange(3)).ravel(), 3 * len(e))
                              for e in elements])
    return coo_matrix((np.concatenate([m.ravel() for m in matrices]), (rows, columns)),
                      shape=(3 * nodes, 3 * nodes)).tocsr()


class Pull(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        bar()

    def force(self, stretch, stiffness, closed, pair):
        """Returns the force on the end that is moved, by a solver of a few lines."""
        run("mesh", "two.npy", "-o", "bar.inp", "--cohesive", pair)
        points, elements = inp_mesh("bar.inp")
        tets = np.concatenate([rows for kind, rows in elements.values() if kind == "C3D4"])
        (wedges,) = (rows for kind, rows in elements.values() if kind == "COH3D6")
        solid = [tet_stiffness(points[t]) for t in tets]
        held, moved = points[:, 0] == 0, points[:, 0] == LENGTH
        fixed = np.repeat(held | moved, 3)
        given = np.zeros(3 * len(points))
        given[::3][moved] = stretch
        opening = np.zeros((len(wedges), 3, 3))
        for _ in range(3):
            springs = [wedge_stiffness(points[w[:3]], o, stiffness, closed)
                       for w, o in zip(wedges, opening)]
            matrix = assembled([*tets, *wedges], [*solid, *springs], len(points))
            found = given.copy()
            found[~fixed] = spsolve(matrix[~fixed][:, ~fixed], -(matrix @ given)[~fixed])
            at = found.reshape(-1, 3)
            opening = at[wedges[:, 3:]] - at[wedges[:, :3]]
        return (matrix @ found)[::3][moved].sum()

    def test_the_interface_is_a_spring_in_a_row(self):
        """Pulled it is soft and pushed it is stiff, so the normal goes the right way."""
        for pair in ("1|2", "2|1"):
            for stretch in (0.1, -0.1):
                found = self.force(stretch, 200.0, 5000.0, pair)
                expected = SIDE**2 * stress_of(stretch, 200.0 if stretch > 0 else 5000.0)
                self.assertAlmostEqual(found / expected, 1, delta=1e-9)

    @unittest.skipUnless(shutil.which("ccx"), "no CalculiX")
    def test_calculix_pulls_the_springs_of_wedges(self):
        """It has no cohesive elements: each pair of corners becomes three springs."""
        run("mesh", "two.npy", "-o", "bar.inp", "--cohesive", "1|2")
        points, elements = inp_mesh("bar.inp")
        (wedges,) = (rows for kind, rows in elements.values() if kind == "COH3D6")
        areas = {}
        for w in wedges:
            a, b, c = points[w[:3]]
            for pair in zip(w[:3], w[3:]):
                areas[pair] = areas.get(pair, 0) + np.linalg.norm(np.cross(b - a, c - a)) / 6
        self.assertAlmostEqual(sum(areas.values()), SIDE**2, delta=1e-9)
        stiffness, number = 200.0, 10**6
        lines = []
        for (a, b), area in areas.items():
            for axis in (1, 2, 3):
                number += 1
                lines.append(f"*ELEMENT, TYPE=SPRING2, ELSET=S{number}\n{number}, {a + 1}, {b + 1}\n"
                             f"*SPRING, ELSET=S{number}\n{axis}, {axis}\n{stiffness * area:.17g}\n")
        text = pathlib.Path("bar.inp").read_text(encoding="utf-8")
        begin = text.index("*ELEMENT, TYPE=COH3D6")
        end = text.index("\n*", begin)
        pathlib.Path("solid.inp").write_text(text[:begin] + text[end + 1:], encoding="utf-8")
        found = pull("solid", "".join(lines), 0., "X_MAX")[0]
        self.assertAlmostEqual(found / (SIDE**2 * stress_of(0.1, stiffness)), 1, delta=1e-4)

    @unittest.skipUnless(shutil.which("ccx"), "no CalculiX")
    def test_calculix_has_tied_contact_in_their_place(self):
        """As engine/MANUAL.md tells its users."""
        run("mesh", "two.npy", "-o", "split.inp", "--split", "1|2")
        stiffness = 200.0
        found = pull("split", (
            "*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n"
            f"{stiffness}\n*FRICTION\n0.3, {stiffness}\n"
            "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE\nFACE_2_1, FACE_1_2\n"), 0., "X_MAX")[0]
        self.assertAlmostEqual(found / (SIDE**2 * stress_of(0.1, stiffness)), 1, delta=1e-3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
