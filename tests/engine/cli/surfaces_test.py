#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""VTK, meshio and numpy read the surfaces of `mwmesh surface`, and find them whole."""
import json
import os
import re
import shutil
import sys
import unittest

from program import enter_folder, run

try:
    from reading_meshio import meshio
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkFeatureEdges
    from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
    from vtkmodules.vtkIOPLY import vtkPLYReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

READERS = {
    ".stl": vtkSTLReader,
    ".ply": vtkPLYReader,
    ".obj": vtkOBJReader,
    ".vtp": vtkXMLPolyDataReader,
}
NAMES = {
    1: ('Left "big" one', (255, 0, 10)),
    2: ("<grain> & two", (1, 200, 3)),
    3: ("Größe 漢字", None),
}
PLAIN = (160, 160, 160)


def read(path):
    reader = READERS[os.path.splitext(path)[1]]()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def points_of(poly):
    return vtk_to_numpy(poly.GetPoints().GetData()).astype(float)


def triangles_of(poly):
    return vtk_to_numpy(poly.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def faces_of(path):
    """The rows of the last element, which meshio does not read when they have properties."""
    with open(path, "rb") as file:
        head, data = file.read().split(b"end_header\n", 1)
    count, properties = head.split(b"element face ")[1].split(b"\n", 1)
    row = [("corners", "u1"), ("vertices", "<i4", 3)]
    row += [(name.decode(), {b"int": "<i4", b"uchar": "u1"}[kind])
            for _, kind, name in map(bytes.split, properties.splitlines()[1:])]
    return np.frombuffer(data[-int(count) * np.dtype(row).itemsize:], row)


def volume_of(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def wrong_edges(poly, manifold=True):
    edges = vtkFeatureEdges()
    edges.SetInputData(poly)
    edges.FeatureEdgesOff()
    edges.BoundaryEdgesOn()
    edges.SetNonManifoldEdges(manifold)
    edges.ManifoldEdgesOff()
    edges.Update()
    return edges.GetOutput().GetNumberOfCells()


class Surfaces(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        for kind, edge, labels, name in (("voronoi", 24, 12, "v"), ("noise", 8, 3, "noise")):
            shape = ("--shape", f"{edge},{edge},{edge}", "--labels", labels, "--seed", 1)
            run("synth", kind, *shape, "-o", name + ".npy")
        with open("names.csv", "w", encoding="utf-8") as file:
            file.write("id;name;r;g;b\n")
            for label, (name, colour) in NAMES.items():
                quoted = name.replace('"', '""')
                file.write(f'{label};"{quoted}";{";".join(map(str, colour or ("", "", "")))}\n')
        run("mesh", "v.npy", "-o", "v.vtu", "--names", "names.csv")
        run("mesh", "noise.npy", "-o", "noise.vtu", "--surface", "voxel")
        facts = json.loads(run("info", "v.vtu", "--json"))
        cls.volumes = {row["label"]: row["volume"] for row in facts["volume"]["per_label"]}
        cls.area = facts["shape"]["area"]

    def test_a_label_is_closed_and_the_same_in_every_format(self):
        for label in (1, 2, 3):
            run("surface", "v.vtu", "--labels", label, "-o", "label.ply")
            expected = read("label.ply")
            corners = points_of(expected)[triangles_of(expected)]
            self.assertEqual(wrong_edges(expected, manifold=False), 0)
            volume = volume_of(points_of(expected), triangles_of(expected))
            self.assertAlmostEqual(volume / self.volumes[label], 1, places=6)
            for extension in READERS:
                out = "one" + extension
                run("surface", "v.vtu", "--labels", label, "--no-manifold", "-o", out)
                poly = read(out)
                found = points_of(poly)[triangles_of(poly)]
                np.testing.assert_allclose(found, corners, atol=1e-5, err_msg=extension)
                if extension == ".vtp":  # meshio reads none
                    continue
                mesh = meshio.read(out)
                np.testing.assert_allclose(
                    mesh.points[mesh.cells_dict["triangle"]], corners, atol=1e-5, err_msg=extension
                )

    def test_interfaces_have_labels_on_both_sides(self):
        run("surface", "v.vtu", "-o", "all.ply")
        poly, faces = read("all.ply"), faces_of("all.ply")
        inside, outside, side = (faces[name] for name in ("label_in", "label_out", "side"))
        self.assertTrue((inside < outside).all())
        self.assertTrue((side == 0).all())
        self.assertEqual(set(inside) | set(outside), set(self.volumes))
        corners = points_of(poly)[triangles_of(poly)]
        a, b, c = (corners[:, i] for i in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
        self.assertAlmostEqual(area / self.area, 1, places=6)
        colours = vtk_to_numpy(poly.GetCellData().GetArray("RGB"))
        expected = [NAMES.get(label, ("", None))[1] or PLAIN for label in inside]
        np.testing.assert_array_equal(colours, expected)
        first, second = int(inside[0]), int(outside[0])
        for pair in (f"{first},{second}", f"{second},{first}"):
            run("surface", "v.vtu", "--pair", pair, "-o", "pair.ply")
            some = (inside == first) & (outside == second)
            pair_corners = points_of(read("pair.ply"))[triangles_of(read("pair.ply"))]
            np.testing.assert_array_equal(pair_corners, corners[some])

    def test_sides_of_the_box(self):
        run("surface", "v.vtu", "--labels", 1, "-o", "one.ply")
        poly = read("one.ply")
        corners = points_of(poly)[triangles_of(poly)]
        on_side = ((corners == 0).all(axis=1) | (corners == 24).all(axis=1)).any(axis=1)
        self.assertTrue(on_side.any())
        run("surface", "v.vtu", "--labels", 1, "--open", "-o", "open.ply")
        opened = read("open.ply")
        np.testing.assert_array_equal(
            points_of(opened)[triangles_of(opened)], corners[~on_side]
        )

    def test_colours(self):
        run("surface", "v.vtu", "--labels", "1,2,3", "-o", "some.ply")
        poly = read("some.ply")
        points = vtk_to_numpy(poly.GetPointData().GetArray("RGB"))
        labels = meshio.read("some.ply").point_data["label"]
        np.testing.assert_array_equal(points, [NAMES[label][1] or PLAIN for label in labels])
        for label, expected in ((label, self.volumes[label]) for label in NAMES):
            mine = triangles_of(poly)[labels[triangles_of(poly)[:, 0]] == label]
            self.assertAlmostEqual(volume_of(points_of(poly), mine) / expected, 1, places=5)

    def test_manifold(self):
        for mesh in ("v", "noise"):
            facts = json.loads(run("info", mesh + ".vtu", "--json"))
            touching = 0
            for row in facts["volume"]["per_label"]:
                run("surface", mesh + ".vtu", "--labels", row["label"], "-o", "as_is.ply")
                touching += wrong_edges(read("as_is.ply"))
                out = "parted.ply"
                run("surface", mesh + ".vtu", "--labels", row["label"], "--manifold", "-o", out)
                poly = read(out)
                self.assertEqual(wrong_edges(poly), 0, (mesh, row["label"]))
                volume = volume_of(points_of(poly), triangles_of(poly))
                self.assertAlmostEqual(volume / row["volume"], 1, places=5)
        self.assertGreater(touching, 0)

    def test_stl_and_obj_are_manifold_by_default(self):
        """As VTK finds them once it has joined equal places, which is all that an STL has."""
        facts = json.loads(run("info", "noise.vtu", "--json"))
        touching = 0
        for row in facts["volume"]["per_label"]:
            what = ("surface", "noise.vtu", "--labels", row["label"])
            for out in ("one.stl", "one.obj"):
                last = run(*what, "-o", out).splitlines()[-1]
                poly = read(out)
                if out == "one.stl":
                    clean = vtkCleanPolyData()
                    clean.SetInputData(poly)
                    clean.Update()
                    poly = clean.GetOutput()
                self.assertEqual(wrong_edges(poly), 0, (out, row["label"]))
                volume = volume_of(points_of(poly), triangles_of(poly))
                self.assertLess(abs(volume / row["volume"] - 1), 0.012)
                told = re.fullmatch(
                    r"surface     closed, manifold, volume ([\d.]+), ([\d,]+) triangles", last)
                self.assertTrue(told, last)
                self.assertAlmostEqual(float(told[1]) / volume, 1, places=3)
                self.assertEqual(int(told[2].replace(",", "")), len(triangles_of(poly)))
            last = run(*what, "--no-manifold", "-o", "one.stl").splitlines()[-1]
            found = wrong_edges(read("one.stl"))
            touching += found
            self.assertEqual("not manifold" in last, found > 0 or "vert" in last, last)
        self.assertGreater(touching, 0)

    def test_the_summary_says_what_is_open_and_what_touches(self):
        last = run("surface", "v.vtu", "--labels", 1, "--open", "-o", "open.stl").splitlines()[-1]
        told = re.match(r"surface     open at (\d+) edges, manifold, \d+ triangles$", last)
        self.assertTrue(told, last)
        self.assertEqual(int(told[1]), wrong_edges(read("open.stl")))
        lines = run("surface", "v.vtu", "--labels", "1,2,3", "-o", "three.stl").splitlines()
        self.assertIn("--each", lines[-2])
        found = re.match(r"surface     closed, not manifold at (\d+) edges", lines[-1])
        self.assertTrue(found, lines)
        self.assertEqual(int(found[1]), wrong_edges(read("three.stl")))
        lines = run("surface", "v.vtu", "--labels", "1,2,3", "--each", "-o", "three").splitlines()
        self.assertTrue(lines[-2].startswith('surface     3 "Größe 漢字": closed, manifold, volume '))
        self.assertRegex(lines[-1], "surfaces    3, all closed, all manifold, volume .* triangles")

    def test_names_are_groups_of_an_obj_and_arrays_of_a_vtp(self):
        run("surface", "v.vtu", "--labels", "1,2,3", "-o", "some.obj")
        run("surface", "v.vtu", "--labels", "1,2,3", "-o", "some.vtp")
        run("surface", "v.vtu", "--labels", "1,2,3", "-o", "some.ply")
        with open("some.obj", encoding="utf-8") as file:
            groups = [line[2:-1] for line in file if line.startswith("g ")]
        self.assertEqual(groups, ["Left__big__one", "_grain____two", "Größe_漢字"])
        poly = read("some.vtp")
        labels, outside, side = (
            vtk_to_numpy(poly.GetCellData().GetArray(name)) for name in ("label", "label_out", "side"))
        corner = triangles_of(read("some.ply"))[:, 0]
        np.testing.assert_array_equal(labels, meshio.read("some.ply").point_data["label"][corner])
        blocks = meshio.read("some.obj").cells
        self.assertEqual([len(block.data) for block in blocks], [sum(labels == k) for k in NAMES])
        self.assertTrue(((outside > 0) == (side == 0)).all())
        self.assertTrue((outside != labels).all())
        fields = poly.GetFieldData()
        names = fields.GetAbstractArray("label_name")
        self.assertEqual([names.GetValue(i) for i in range(3)], [NAMES[k][0] for k in NAMES])
        np.testing.assert_array_equal(vtk_to_numpy(fields.GetArray("label_id")), list(NAMES))
        colours = vtk_to_numpy(poly.GetCellData().GetArray("colour"))
        np.testing.assert_array_equal(colours, [NAMES[k][1] or PLAIN for k in labels])

    def test_straight_from_a_volume(self):
        """Only the label asked for is meshed, and nothing else is left behind."""
        voxels = np.load("v.npy")
        os.mkdir("scratch")
        os.environ["TMPDIR"] = os.path.abspath("scratch")
        try:
            for label in (1, 2):
                lines = run("surface", "v.npy", "--names", "names.csv", "--labels", NAMES[label][0],
                            "-o", "direct.stl").splitlines()
                self.assertIn("all other labels taken for one", lines[0])
                self.assertTrue(lines[-1].startswith("surface     closed, manifold, volume "), lines)
                poly = read("direct.stl")
                self.assertEqual(wrong_edges(poly), 0)
                volume = volume_of(points_of(poly), triangles_of(poly))
                self.assertLess(abs(volume / (voxels == label).sum() - 1), 0.05)
                with open("direct.stl", "rb") as file:
                    self.assertEqual(file.read(80).startswith(b"mwmesh: binary STL; "), True)
            run("surface", "v.npy", "--labels", 1, "--size", 2, "-o", "fine.stl")
            run("surface", "v.npy", "--labels", 1, "--preset", "draft", "-o", "draft.stl")
            self.assertGreater(os.path.getsize("fine.stl"), os.path.getsize("draft.stl"))
            run("surface", "v.npy", "-o", "all.vtp")
            found = vtk_to_numpy(read("all.vtp").GetCellData().GetArray("label_out"))
            self.assertEqual(set(found), set(np.unique(voxels)[1:]))
        finally:
            del os.environ["TMPDIR"]
        self.assertEqual(os.listdir("scratch"), [])

    def test_each(self):
        run("surface", "v.vtu", "-o", "parts/{label}.stl")
        self.assertEqual(set(os.listdir("parts")), {f"{label}.stl" for label in self.volumes})
        run("surface", "v.vtu", "--each", "--format", "stl", "-o", "more")
        for label, expected in self.volumes.items():
            poly = read(f"parts/{label}.stl")
            volume = volume_of(points_of(poly), triangles_of(poly))
            self.assertAlmostEqual(volume / expected, 1, places=4)
            with open(f"parts/{label}.stl", "rb") as one, open(f"more/{label}.stl", "rb") as other:
                self.assertEqual(one.read(), other.read())

    def test_precomputed_knows_the_unit_of_the_mesh(self):
        """A mesh of a volume in mm gives surfaces in nm, unless the user knows better."""
        with open("mm.nrrd", "wb") as file:
            file.write(b"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n"
                       b"space dimension: 3\nspace units: \"mm\" \"mm\" \"mm\"\n"
                       b"space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n\n"
                       + bytes([1] * 32 + [2] * 32))
        run("mesh", "mm.nrrd", "-o", "mm.vtu")
        for unit, edge in ((), 4e6), (("--unit", "um"), 4e3):
            run("surface", "mm.vtu", *unit, "-o", "scaled", "--labels", "1")
            with open("scaled/1:0", encoding="utf-8") as file:
                (fragment,) = json.load(file)["fragments"]
            data = np.fromfile(f"scaled/{fragment}", np.uint8)
            points = data[4 : 4 + 12 * int(data[:4].view("<u4")[0])].view("<f4")
            self.assertAlmostEqual(float(points.max() - points.min()) / edge, 1, places=5)
            shutil.rmtree("scaled")

    def test_precomputed(self):
        run("surface", "v.vtu", "--unit", "um", "-o", "meshes")
        with open("meshes/info", encoding="utf-8") as file:
            info = json.load(file)
        self.assertEqual(info["@type"], "neuroglancer_legacy_mesh")
        for label, expected in self.volumes.items():
            with open(f"meshes/{label}:0", encoding="utf-8") as file:
                (fragment,) = json.load(file)["fragments"]
            data = np.fromfile(f"meshes/{fragment}", np.uint8)
            count = int(data[:4].view("<u4")[0])
            points = data[4 : 4 + 12 * count].view("<f4").reshape(-1, 3).astype(float)
            triangles = data[4 + 12 * count :].view("<u4").reshape(-1, 3)
            self.assertEqual(set(triangles.ravel()), set(range(count)))
            self.assertAlmostEqual(volume_of(points / 1000, triangles) / expected, 1, places=4)
        with open(f"meshes/{info['segment_properties']}/info", encoding="utf-8") as file:
            inline = json.load(file)["inline"]
        ids = [int(segment) for segment in inline["ids"]]
        found = {p["id"]: dict(zip(ids, p["values"])) for p in inline["properties"]}
        names = {label: NAMES[label][0] if label in NAMES else str(label) for label in self.volumes}
        self.assertEqual(found["label"], names)
        for label, expected in self.volumes.items():
            self.assertAlmostEqual(found["volume"][label] / expected, 1, places=9)


if __name__ == "__main__":
    unittest.main(verbosity=2)
