#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Curved tets: a ball that is round, Jacobians by many points, a broken one, other formats."""
import pathlib
import sys
import unittest

from program import enter_folder, refused, run, start

try:
    from reading_meshio import meshio
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))  # where nodes 4 to 9 are
RADIUS, EDGE = 14, 40
CENTRE = np.array([20.3, 19.8, 20.1])


def ball():
    z, y, x = np.indices((EDGE,) * 3) + 0.5
    return (((np.stack([x, y, z], -1) - CENTRE)**2).sum(-1) < RADIUS**2).astype(np.uint8)


class Mesh:
    def __init__(self, path):
        mesh = meshio.read(path)
        self.points = mesh.points
        self.tets = mesh.cells_dict["tetra10"]
        self.labels = mesh.cell_data["label"][0].ravel()

    def interface(self):
        """Rows of the nodes at which labels 0 and 1 meet, and the triangles of six nodes out of 1."""
        faces = {}
        for tet, label in zip(self.tets, self.labels):
            for corners in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)):
                middles = [4 + e for i in range(3) for e, ends in enumerate(EDGES)
                           if set(ends) == {corners[i], corners[(i + 1) % 3]}]
                rows = tet[[*corners, *middles]]
                faces.setdefault(tuple(sorted(rows[:3])), {})[label] = rows
        rows = np.array([sides[1] for sides in faces.values() if len(sides) == 2 and 1 in sides and 0 in sides])
        return np.unique(rows), rows

    def jacobians(self, steps=5):
        """The least one of each tet at the points whose coordinates are multiples of 1 / steps."""
        least = np.full(len(self.tets), np.inf)
        nodes = self.points[self.tets]
        for i in range(steps + 1):
            for j in range(steps + 1 - i):
                for k in range(steps + 1 - i - j):
                    at = np.array([steps - i - j - k, i, j, k]) / steps
                    slopes = np.zeros((10, 4))
                    slopes[range(4), range(4)] = 4 * at - 1
                    for e, (a, b) in enumerate(EDGES):
                        slopes[4 + e, a], slopes[4 + e, b] = 4 * at[b], 4 * at[a]
                    towards = np.einsum("tnx,nk->tkx", nodes, slopes[:, 1:] - slopes[:, :1])
                    least = np.minimum(least, np.linalg.det(towards))
        return least

    def volume_inside(self, steps=24):
        """Of label 1, by flat triangles."""
        _, triangles = self.interface()
        t = self.points[triangles] - CENTRE

        def on(i, j):
            u, v = i / steps, j / steps
            w = 1 - u - v
            f = [w * (2 * w - 1), u * (2 * u - 1), v * (2 * v - 1), 4 * w * u, 4 * u * v, 4 * v * w]
            return np.einsum("n,tnx->tx", f, t)
        total = 0
        for i in range(steps):
            for j in range(steps - i):
                total += np.einsum("tx,tx", on(i, j), np.cross(on(i + 1, j), on(i, j + 1)))
                if i + j + 1 < steps:
                    total += np.einsum("tx,tx", on(i + 1, j), np.cross(on(i + 1, j + 1), on(i, j + 1)))
        return total / 6


