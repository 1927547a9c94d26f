#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Gmsh and meshio see our .msh files as numpy sees the same mesh, and we read what they write."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.append(f"{os.path.dirname(__file__)}/../../../engine/cli")
try:
    import gmsh
    from reading_meshio import meshio
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

PROGRAM = os.environ["MW_PROGRAM"]
LARGE = 2**40  # no 32-bit tag
TEN_NODES = "--element" in subprocess.run(
    [PROGRAM, "convert", "--help"], capture_output=True, text=True
).stdout


def run(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, (arguments, done.returncode, done.stdout, done.stderr)
    return done.stdout


def facets_by_group(tets, labels):
    """Triangles (sorted rows) by what they bound: a pair of labels, or one label."""
    sides = {}
    for tet, label in zip(tets, labels):
        for left_out in range(4):
            sides.setdefault(tuple(sorted(np.delete(tet, left_out))), []).append(int(label))
    groups = {}
    for triangle, found in sides.items():
        if len(found) == 1 or found[0] != found[1]:
            groups.setdefault(tuple(sorted(found)), []).append(triangle)
    return groups


def area(points, triangles):
    a, b, c = (points[np.array(triangles)[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


class Gmsh(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        os.chdir(folder.name)
        with open("names.csv", "w", encoding="utf-8") as file:
            file.write(f'id,name\n2,Größe\n3,"a ""b"", c"\n{LARGE},far away\n')
        run("synth", "voronoi", "--shape", "14,12,10", "--labels", "6", "--seed", "2", "-o", "v.npy")
        wanted = ["--merge", f"1={LARGE}", "--spacing", "1,1.5,2", "--origin", "5,-3,7"]
        run("mesh", "v.npy", "-o", "v.vtu", "--names", "names.csv", *wanted)
        run("convert", "v.vtu", "v.msh")
        run("convert", "v.vtu", "text.msh", "--ascii")
        cls.digest = run("digest", "v.vtu")
        mesh = meshio.read("v.vtu")
        cls.points = mesh.points
        cls.tets = mesh.cells_dict["tetra"]
        cls.labels = mesh.cell_data_dict["label"]["tetra"].ravel().astype(np.uint64)
        cls.facets = facets_by_group(cls.tets, cls.labels)
        corner = cls.points[cls.tets]
        cls.volumes = np.einsum(
            "ij,ij->i", np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]),
            corner[:, 3] - corner[:, 0]) / 6
        cls.names = {2: "Größe", 3: "a 'b', c", LARGE: "far away"}
        cls.numbers = {}
        for label in np.unique(cls.labels):
            cls.names.setdefault(int(label), f"label_{label}")
            cls.numbers[int(label)] = int(label)
        cls.numbers[LARGE] = max(n for n in cls.numbers if n != LARGE) + 1

    def setUp(self):
        gmsh.initialize(["gmsh"], False)
        self.addCleanup(gmsh.finalize)
        gmsh.option.setNumber("General.Terminal", 0)

    def open(self, path):
        gmsh.clear()
        gmsh.logger.start()
        gmsh.open(path)
        log = gmsh.logger.get()
        gmsh.logger.stop()
        self.assertEqual([line for line in log if not line.startswith("Info")], [])

    def elements(self, dimension, physical, nodes_each):
        """Rows of nodes of a physical group; our tags are 1 + row."""
        nodes = [
            found
            for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, physical)
            for found in gmsh.model.mesh.getElements(dimension, entity)[2]
        ]
        return np.concatenate(nodes).astype(int).reshape(-1, nodes_each) - 1

    def groups(self, dimension):
        return {
            gmsh.model.getPhysicalName(d, tag): tag
            for d, tag in gmsh.model.getPhysicalGroups(dimension)
        }

    def test_nodes_and_volumes(self):
        for path in ("v.msh", "text.msh"):
            with self.subTest(path):
                self.open(path)
                tags, coordinates, _ = gmsh.model.mesh.getNodes()
                points = np.empty_like(self.points)
                points[tags.astype(int) - 1] = coordinates.reshape(-1, 3)
                np.testing.assert_array_equal(points, self.points)
                expected = {self.names[label]: number for label, number in self.numbers.items()}
                self.assertEqual(self.groups(3), expected)
                for label, number in self.numbers.items():
                    found = self.elements(3, number, 4)
                    mine = self.tets[self.labels == label]
                    self.assertEqual(sorted(map(tuple, found)), sorted(map(tuple, mine)))
                    gmsh.plugin.setNumber("MeshVolume", "PhysicalGroup", number)
                    gmsh.plugin.setNumber("MeshVolume", "Dimension", 3)
                    gmsh.plugin.run("MeshVolume")
                    view = gmsh.view.getTags()[-1]
                    volume = gmsh.view.getListData(view)[2][0][3]
                    self.assertAlmostEqual(volume, self.volumes[self.labels == label].sum(), 9)

    def test_surfaces(self):
        self.open("v.msh")
        expected = {}
        lo, hi = self.points.min(0), self.points.max(0)
        for labels, triangles in self.facets.items():
            if len(labels) == 2:
                expected["|".join(self.names[label] for label in labels)] = triangles
                continue
            for triangle in triangles:
                corners = self.points[list(triangle)]
                for axis in range(3):
                    for bound, name in ((lo, "min"), (hi, "max")):
                        if (corners[:, axis] == bound[axis]).all():
                            expected.setdefault(f"{'xyz'[axis]}_{name}", []).append(triangle)
        groups = self.groups(2)
        self.assertEqual(set(groups), set(expected))
        largest = max(self.numbers.values())
        for i, side in enumerate(("x_min", "x_max", "y_min", "y_max", "z_min", "z_max")):
            self.assertEqual(groups[side], largest + 1 + i)
        interfaces = sorted(tag for name, tag in groups.items() if "|" in name)
        self.assertEqual(interfaces, list(range(largest + 8, largest + 8 + len(interfaces))))
        entities = [tag for _, tag in gmsh.model.getEntities()]
        self.assertEqual(len(entities), len(set(entities)))
        for name, tag in groups.items():
            found = self.elements(2, tag, 3)
            self.assertEqual(sorted(tuple(sorted(t)) for t in found), sorted(expected[name]))
            gmsh.plugin.setNumber("MeshVolume", "PhysicalGroup", tag)
            gmsh.plugin.setNumber("MeshVolume", "Dimension", 2)
            gmsh.plugin.run("MeshVolume")
            measured = gmsh.view.getListData(gmsh.view.getTags()[-1])[2][0][3]
            self.assertAlmostEqual(measured, area(self.points, expected[name]), 9)

    def test_oriented_boundaries_enclose_the_volumes(self):
        """By the divergence theorem, also after the topology was made."""
        for topology in (False, True):
            self.open("v.msh")
            if topology:
                gmsh.model.mesh.createTopology(False)
                self.assertGreater(len(gmsh.model.getEntities(1)), 0)
                self.assertEqual(len(self.groups(3)), len(self.numbers))
            for label, number in self.numbers.items():
                volume = 0
                for _, tag in gmsh.model.getBoundary([(3, number)], oriented=True):
                    rows = gmsh.model.mesh.getElements(2, abs(tag))[2][0].astype(int) - 1
                    a, b, c = (self.points[rows.reshape(-1, 3)[:, i]] for i in range(3))
                    volume += np.sign(tag) * np.einsum("ij,ij", a, np.cross(b, c)) / 6
                if not topology:  # which forgets signs
                    self.assertAlmostEqual(volume, self.volumes[self.labels == label].sum(), 7)
                rows = np.unique(self.tets[self.labels == label])
                box = gmsh.model.getBoundingBox(3, number)
                np.testing.assert_allclose(box[:3], self.points[rows].min(0), atol=1e-6)
                np.testing.assert_allclose(box[3:], self.points[rows].max(0), atol=1e-6)

    def test_check_finds_nothing(self):
        for path in ("v.msh", "text.msh"):
            done = subprocess.run(["gmsh", "-check", path], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0)
            for word in ("Warning", "Error"):
                self.assertNotIn(word, done.stdout + done.stderr)

    @unittest.skipUnless(TEN_NODES, "no --element")
    def test_ten_nodes(self):
        run("convert", "v.vtu", "ten.msh", "--element", "tet10")
        self.assertEqual(run("digest", "ten.msh"), self.digest)
        self.open("ten.msh")
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        points = np.empty((len(tags), 3))
        points[tags.astype(int) - 1] = coordinates.reshape(-1, 3)
        for dimension, kind in ((3, 11), (2, 9)):
            _, _, _, each, local, corners = gmsh.model.mesh.getElementProperties(kind)
            local = np.array(local).reshape(each, dimension)
            nodes = points[gmsh.model.mesh.getElementsByType(kind)[1].astype(int).reshape(-1, each) - 1]
            self.assertGreater(len(nodes), 100)
            shares = np.column_stack([1 - local.sum(1), local])
            straight = np.einsum("nc,ecx->enx", shares, nodes[:, :corners])
            np.testing.assert_allclose(nodes, straight, atol=1e-12)

    def test_meshio_reads_ours(self):
        for path in ("v.msh", "text.msh"):
            mesh = meshio.read(path)
            tets = mesh.cells_dict["tetra"]
            numbers = mesh.cell_data_dict["gmsh:physical"]["tetra"]
            labels = np.array([self.numbers[int(label)] for label in self.labels])
            mine = np.column_stack([self.points[self.tets].sum(1), labels])
            found = np.column_stack([mesh.points[tets].sum(1), numbers])
            np.testing.assert_allclose(
                mine[np.lexsort(mine.round(9).T)], found[np.lexsort(found.round(9).T)], atol=1e-9)
            self.assertEqual(mesh.field_data["x_min"].tolist(), [max(self.numbers.values()) + 1, 2])

    def test_meshio_reads_names_in_a_vtu(self):
        fields = meshio.read("v.vtu").field_data
        names = bytes(fields["label_name"].ravel()).decode().split("\0")[:-1]
        found = dict(zip(fields["label_id"].ravel().tolist(), names))
        self.assertEqual(found, {2: "Größe", 3: 'a "b", c', LARGE: "far away"})

    def test_we_read_what_gmsh_makes_of_ours(self):
        run("mesh", "v.npy", "-o", "small.vtu", "--names", "names.csv")
        digest = run("digest", "small.vtu")
        run("convert", "small.vtu", "small.msh")
        for version in (2.2, 4.1):
            for binary in (0, 1):
                self.open("small.msh")
                gmsh.option.setNumber("Mesh.MshFileVersion", version)
                gmsh.option.setNumber("Mesh.Binary", binary)
                gmsh.write("theirs.msh")
                with self.subTest(version=version, binary=binary):
                    self.assertEqual(run("digest", "theirs.msh"), digest)
                    rows = json.loads(run("info", "theirs.msh", "--json"))["volume"]["per_label"]
                    names = {row["label"]: row["name"] for row in rows if "name" in row}
                    self.assertEqual(names, {2: "Größe", 3: "a 'b', c"})

    def test_we_read_meshes_of_gmsh(self):
        """Two boxes; with sparse tags, with ten nodes, and what meshio makes of it."""
        gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
        gmsh.model.occ.addBox(1, 0, 0, 2, 1, 1)
        gmsh.model.occ.fragment([(3, 1)], [(3, 2)])
        gmsh.model.occ.synchronize()
        for entity, label in ((1, 40), (2, 50)):
            group = gmsh.model.addPhysicalGroup(3, [entity], label)
            gmsh.model.setPhysicalName(3, group, f"box {label}")
        gmsh.option.setNumber("Mesh.MeshSizeMax", 0.3)
        gmsh.option.setNumber("Mesh.FirstNodeTag", 1000)
        gmsh.model.mesh.generate(3)
        gmsh.write("one.msh")
        tets = len(gmsh.model.mesh.getElementsByType(4)[0])
        gmsh.model.mesh.setOrder(2)
        gmsh.write("two.msh")
        meshio.write("theirs.msh", meshio.read("one.msh"), file_format="gmsh")
        for path in ("one.msh", "two.msh", "theirs.msh"):
            facts = json.loads(run("info", path, "--json"))
            self.assertEqual(facts["tets"], tets)
            rows = {row["label"]: row["volume"] for row in facts["volume"]["per_label"]}
            self.assertEqual(set(rows), {40, 50})
            self.assertAlmostEqual(rows[40], 1)
            self.assertAlmostEqual(rows[50], 2)
        self.assertEqual(run("digest", "one.msh"), run("digest", "two.msh"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
