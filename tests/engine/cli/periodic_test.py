# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Cells that repeat themselves: the same triangles on opposite faces, and the pairs of their nodes."""
import csv
import os
import re
import shutil
import subprocess
import unittest

try:
    from reading_meshio import meshio
    import numpy as np
except ImportError:
    raise SystemExit(77)
from program import enter_folder, refused, run, start

UNITS = 1024  # of the lattice, a voxel


def grains(shape, count, seed):
    """A Voronoi diagram on the torus, [z, y, x]."""
    random = np.random.default_rng(seed)
    centres = np.moveaxis(np.indices(shape), 0, -1) + 0.5
    nearest, labels = np.full(shape, np.inf), np.zeros(shape, np.uint8)
    for label in range(1, count + 1):
        apart = np.abs(centres - random.uniform(0, shape))
        apart = np.minimum(apart, shape - apart)
        distance = (apart**2).sum(-1)
        labels[distance < nearest] = label
        nearest = np.minimum(nearest, distance)
    return labels


def faces(file, axis):
    """The triangles on the low and on the high face, each as the places of its corners in the face."""
    mesh = meshio.read(file)
    points = np.round(mesh.points * UNITS).astype(np.int64)
    tets = np.vstack([block.data for block in mesh.cells if block.type == "tetra"])
    triangles = np.sort(np.vstack([np.delete(tets, k, 1) for k in range(4)]), 1)
    triangles, count = np.unique(triangles, axis=0, return_counts=True)
    outer = triangles[count == 1]
    others = [k for k in range(3) if k != axis]
    out = []
    for place in (0, points[:, axis].max()):
        on = outer[(points[outer][:, :, axis] == place).all(1)]
        out.append({tuple(sorted(map(tuple, points[t][:, others]))) for t in on})
    return out


