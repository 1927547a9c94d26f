#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""meshio and a parser by the manual see our .inp files as numpy sees the same mesh."""
import itertools
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.append(f"{os.path.dirname(__file__)}/../../../engine/cli")
try:
    from reading_meshio import meshio
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

PROGRAM = os.environ["MW_PROGRAM"]
LARGE = 2**64 - 3
TEN_NODES = "--element" in subprocess.run(
    [PROGRAM, "convert", "--help"], capture_output=True, text=True
).stdout
FACES = {"S1": (0, 1, 2), "S2": (0, 3, 1), "S3": (1, 3, 2), "S4": (2, 3, 0)}


def run(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, (arguments, done.returncode, done.stdout, done.stderr)
    return done.stdout


def parse(path):
    """Nodes, elements, and sets and surfaces by name, from the lines of the file."""
    nodes, elements, sets, surfaces = {}, {}, {}, {}
    take = None
    with open(path, encoding="utf-8") as file:
        lines = file.read().splitlines()
    for line in lines:
        if line.startswith("**"):
            continue
        items = [item.strip() for item in line.split(",")]
        if not line.startswith("*"):
            take(items)
            continue
        values = dict(item.split("=") for item in items[1:])
        if items[0] == "*NODE":
            take = lambda row: nodes.__setitem__(int(row[0]), [float(x) for x in row[1:]])
        elif items[0] == "*ELEMENT":
            take = lambda row, name=values["ELSET"]: elements.__setitem__(
                int(row[0]), (name, [int(n) for n in row[1:]]))
        elif items[0] == "*NSET":
            members = sets.setdefault(values["NSET"], [])
            take = lambda row, members=members: members.extend(int(n) for n in row)
        elif items[0] == "*SURFACE":
            assert values["TYPE"] == "ELEMENT" and values["NAME"] not in surfaces
            faces = surfaces.setdefault(values["NAME"], [])
            take = lambda row, faces=faces: faces.append((int(row[0]), row[1]))
        else:
            assert items[0] == "*HEADING", items
            take = lambda row: None
    return nodes, elements, sets, surfaces


def ordered(name):
    """Whether FACE_1_2 is on the side of the lower label."""
    one, other = map(int, name.split("_")[1:])
    return one < other


class Abaqus(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        os.chdir(folder.name)
        run("synth", "voronoi", "--shape", "14,12,10", "--labels", "6", "--seed", "2", "-o", "v.npy")
        run("mesh", "v.npy", "-o", "v.vtu", "--merge", f"1={LARGE}", "--spacing", "1,1.5,2",
            "--origin", "5,-3,7")
        run("convert", "v.vtu", "v.inp")
        mesh = meshio.read("v.vtu")
        cls.points = mesh.points
        cls.tets = mesh.cells_dict["tetra"]
        cls.labels = mesh.cell_data_dict["label"]["tetra"].ravel().astype(np.uint64)
        cls.nodes, cls.elements, cls.sets, cls.surfaces = parse("v.inp")

    def test_nodes_and_elements(self):
        self.assertEqual(list(self.nodes), list(range(1, len(self.points) + 1)))
        np.testing.assert_array_equal(list(self.nodes.values()), self.points)
        self.assertEqual(list(self.elements), list(range(1, len(self.tets) + 1)))
        found = sorted((name, [n - 1 for n in rows]) for name, rows in self.elements.values())
        mine = sorted((f"LABEL_{l}", list(rows)) for l, rows in zip(self.labels, self.tets))
        self.assertEqual(found, mine)

    def faces(self, name):
        """Rows of the corners, normals outwards."""
        out = []
        for element, face in self.surfaces[name]:
            rows = [n - 1 for n in self.elements[element][1]]
            a, b, c = (rows[i] for i in FACES[face])
            normal = np.cross(self.points[b] - self.points[a], self.points[c] - self.points[a])
            if normal @ (self.points[rows].mean(0) - self.points[a]) > 0:
                b, c = c, b
            out.append((a, b, c))
        return out

    def test_surfaces_bound_what_they_say(self):
        sides = {}
        for tet, label in zip(self.tets, self.labels):
            for left_out in range(4):
                key = tuple(sorted(np.delete(tet, left_out)))
                sides.setdefault(key, []).append(int(label))
        expected = {}
        for triangle, labels in sides.items():
            if len(labels) == 2 and labels[0] != labels[1]:
                for pair in itertools.permutations(labels):
                    expected.setdefault("FACE_{}_{}".format(*pair), []).append(triangle)
            if len(labels) == 1:
                corners = self.points[list(triangle)]
                for axis in range(3):
                    for bound, end in ((self.points.min(0), "MIN"), (self.points.max(0), "MAX")):
                        if (corners[:, axis] == bound[axis]).all():
                            expected.setdefault(f"{'XYZ'[axis]}_{end}", []).append(triangle)
        self.assertEqual(set(self.surfaces), set(expected))
        once = {name for name in expected if not name.startswith("FACE") or ordered(name)}
        self.assertEqual(set(self.sets), once)
        for name, triangles in expected.items():
            found = sorted(tuple(sorted(face)) for face in self.faces(name))
            self.assertEqual(found, sorted(triangles), name)
            if name in self.sets:
                rows = [n - 1 for n in self.sets[name]]
                self.assertEqual(rows, sorted({row for face in triangles for row in face}))
            if name.startswith("FACE"):  # the side of the first label
                first = "LABEL_" + name.split("_")[1]
                self.assertEqual({self.elements[e][0] for e, _ in self.surfaces[name]}, {first})

    def test_surfaces_enclose_the_volume(self):
        """By the divergence theorem: of the sides the box, of label 2 what its tets add up to."""
        def enclosed(faces):
            a, b, c = (self.points[np.array(faces)[:, i]] for i in range(3))
            return np.einsum("ij,ij", a, np.cross(b, c)) / 6

        sides = [face for name in self.surfaces if name[1:] in ("_MIN", "_MAX")
                 for face in self.faces(name)]
        self.assertAlmostEqual(enclosed(sides), np.prod(np.ptp(self.points, axis=0)), 6)
        label = 2
        around = 0
        for name in self.surfaces:
            faces = self.faces(name)
            if name.startswith("FACE_"):
                around += enclosed(faces) * name.startswith(f"FACE_{label}_")
                continue
            mine = [face for face, (e, _) in zip(faces, self.surfaces[name])
                    if self.elements[e][0] == f"LABEL_{label}"]
            around += enclosed(mine) if mine else 0
        corner = self.points[self.tets[self.labels == label]]
        edges = corner[:, 1:] - corner[:, :1]
        self.assertAlmostEqual(around, np.linalg.det(edges).sum() / 6, 6)

    def test_meshio_reads_ours(self):
        mesh = meshio.read("v.inp")
        np.testing.assert_array_equal(mesh.points, self.points)
        tets = np.concatenate([block.data for block in mesh.cells if block.type == "tetra"])
        self.assertEqual(sorted(map(tuple, tets)), sorted(map(tuple, self.tets)))
        for name, rows in mesh.point_sets.items():
            self.assertEqual([row + 1 for row in rows], self.sets[name])
        self.assertEqual(set(mesh.point_sets), set(self.sets))

    @unittest.skipUnless(shutil.which("ccx"), "no CalculiX")
    def test_calculix_solves_on_ours(self):
        """Held at x_min, pressed at x_max and at an interface: reactions balance the pressures."""
        # CalculiX leaves loads of held nodes out of their reactions.
        held = set(self.sets["X_MIN"])
        inner = max((name for name in self.surfaces
                     if name in self.sets and name.startswith("FACE")
                     and held.isdisjoint(self.sets[name])),
                    key=lambda name: len(self.surfaces[name]))
        for options in ([], ["--element", "tet10"]) if TEN_NODES else ([],):
            run("convert", "v.vtu", "mesh.inp", *options)
            sets = sorted({name for name, _ in self.elements.values()})
            with open("job.inp", "w", encoding="utf-8") as job:
                job.write("*INCLUDE, INPUT=mesh.inp\n*MATERIAL, NAME=M\n*ELASTIC\n100, 0.3\n")
                for name in sets:
                    job.write(f"*SOLID SECTION, ELSET={name}, MATERIAL=M\n")
                job.write(f"*BOUNDARY\nX_MIN, 1, 3\n*STEP\n*STATIC\n*DSLOAD\nX_MAX, P, 2\n"
                          f"{inner}, P, 0.5\n*NODE PRINT, NSET=X_MIN, TOTALS=ONLY\nRF\n*END STEP\n")
            subprocess.run(["ccx", "job"], capture_output=True, check=True)
            with open("job.dat", encoding="utf-8") as file:
                reaction = [float(x) for x in file.read().split()[-3:]]
            pressed = 2 * self.area_vector("X_MAX") + 0.5 * self.area_vector(inner)
            np.testing.assert_allclose(reaction, pressed, rtol=1e-4, atol=1e-3)

    @unittest.skipUnless(shutil.which("ccx"), "no CalculiX")
    def test_calculix_finds_labels_by_their_names(self):
        """Sets have the labels' names, and both sides of an interface take loads that cancel out."""
        with open("names.csv", "w", encoding="utf-8") as file:
            file.write('id,name\n1,"1st, left"\n2,Matrix (epoxy)\n3,cyst\n4,CYST\n')
        run("mesh", "v.npy", "-o", "named.inp", "--names", "names.csv")
        _, elements, sets, surfaces = parse("named.inp")
        found = {name for name, _ in elements.values()}
        self.assertEqual(found, {"L_1st_left", "Matrix_epoxy", "cyst_3", "CYST_4"})
        with open("named.inp", encoding="utf-8") as file:
            comments = [line for line in file if line.startswith("**")]
        self.assertIn('** Matrix_epoxy: label 2 "Matrix (epoxy)"\n', comments)
        held = set(sets["X_MIN"])
        one = max((name for name in sets if name.startswith("FACE_Matrix_epoxy_")
                   and held.isdisjoint(sets[name])), key=lambda name: len(surfaces[name]))
        other = f"FACE_{one[len('FACE_Matrix_epoxy_'):]}_Matrix_epoxy"
        with open("job.inp", "w", encoding="utf-8") as job:
            job.write("*INCLUDE, INPUT=named.inp\n*MATERIAL, NAME=M\n*ELASTIC\n100, 0.3\n")
            for name in sorted(found):
                job.write(f"*SOLID SECTION, ELSET={name}, MATERIAL=M\n")
            job.write(f"*BOUNDARY\nX_MIN, 1, 3\n*STEP\n*STATIC\n*DSLOAD\n{one}, P, 1\n{other}, P, 1\n"
                      "*NODE PRINT, NSET=X_MIN, TOTALS=ONLY\nRF\n*END STEP\n")
        subprocess.run(["ccx", "job"], capture_output=True, check=True)
        with open("job.dat", encoding="utf-8") as file:
            reaction = [float(x) for x in file.read().split()[-3:]]
        np.testing.assert_allclose(reaction, 0, atol=1e-4)

    def area_vector(self, name):
        a, b, c = (self.points[np.array(self.faces(name))[:, i]] for i in range(3))
        return np.cross(b - a, c - a).sum(0) / 2


if __name__ == "__main__":
    unittest.main(verbosity=2)