class Ball(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        np.save("v.npy", ball())
        run("mesh", "v.npy", "-o", "m.vtkhdf")
        run("convert", "m.vtkhdf", "straight.vtu", "--element", "tet10")
        run("mesh", "v.npy", "-o", "c.vtu", "--element", "tet10-curved")
        cls.straight, cls.curved = Mesh("straight.vtu"), Mesh("c.vtu")

    def test_is_round(self):
        """Corners and middles lie on one sphere; those of straight tets lie on two."""
        rows, _ = self.curved.interface()
        voxels = np.load("v.npy").sum()
        radius = (voxels * 3 / 4 / np.pi)**(1 / 3)
        def off(mesh):
            return np.linalg.norm(mesh.points[rows] - CENTRE, axis=1) - radius
        self.assertGreater(np.sqrt((off(self.straight)**2).mean()), 0.2)
        self.assertLess(np.sqrt((off(self.curved)**2).mean()), 0.08)
        self.assertLess(abs(self.curved.volume_inside() / voxels - 1), 2e-3)

    def test_jacobians_are_positive(self):
        straight, curved = self.straight.jacobians(1), self.curved.jacobians()
        self.assertGreater((curved / straight).min(), 0.1)
        self.assertLess((curved / straight).min(), 0.9)  # some are curved

    def test_verify_looks_at_curves(self):
        said = run("verify", "v.npy", "c.vtu", "--max-distance", 1.5, "--max-volume-error", 0.005)
        self.assertIn("ok    P2 Jacobians", said)
        self.assertIn(f"positive everywhere of {len(self.curved.tets)}", said)
        self.assertIn("no distance bound, radius ratio 0.1, no volumes", run("verify", "v.npy", "c.vtu"))

    def test_verify_finds_a_tet_that_is_turned_over(self):
        try:
            import h5py
        except ImportError as missing:
            self.skipTest(str(missing))
        run("mesh", "v.npy", "-o", "bad.vtkhdf", "--element", "tet10-curved")
        run("verify", "v.npy", "bad.vtkhdf")
        with h5py.File("bad.vtkhdf", "r+") as file:
            nodes = file["VTKHDF/Connectivity"][:10]
            points = file["VTKHDF/Points"]
            points[nodes[4]] = 0.75 * points[nodes[4]] + 0.25 * points[nodes[2]] + \
                4 * (points[nodes[2]] - points[nodes[4]])
        self.assertIn("FAIL  P2 Jacobians", run("verify", "v.npy", "bad.vtkhdf", code=5))

    def test_is_the_same_however_it_is_made(self):
        run("convert", "m.vtkhdf", "again.vtu", "--element", "tet10-curved")
        run("mesh", "v.npy", "-o", "one.vtu", "--element", "tet10-curved", "--threads", 1)
        expected = pathlib.Path("c.vtu").read_bytes()
        for name in ("again.vtu", "one.vtu"):
            self.assertEqual(pathlib.Path(name).read_bytes(), expected)

    def test_other_formats_have_the_same_nodes(self):
        run("convert", "m.vtkhdf", "c.msh", "--element", "tet10-curved")
        mesh = meshio.read("c.msh")
        self.assertEqual(len(mesh.points), len(self.curved.points))
        np.testing.assert_allclose(np.sort(mesh.points, axis=0), np.sort(self.curved.points, axis=0), atol=1e-12)

    def test_is_shown_in_parts(self):
        """Commands that know straight tets alone see eight for each curved one."""
        tets = 8 * len(self.curved.tets)
        told = run("info", "c.vtu", "--json")
        self.assertIn(f'"tets": {tets},', told)
        self.assertIn(f'"curved_tets": {len(self.curved.tets)}', told)
        self.assertNotIn("curved_tets", run("info", "straight.vtu", "--json"))
        run("surface", "c.vtu", "--label", 1, "-o", "s.stl")

    def test_convert_keeps_every_node(self):
        run("convert", "c.vtu", "kept.vtkhdf")
        run("convert", "kept.vtkhdf", "kept.vtu")
        run("convert", "c.vtu", "asked.vtu", "--element", "tet10-curved")
        expected = pathlib.Path("c.vtu").read_bytes()
        for name in ("kept.vtu", "asked.vtu"):
            self.assertEqual(pathlib.Path(name).read_bytes(), expected)
        self.assertIn("C3D10", self.written("c.vtu", "c.inp"))
        self.assertIn("C3D10", self.written("straight.vtu", "straight.inp"))
        self.assertIn("C3D4", self.written("m.vtkhdf", "m.inp"))
        for name in ("s.vtkhdf", "s.msh2", "s.vtu", "s.msh"):
            self.assertIn("ten nodes", run("convert", "straight.vtu", name))
            run("convert", name, "back.vtu")
            self.assertEqual(Mesh("back.vtu").tets.shape, self.straight.tets.shape)

    def written(self, mesh, name):
        run("convert", mesh, name)
        return next(line for line in pathlib.Path(name).read_text().splitlines() if line.startswith("*ELEMENT"))

    def test_convert_tells_which_nodes_it_leaves_out(self):
        self.assertIn("left out: middles of edges; four.mesh: .mesh is written with tet4 only",
                      run("convert", "straight.vtu", "four.mesh"))
        self.assertIn("left out: middles of edges", run("convert", "straight.vtu", "p.pvtu", "--pieces", 2))
        self.assertEqual(run("convert", "straight.vtu", "four.inp", "--element", "tet4"), "")
        self.assertEqual(run("convert", "m.vtkhdf", "four.vtu"), "")
        said = run("convert", "c.vtu", "parts.mesh")
        self.assertIn("left out: middles of edges", said)
        self.assertIn("each curved tet is written as eight of its parts", said)

    def test_wedges_of_six_nodes_stay(self):
        v = np.zeros((8, 8, 8), np.uint8)
        v[:, :, 4:] = 1
        np.save("w.npy", v)
        run("mesh", "w.npy", "-o", "w.vtu", "--element", "tet10", "--cohesive", "0|1")
        self.assertIn("wedges of six nodes only", run("convert", "w.vtu", "w.msh"))
        self.assertIn("ten nodes", run("convert", "w.vtu", "w.vtkhdf"))

    def test_parts_do_not_promise_the_floor_of_curved_tets(self):
        for name in ("s4.vtu", "s10.vtkhdf", "s4.mesh", "s10.msh"):
            run("convert", "c.vtu", name, "--element", "tet" + name.split(".")[0][1:])
            said = run("verify", "v.npy", name, *(["--quality-floor", 0] if name.endswith("msh") else []))
            self.assertIn("all checks hold", said)
        self.assertIn("recorded promise: no distance bound, no floor", run("verify", "v.npy", "s4.vtu"))
        self.assertIn("radius ratio 0.1", run("verify", "v.npy", "c.vtu"))

    def test_refusals_name_the_way_out(self):
        for flag in ("--split=0|1", "--cohesive=0|1", "--open-hinges"):
            refused(["tet10 is"], "mesh", "v.npy", "-o", "no.vtu", "--element", "tet10-curved", flag,
                    code=2)
        run("mesh", "v.npy", "-o", "split.vtkhdf", "--split", "0|1")
        for change in ((), ("--labels", 1), ("--open-hinges",)):
            refused(["tet10 is"], "convert", "split.vtkhdf", "no.vtu", "--element", "tet10-curved", *change,
                    code=2)
        done = start("mesh", "v.npy", "-o", "no.mesh", "--element", "tet10-curved")
        self.assertEqual(done.returncode, 2)
        refused(["tet10-curved"], "convert", "m.vtkhdf", "no.vtu", "--element", "tet20", code=2)


class Cut(unittest.TestCase):
    def test_lines_in_the_box_stay_in_it(self):
        """Half a ball and two labels of a layer: lines on the box, and where three labels meet."""
        enter_folder(self)
        v = ball()[int(CENTRE[2]):]  # the middle is the box's face
        v[v == 0] = 2
        v[:, :, :18][v[:, :, :18] == 2] = 3
        np.save("h.npy", v)
        run("mesh", "h.npy", "-o", "h.vtkhdf")
        for element in ("tet10", "tet10-curved"):
            run("convert", "h.vtkhdf", element + ".vtu", "--element", element)
        said = run("verify", "h.npy", "tet10-curved.vtu", "--max-distance", 1.5)
        self.assertIn("all checks hold", said)
        before, after = Mesh("tet10.vtu").points, Mesh("tet10-curved.vtu").points
        ends = np.array(v.shape[::-1])
        on_side = (before == 0) | (before == ends)
        np.testing.assert_array_equal(after[on_side], before[on_side])
        moved = (before != after).any(1)
        self.assertTrue((moved & on_side.any(1)).any())


if __name__ == "__main__":
    unittest.main()