class Periodic(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        np.save("grains.npy", grains((32, 24, 40), 6, 1))

    def mesh(self, volume, axes, output="m.vtu", *more):
        run("mesh", volume, "-o", output, "--force", "--periodic", axes, *more)

    def check(self, file, axes):
        for axis, name in enumerate("xyz"):
            low, high = faces(file, axis)
            self.assertGreater(len(low), 0)
            self.assertEqual(low == high, name in axes, name)

    def test_faces_match(self):
        for axes in ("x", "yz", "xyz"):
            with self.subTest(axes):
                self.mesh("grains.npy", axes)
                run("verify", "grains.npy", "m.vtu")
                self.check("m.vtu", axes)

    def test_sizes_that_few_cells_divide(self):
        random = np.random.default_rng(2)
        for shape in ((2, 4, 6), (12, 10, 14), (20, 16, 18), (34, 8, 22)):
            with self.subTest(shape):
                labels = grains(shape, 4, random.integers(99))
                np.save("odd.npy", labels)
                self.mesh("odd.npy", "xyz")
                run("verify", "odd.npy", "m.vtu")
                self.check("m.vtu", "xyz")

    def test_odd_numbers_of_voxels(self):
        """Voxels are cut in halves, so that the start mesh repeats itself."""
        for shape in ((9, 12, 8), (15, 13, 11), (45, 21, 16)):
            with self.subTest(shape):
                np.save("odd.npy", grains(shape, 6, 5))
                self.mesh("odd.npy", "xyz", "m.vtu", *(("--size", "4") if shape[0] == 45 else ()))
                run("verify", "odd.npy", "m.vtu")
                points = meshio.read("m.vtu").points
                np.testing.assert_array_equal(points.max(0), shape[::-1])

    def test_large_cells_inside_labels(self):
        labels = np.ones((96, 96, 96), np.uint8)
        labels[40:56, 44:52, 30:66] = 2
        np.save("large.npy", np.roll(labels, (48, 20, 0), (0, 1, 2)))
        self.mesh("large.npy", "xyz")
        self.check("m.vtu", "xyz")

    def test_sizes(self):
        """Sizes, counts and thin parts make meshes that hold their promises, with faces that match."""
        for options in (("--size", "3"), ("--size", "1=4,2|*=2"), ("--count", "9000"), ("--across", "2"),
                        ("--preset", "fine")):
            with self.subTest(options):
                self.mesh("grains.npy", "xyz", "m.vtu", *options)
                run("verify", "grains.npy", "m.vtu")
                self.check("m.vtu", "xyz")
        self.assertLess(abs(self.tets("--count", "9000") / 9000 - 1), 0.1)

    def test_sizes_of_an_image(self):
        """Sizes by place repeat themselves, too: they are small around a corner, which is all corners."""
        apart = [np.minimum(np.arange(n) + 0.5, n - np.arange(n) - 0.5) for n in (32, 24, 40)]
        distance = np.sqrt(sum(a**2 for a in np.meshgrid(*apart, indexing="ij")))
        np.save("sizes.npy", np.clip(distance / 2, 2, 8).astype(np.float32))
        self.mesh("grains.npy", "xyz", "m.mesh", "--size", "@sizes.npy")
        points = meshio.read("m.mesh").points
        corner = np.minimum(points, (40, 24, 32) - points)
        near = (corner < 6).all(1).sum()
        self.mesh("grains.npy", "xyz", "m.mesh", "--size", "8")
        points = meshio.read("m.mesh").points
        corner = np.minimum(points, (40, 24, 32) - points)
        self.assertGreater(near, 2 * (corner < 6).all(1).sum())

    def tets(self, *options):
        self.mesh("grains.npy", "xyz", "m.vtu", *options)
        return sum(len(block.data) for block in meshio.read("m.vtu").cells if block.type == "tetra")

    def test_faces_are_as_coarse_as_the_rest(self):
        np.save("cell.npy", grains((48, 48, 48), 40, 1))
        self.mesh("cell.npy", "xyz", "m.vtu")
        run("verify", "cell.npy", "m.vtu")
        periodic = len(meshio.read("m.vtu").points)
        run("mesh", "cell.npy", "-o", "m.vtu", "--force")
        self.assertLess(periodic, 1.1 * len(meshio.read("m.vtu").points))

    def test_inner_vertices(self):
        for axes in ("x", "xyz"):
            with self.subTest(axes):
                self.mesh("grains.npy", axes, "m.vtu", "--inner-vertices")
                self.check("m.vtu", axes)
        for shape in ((4, 1, 1), (4, 4, 2)):  # a window sees both ends of such a cell
            with self.subTest(shape):
                np.save("thin.npy", np.random.default_rng(3).integers(0, 3, shape, np.uint8))
                self.mesh("thin.npy", "xyz", "m.vtu", "--inner-vertices", "--quality-floor", "0.3")
                run("verify", "thin.npy", "m.vtu")
                self.check("m.vtu", "xyz")

    def test_again_after_an_edit(self):
        """What an edit at one face changes beyond the other one is meshed again, too."""
        labels = grains((32, 24, 40), 6, 1)
        self.mesh("grains.npy", "xyz", "kept.vtkhdf", "--keep", "kept", "--window", "8")
        labels[:2, 10:14, 8:20] = 7
        np.save("edited.npy", labels)
        self.mesh("edited.npy", "xyz", "kept.vtkhdf", "--from", "kept", "--window", "8")
        self.mesh("edited.npy", "xyz", "afresh.vtkhdf", "--window", "8")
        self.assertEqual(run("digest", "kept.vtkhdf"), run("digest", "afresh.vtkhdf"))

    def test_probabilities(self):
        """Interfaces lie where probabilities are equal, on faces as inside."""
        step = 2 * np.pi / 24
        z, y, x = np.meshgrid(*[(np.arange(24) + 0.5) * step] * 3, indexing="ij")
        gyroid = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
        one = 1 / (1 + np.exp(-2 * gyroid))
        np.save("scores.npy", np.stack([1 - one, one]).astype(np.float32))
        self.mesh("scores.npy", "xyz", "m.vtu", "--values", "probabilities", "--size", "3")
        self.check("m.vtu", "xyz")
        self.mesh("scores.npy", "xyz", "m.mesh", "--values", "probabilities", "--size", "3")
        mesh = meshio.read("m.mesh")
        tets = np.vstack([block.data for block in mesh.cells if block.type == "tetra"])
        labels = np.concatenate([refs for block, refs in zip(mesh.cells, mesh.cell_data["medit:ref"])
                                 if block.type == "tetra"])
        first, second = (np.unique(tets[labels == label]) for label in np.unique(labels))
        points = mesh.points[np.intersect1d(first, second)]
        on_faces = ((points == 0) | (points == 24)).any(1)
        x, y, z = (points * step).T
        value = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
        for places in (on_faces, ~on_faces):
            self.assertGreater(places.sum(), 30)
            self.assertLess(np.abs(value[places]).mean(), 0.1)
        refused(["5 layers along z"], "mesh", "scores.npy", "-o", "refused.vtu", "--values", "probabilities",
                "--periodic", "z", "--spacing", "1,1,5", code=2)

    def test_noise(self):
        np.save("noise.npy", np.random.default_rng(3).integers(0, 3, (12, 16, 10)).astype(np.uint8))
        self.mesh("noise.npy", "xyz")
        run("verify", "noise.npy", "m.vtu")
        self.check("m.vtu", "xyz")

    def test_any_number_of_threads(self):
        self.mesh("grains.npy", "xyz", "one.vtkhdf", "--threads", "1")
        self.mesh("grains.npy", "xyz", "three.vtkhdf", "--threads", "3", "--window", "32")
        self.assertEqual(run("digest", "one.vtkhdf"), run("digest", "three.vtkhdf"))

    def test_pairs(self):
        for element in ("tet4", "tet10"):
            with self.subTest(element):
                self.mesh("grains.npy", "xy", "m.inp", "--pairs", "pairs.csv", "--element", element)
                points = meshio.read("m.inp").points
                edges = points.max(0) - points.min(0)
                with open("pairs.csv", encoding="utf-8") as file:
                    rows = [{key: int(value) for key, value in row.items()} for row in csv.DictReader(file)]
                masters = {row["image_of"] for row in rows}
                self.assertEqual(len({row["node"] for row in rows}), len(rows))
                for row in rows:
                    apart = points[row["node"] - 1] - points[row["image_of"] - 1]
                    np.testing.assert_allclose(apart, edges * (row["x"], row["y"], row["z"]), atol=1e-9)
                    self.assertNotIn(row["node"], masters)
                on_high = ((points[:, :2] == points.max(0)[:2]).any(1)).sum()
                self.assertEqual(len(rows), on_high)

    def test_pairs_of_a_mesh_that_is_converted(self):
        self.mesh("grains.npy", "z", "m.vtkhdf", "--pairs", "first.csv")
        run("convert", "m.vtkhdf", "n.msh", "--pairs", "second.csv")
        with open("first.csv", encoding="utf-8") as first, open("second.csv", encoding="utf-8") as second:
            self.assertEqual(first.read(), second.read())

    def test_pairs_of_what_is_left(self):
        """Where only one face has nodes, none of them is its own image."""
        labels = np.ones((16, 16, 16), np.uint8)
        labels[:, :, 12:] = 2
        np.save("half.npy", labels)
        self.mesh("half.npy", "x", "half.vtu", "--labels", "2", "--pairs", "half.csv")
        with open("half.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row for row in rows if row["node"] == row["image_of"]], [])

    def test_what_is_not_known_is_said(self):
        self.mesh("grains.npy", "x", "k.vtu")
        run("convert", "k.vtu", "k.msh")
        for names, words in ((("k.msh", "l.vtu"), "does not tell"), (("k.vtu", "l.pvtu", "--pieces", "2"),
                                                                      "--pairs")):
            refused([words], "convert", *names, "--pairs", "k.csv", code=2)

    def test_faces_that_do_not_match(self):
        """A vertex on a face is moved by one unit of the lattice."""
        self.mesh("grains.npy", "x", "m.mesh")
        with open("m.mesh", encoding="utf-8") as file:
            lines = file.read().split("\n")
        first = next(i for i, line in enumerate(lines) if line.startswith("Vertices")) + 2

        def is_inside_a_face(line):
            x, y, z, _reference = map(float, line.split())
            return x == 40 and 0 < y < 24 and 0 < z < 32

        moved = next(i for i in range(first, len(lines)) if is_inside_a_face(lines[i]))
        x, y, z, reference = lines[moved].split()
        lines[moved] = f"{x} {float(y) + 1 / UNITS} {z} {reference}"
        with open("n.mesh", "w", encoding="utf-8") as file:
            file.write("\n".join(lines))
        run("convert", "m.mesh", "m.vtu", "--pairs", "p.csv")
        done = start("convert", "n.mesh", "n.vtu", "--pairs", "p.csv")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("have no partner", done.stderr)
        self.assertIn("ok    P2 periodic      x: ", run("verify", "grains.npy", "m.mesh"))
        judged = start("verify", "grains.npy", "n.mesh")
        self.assertEqual(judged.returncode, 5)
        self.assertRegex(judged.stdout, "FAILS? +P2 periodic +x: .* which differ")

    def test_refused(self):
        for options, words in ((("grains.npy", "--pairs", "p.csv"), "give --periodic"),
                               (("grains.npy", "--periodic", "x", "--pairs", "p.csv", "--split", "*"),
                                "vertices are doubled"),
                               (("grains.npy", "--periodic", "x", "--pairs", "p.txt"), "written as .csv"),
                               (("grains.npy", "--periodic", "xy", "--deck", "periodic"),
                                "give --periodic xyz"),
                               (("grains.npy", "--periodic", "xyz", "--deck", "conduction", "--open-hinges"),
                                "vertices are doubled")):
            with self.subTest(options):
                refused([words], "mesh", *options, "-o", "refused.inp", code=2)
                self.assertFalse(os.path.exists("refused.inp.work"))
        run("mesh", "grains.npy", "-o", "plain.vtu", "--force")
        refused(["not made with --periodic"], "convert", "plain.vtu", "plain.inp", "--pairs", "p.csv",
                code=2)

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is missing")
    def test_stiffness_of_a_cell_and_of_the_same_cell_moved(self):
        labels = grains((24, 24, 24), 6, 4)
        np.save("cell.npy", labels)
        np.save("moved.npy", np.roll(labels, 12, 2))
        first, second = stiffness("cell.npy"), stiffness("moved.npy")
        self.assertGreater(first, 1.0)
        self.assertLess(first, 10.0 * 1.35)
        self.assertLess(abs(first / second - 1), 0.02)


def stiffness(volume):
    """C1111 of a cell whose odd labels have a modulus of 1, the others 10, by its energy."""
    run("mesh", volume, "-o", "cell.inp", "--force", "--periodic", "xyz", "--pairs", "equations.inp")
    with open("cell.inp", encoding="utf-8") as file:
        text = file.read()
    sets = sorted(set(re.findall(r"ELSET=(LABEL_\d+)", text)))
    nodes = np.array([line.split(",") for line in text.split("*NODE")[1].split("*")[0].split("\n")
                      if line.count(",") == 3], float)
    fixed = int(nodes[nodes[:, 1:].sum(1).argmin(), 0])
    edge = nodes[:, 1].max()
    lines = ["*INCLUDE, INPUT=cell.inp", "*INCLUDE, INPUT=equations.inp"]
    for parity, modulus in ((0, 10.0), (1, 1.0)):
        lines += [f"*MATERIAL, NAME=M{parity}", "*ELASTIC", f"{modulus}, .3"]
    lines += [f"*SOLID SECTION, ELSET={name}, MATERIAL=M{int(name[6:]) % 2}" for name in sets]
    lines += ["*BOUNDARY", f"{fixed},1,3,0.", "*STEP", "*STATIC", "*BOUNDARY", f"PERIODIC_X,1,1,{edge / 100}",
              "PERIODIC_X,2,3,0.", "PERIODIC_Y,1,3,0.", "PERIODIC_Z,1,3,0."]
    for name in sets:
        lines += [f"*EL PRINT, ELSET={name}, TOTALS=ONLY", "ELSE"]
    with open("job.inp", "w", encoding="utf-8") as file:
        file.write("\n".join(lines + ["*END STEP", ""]))
    subprocess.run(["ccx", "job"], check=True, capture_output=True)
    with open("job.dat", encoding="utf-8") as file:
        energy = sum(float(line) for line in file if len(line.split()) == 1)
    return 2 * energy / (0.01**2 * edge**3)


if __name__ == "__main__":
    unittest.main()
