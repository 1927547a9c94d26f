#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""VTK, meshio and numpy read the surfaces of `mwmesh surface`, and find them whole."""
import json
import os
import shutil
import sys
import unittest

from program import enter_folder, run

try:
    from reading_meshio import meshio
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersCore import vtkFeatureEdges
    from vtkmodules.vtkIOGeometry import vtkSTLReader
    from vtkmodules.vtkIOPLY import vtkPLYReader
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

READERS = {
    ".stl": vtkSTLReader,
    ".ply": vtkPLYReader,
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
            for extension in (".stl", ".ply"):
                run("surface", "v.vtu", "--labels", label, "-o", "one" + extension)
                poly = read("one" + extension)
                found = points_of(poly)[triangles_of(poly)]
                np.testing.assert_allclose(found, corners, atol=1e-5, err_msg=extension)
                mesh = meshio.read("one" + extension)
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
