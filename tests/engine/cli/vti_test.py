#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Images that VTK writes: every encoding, packing and type, points and cells, turned ones, and what
is wrong."""
import gzip
import itertools
import pathlib
import sys
import unittest

from program import run
from stores import TYPES, Stores, distinct, name_of, numpy, pick_shape, write

try:
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SPACING = (1.25, 1.0, 1.5)
ORIGIN = (-20.5, 7.25, 100.0)
TURN = (0, 0, -1, 1, 0, 0, 0, -1, 0)  # rows; a rotation
MODES = {"ascii": {"DataMode": 0}, "base64": {"DataMode": 1},
         "appended": {"DataMode": 2, "EncodeAppendedData": 1},
         "raw": {"DataMode": 2, "EncodeAppendedData": 0}}


def image_of(points, direction=None, extent=None):
    image = vtk.vtkImageData()
    if extent is None:
        image.SetDimensions(points)
    else:
        image.SetExtent(extent)
    image.SetSpacing(SPACING)
    image.SetOrigin(ORIGIN)
    if direction is not None:
        image.SetDirectionMatrix(direction)
    return image


def array_of(name, labels):
    array = numpy_to_vtk(numpy.ascontiguousarray(labels).ravel(), deep=True)
    array.SetName(name)
    return array


def save(path, image, packing="None", **settings):
    writer = vtk.vtkXMLImageDataWriter()
    writer.SetInputData(image)
    writer.SetFileName(path)
    getattr(writer, "SetCompressorTypeTo" + packing)()
    for name, value in settings.items():
        getattr(writer, "Set" + name)(value)
    assert writer.Write() == 1


def points_of(labels, **others):
    image = image_of(labels.shape[::-1], **others)
    image.GetPointData().AddArray(array_of("label", labels))
    return image


def cells_of(labels, **others):
    image = image_of([n + 1 for n in labels.shape[::-1]], **others)
    image.GetCellData().AddArray(array_of("label", labels))
    return image


class Vti(Stores):
    def test_every_encoding_packing_and_type(self):
        kinds = itertools.cycle(TYPES)
        for mode, packing, word, big in itertools.product(
                MODES, ("None", "ZLib", "LZ4", "LZMA"), (32, 64), (0, 1)):
            labels = distinct(self.random, pick_shape(self.random, 6), next(kinds))
            save("a.vti", cells_of(labels), packing, HeaderType=word, ByteOrder=big, BlockSize=64,
                 **MODES[mode])
            with self.subTest(mode=mode, packing=packing, word=word, big=big):
                self.check("a.vti", labels, format="vti", type=name_of(labels.dtype),
                           spacing=SPACING, origin=ORIGIN)

    def test_points_are_centres_and_cells_have_corners(self):
        labels = distinct(self.random, (3, 4, 5), "u1")
        corner = tuple(o - s / 2 for o, s in zip(ORIGIN, SPACING))
        for mode in MODES.values():
            save("p.vti", points_of(labels), **mode)
            self.check("p.vti", labels, origin=corner)
        write("z.vti.gz", gzip.compress(pathlib.Path("p.vti").read_bytes()))
        self.check("z.vti.gz", labels, origin=corner)
        # An extent that begins elsewhere moves the first point.
        image = points_of(labels, extent=(3, 7, -2, 1, 10, 12))
        save("e.vti", image)
        self.check("e.vti", labels, origin=tuple(image.GetPoint(0) - numpy.array(SPACING) / 2))
        plane = distinct(self.random, (1, 4, 5), "u1")
        image = image_of((6, 5, 1))
        image.GetCellData().AddArray(array_of("label", plane))
        save("plane.vti", image)
        self.check("plane.vti", plane, origin=ORIGIN)

    def test_turned_images_lie_where_vtk_says(self):
        x, y, z = numpy.indices((9, 8, 7))
        labels = ((x > 3) + 2 * (y > 4) + 4 * (z > 2)).astype("u1").transpose(2, 1, 0)
        numpy.save("a.npy", labels)
        run("mesh", "a.npy", "--spacing", ",".join(map(str, SPACING)), "-o", "plain.vtu")
        for direction, build in itertools.product((None, TURN, [-x for x in TURN]),
                                                  (points_of, cells_of)):
            image = build(labels, direction=direction)
            save("a.vti", image)
            run("mesh", "a.vti", "-o", "a.vtu")
            plain, turned = (self.points(name) for name in ("plain.vtu", "a.vtu"))
            shift = 0.5 if build is points_of else 0.0
            self.assertEqual(len(plain), len(turned))
            for before, after in zip(plain / SPACING, turned):
                place = [0.0] * 3
                image.TransformContinuousIndexToPhysicalPoint(*(before - shift), place)
                numpy.testing.assert_allclose(after, place, atol=1e-9)

    def points(self, path):
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(path)
        reader.Update()
        points = reader.GetOutput().GetPoints()
        return numpy.array([points.GetPoint(i) for i in range(points.GetNumberOfPoints())])

    def test_one_array_of_several(self):
        labels = distinct(self.random, (3, 4, 5), "u2")
        image = cells_of(labels)
        image.GetCellData().AddArray(array_of("grey", labels.astype("f4") / 7))
        ghosts = array_of("vtkGhostType", numpy.zeros(60, "u1"))
        image.GetCellData().AddArray(ghosts)
        colour = numpy_to_vtk(numpy.zeros((60, 3), "u1"), deep=True)
        colour.SetName("colour")
        image.GetCellData().AddArray(colour)
        save("a.vti", image)
        self.check("a.vti", labels)
        self.refuse(["not a whole number"], "a.vti", "--dataset", "grey")
        image.GetCellData().AddArray(array_of("id", labels // 2))
        image.GetPointData().AddArray(array_of("id", numpy.zeros(120, "u1")))
        save("a.vti", image)
        self.refuse(["several arrays: PointData/id, CellData/label, CellData/id", "--dataset"],
                    "a.vti")
        self.check("a.vti", labels, "--dataset", "label")
        self.check("a.vti", labels, "--dataset", "CellData/label")
        self.refuse(["several", "PointData/id"], "a.vti", "--dataset", "id", code=2)
        self.refuse(["none", "CellData/label"], "a.vti", "--dataset", "none", code=2)
        self.refuse("colour", "a.vti", "--dataset", "colour", code=2)
        only = image_of((6, 5, 4))
        only.GetCellData().AddArray(array_of("whole", labels.astype("f8")))
        save("f.vti", only)
        self.check("f.vti", labels, type="f64")

    def test_what_is_wrong_is_named(self):
        labels = distinct(self.random, (3, 4, 5), "u1")
        save("a.vti", cells_of(labels), **MODES["ascii"])
        content = pathlib.Path("a.vti").read_text()
        for old, new, *words in (
                ('WholeExtent="0 5', 'WholeExtent="0 x', "WholeExtent"),
                ('WholeExtent="0 5', 'WholeExtent="0 6', "several pieces"),
                ('Spacing="1.25', 'Spacing="', "Spacing", "3 numbers"),
                ('Spacing="1.25', 'Spacing="nan', "Spacing"),
                ('type="UInt8"', 'type="Int8"', "CellData/label", "is no i8"),
                ('"ascii"', '"appended"', "no appended data"),
                ('"ImageData"', '"RectilinearGrid"', "VTKFile type", "image"),
                ("</Piece>", "", "XML at offset"), ('Name="label"', 'Name="vtkX"', "PointData")):
            self.assertIn(old, content)
            write("b.vti", content.replace(old, new))
            self.refuse(words, "b.vti")
        words = content[content.index("<DataArray"):].split()
        write("c.vti", content.replace(" " + words[-12], "", 1))
        self.refuse(["59 numbers", "60"], "c.vti")
        image = vtk.vtkImageData()
        image.SetDimensions(3, 3, 3)
        save("e.vti", image)
        self.refuse("no array has one number", "e.vti")
        for mode, packing in itertools.product(("base64", "appended", "raw"), ("None", "ZLib")):
            save("d.vti", cells_of(labels), packing, **MODES[mode])
            content = pathlib.Path("d.vti").read_bytes()
            for cut in range(0, len(content) - 40, 29):
                write("d.vti", content[:cut])
                self.refuse("d.vti", "d.vti")


if __name__ == "__main__":
    unittest.main()
