#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Overlapping masks: each is a group of its own in every format, beside the labels of its parts."""
import csv
import json
import os
import re
import sys
import tempfile
import unittest
import xml.etree.ElementTree

from program import enter_folder, run, start

try:
    import gmsh
    import h5py
    from reading_meshio import meshio
    import numpy as np
    import vtk
    from netCDF4 import Dataset
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SHAPE = (16, 14, 12)  # z, y, x
# The liver is a ring that only the tumour closes, so that neither "liver" nor "liver + tumour" has
# the topology of the mask by itself.
PARTS = {1: "Leber, links", 2: "tumour/x", 3: "vessel", 4: "Leber, links + tumour/x"}
LABELS_OF = {"Leber, links": [1, 4], "tumour/x": [2, 4], "vessel": [3]}

# Names where few characters are allowed.
PLAIN = {"Leber, links": "MASK_Leber_links", "tumour/x": "MASK_tumour_x", "vessel": "MASK_vessel"}


def save_mask(name, mask):
    z, y, x = mask.shape
    header = f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: {x} {y} {z}\nencoding: raw\n\n"
    with open(name, "wb") as file:
        file.write(header.encode() + mask.astype(np.uint8).tobytes())


def masks():
    z, y, x = np.indices(SHAPE)
    ring = (np.abs(z - 8) < 3) & (x > 1) & (x < 10) & (y > 1) & (y < 12)
    ring &= ~((x > 4) & (x < 7) & (y > 4) & (y < 9))
    tumour = (np.abs(z - 8) < 3) & (y > 8) & (x > 3) & (x < 8) & (y < 13)
    return {"Leber, links": ring, "tumour": tumour, "vessel": (z < 3) & (x > 3) & (x < 8) & (y > 4)}


def write_segmentation(path, layers, names=("Leber, links", "tumour/x", "vessel")):
    """A .seg.nrrd with a layer for each mask, as Slicer writes overlapping segments."""
    lines = ["NRRD0004", "type: uchar", "dimension: 4",
             f"sizes: {len(layers)} {SHAPE[2]} {SHAPE[1]} {SHAPE[0]}", "space dimension: 3",
             "space directions: none (1,0,0) (0,1,0) (0,0,1)", "kinds: list domain domain domain",
             "encoding: raw", "space origin: (0,0,0)"]
    for i, name in enumerate(names):
        lines += [f"Segment{i}_Name:={name}", f"Segment{i}_Layer:={i}", f"Segment{i}_LabelValue:=1",
                  f"Segment{i}_ID:=s{i}"]
    data = np.stack(list(layers), axis=-1).astype(np.uint8)
    with open(path, "wb") as file:
        file.write(("\n".join(lines) + "\n\n").encode() + data.tobytes())


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Masks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        write_segmentation("v.seg.nrrd", masks().values())
        cls.options = ("v.seg.nrrd", "--overlap", "all", "--threads", "2")
        run("mesh", *cls.options, "-o", "m.vtu")
        mesh = meshio.read("m.vtu")
        cls.labels = mesh.cell_data_dict["label"]["tetra"].ravel()
        # Grouped formats have tets by label.
        cls.sorted = np.sort(cls.labels, kind="stable")

    def wanted(self, labels):
        return {name: np.isin(labels, list(mine)) for name, mine in LABELS_OF.items()}

    def numbers(self, name):
        """The numbers from 1 on of the tets of a mask in a grouped format."""
        return (np.flatnonzero(np.isin(self.sorted, LABELS_OF[name])) + 1).tolist()

    def check_cells(self, arrays, labels):
        self.assertEqual(len(labels), len(self.labels))
        self.assertEqual({name for name in arrays if name.startswith("mask")},
                         {"mask_Leber, links", "mask_tumour_x", "mask_vessel"})
        for name, inside in self.wanted(labels).items():
            array = np.asarray(arrays["mask_" + name.replace("/", "_")]).ravel()
            self.assertEqual(array.dtype, np.uint8)
            np.testing.assert_array_equal(array, inside)

    def test_vtk_and_meshio_have_arrays(self):
        # What was read knows the masks, too.
        conversions = {"m.pvtu": ("m.vtkhdf", "--pieces", "3"), "two.vtu": ("m.pvtu",)}
        for name in ("m.vtu", "m.vtkhdf", "m.pvtu", "two.vtu"):
            if name in conversions:
                source, *options = conversions[name]
                run("convert", source, name, *options)
            else:
                run("mesh", *self.options, "-o", name)
            reader = {"vtu": vtk.vtkXMLUnstructuredGridReader, "vtkhdf": vtk.vtkHDFReader,
                      "pvtu": vtk.vtkXMLPUnstructuredGridReader}[name.split(".")[1]]()
            reader.SetFileName(name)
            reader.Update()
            data = reader.GetOutput().GetCellData()
            arrays = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))
                      for i in range(data.GetNumberOfArrays())}
            self.check_cells(arrays, arrays["label"])
        mesh = meshio.read("m.vtu")
        arrays = {name: rows[0] for name, rows in mesh.cell_data.items()}
        self.check_cells(arrays, arrays["label"])

    def test_xdmf_has_attributes(self):
        run("mesh", *self.options, "-o", "m.xdmf")
        tree = xml.etree.ElementTree.parse("m.xdmf")
        grid = tree.find("./Domain/Grid[@Name='mesh']")
        with h5py.File("m.h5") as file:
            arrays = {a.get("Name"): file[a.find("DataItem").text.split(":", 1)[1]][:]
                      for a in grid.findall("Attribute")}
        self.check_cells(arrays, arrays["label"])
        cells = meshio.read("m.cells.xdmf").cell_data
        self.assertEqual(sorted(cells),
                         ["label", "mask_Leber, links", "mask_tumour_x", "mask_vessel"])

    def test_gmsh_has_physical_volumes(self):
        for arguments in (("m.msh",), ("m.msh", "--ascii"), ("two.msh",)):
            if arguments[0] == "two.msh":
                run("convert", "m.msh", "two.msh")
            else:
                run("mesh", *self.options, "-o", *arguments)
            gmsh.initialize()
            try:
                gmsh.option.setNumber("General.Terminal", 0)
                gmsh.open(arguments[0])
                groups = {gmsh.model.getPhysicalName(3, tag):
                          gmsh.model.getEntitiesForPhysicalGroup(3, tag).tolist()
                          for _, tag in gmsh.model.getPhysicalGroups(3)}
            finally:
                gmsh.finalize()
            self.assertEqual(groups["mask_Leber, links"], [1, 4])
            self.assertEqual(groups["mask_tumour/x"], [2, 4])
            self.assertEqual(groups["mask_vessel"], [3])
            self.assertEqual([groups[name] for name in PARTS.values()], [[1], [2], [3], [4]])
            # meshio, which knows one group of a tet, has the labels.
            tags = meshio.read(arguments[0]).cell_data_dict["gmsh:physical"]["tetra"]
            self.assertLessEqual(set(PARTS), set(tags))
            self.assertEqual(len(tags), len(self.labels))

    def test_solver_formats_have_sets(self):
        for extension in ("inp", "exo", "cdb", "k", "feb"):
            run("mesh", *self.options, "-o", f"m.{extension}")
            for row in table(f"m.{extension}.labels.csv") if extension != "inp" else ():
                for name, mine in LABELS_OF.items():
                    self.assertEqual(int(row[f"mask_{name}"]), int(int(row["id"]) in mine))
        with open("m.inp", encoding="utf-8") as file:
            text = file.read()
        self.assertIn("*ELSET, ELSET=MASK_Leber_links\nLeber_links\nLeber_links_tumour_x\n", text)
        self.assertIn("*ELSET, ELSET=MASK_tumour_x\ntumour_x\nLeber_links_tumour_x\n", text)
        with Dataset("m.exo") as file:
            names = ["".join(c.decode() for c in row.compressed() if c)
                     for row in np.ma.array(file["els_names"][:])]
            self.assertEqual(names, list(PLAIN.values()))
            for i, name in enumerate(LABELS_OF, 1):
                self.assertEqual(file[f"elem_els{i}"][:].tolist(), self.numbers(name))
        with open("m.cdb", encoding="utf-8") as file:
            text = file.read()
        for name, plain in PLAIN.items():
            block = re.search(rf"CMBLOCK,{plain},ELEM, *\d+\n\(8i10\)\n([-\d \n]+)\n", text)
            items, tets = [int(word) for word in block.group(1).split()], []
            for item in items:
                tets += range(tets[-1] + 1, -item + 1) if item < 0 else [item]
            self.assertEqual(tets, self.numbers(name))
        with open("m.k", encoding="utf-8") as file:
            text = file.read()
        numbers = {row["name"]: int(row["number"]) for row in table("m.k.labels.csv")}
        for number, (name, plain) in enumerate(PLAIN.items(), 1):
            parts = "".join(f"{numbers[PARTS[label]]:10d}" for label in LABELS_OF[name])
            self.assertIn(f"*SET_PART_LIST_TITLE\n{plain}\n{number:10d}\n{parts}\n", text)
        sets = xml.etree.ElementTree.parse("m.feb").findall("./Mesh/ElementSet")
        self.assertEqual({s.get("name"): [int(n) for n in s.text.split(",")] for s in sets},
                         {f"mask_{name}": self.numbers(name) for name in LABELS_OF})

    def test_info_has_betti_numbers_of_unions(self):
        facts = json.loads(run("info", "m.vtu", "--betti", "--json"))
        rows = {row["name"]: row for row in facts["masks"]}
        self.assertEqual({name: row["labels"] for name, row in rows.items()}, LABELS_OF)
        per_label = {row["label"]: row for row in facts["volume"]["per_label"]}
        ring = rows["Leber, links"]
        self.assertEqual(ring["betti_closed"], [1, 1, 0])
        self.assertEqual(per_label[1]["betti_closed"], [1, 0, 0])  # the tumour cuts the ring
        self.assertEqual(per_label[4]["betti_closed"], [1, 0, 0])
        self.assertEqual(rows["tumour/x"]["betti_closed"], [1, 0, 0])
        for name, row in rows.items():
            self.assertEqual(row["tets"], sum(per_label[l]["tets"] for l in LABELS_OF[name]))
            self.assertAlmostEqual(row["volume"],
                                   sum(per_label[l]["volume"] for l in LABELS_OF[name]), 6)
        self.assertNotIn("betti_closed", json.loads(run("info", "m.vtu", "--json"))["masks"][0])
        volume = json.loads(run("info", *self.options[:3], "--json"))
        voxels = {name: int(mask.sum()) for name, mask in masks().items()}
        self.assertEqual(rows["vessel"]["betti_open"], per_label[3]["betti_open"])
        self.assertEqual({row["name"]: row["voxels"] for row in volume["masks"]},
                         {"Leber, links": voxels["Leber, links"], "tumour/x": voxels["tumour"],
                          "vessel": voxels["vessel"]})

    def test_masks_follow_what_is_chosen_and_merged(self):
        def told(*options):
            run("mesh", *self.options, *options, "-o", "c.vtu")
            facts = json.loads(run("info", "c.vtu", "--json"))
            return {row["name"]: row["labels"] for row in facts.get("masks", [])}

        self.assertEqual(told("--labels", "1,2"), {"Leber, links": [1], "tumour/x": [2]})
        self.assertEqual(told("--labels", "4"), {"Leber, links": [4], "tumour/x": [4]})
        # "tumour/x" would have all of the liver.
        self.assertEqual(told("--merge", "4=1"), {"vessel": [3], "Leber, links": [1]})
        self.assertEqual(told("--merge", "1,2,4=9"), {"vessel": [3]})
        self.assertEqual(told("--merge", "3=9"), LABELS_OF | {"vessel": [9]})
        self.assertEqual(told("--background", "0"), LABELS_OF)
        self.assertEqual(told("--object", "4"), {"Leber, links": [4], "tumour/x": [4]})

    def test_surfaces_are_of_what_has_a_name(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, mask in masks().items():
                save_mask(f"{folder}/{name.replace(',', '')}.nrrd", mask)
            said = run("surface", folder, "--overlap", "first", "-o", f"{folder}/{{name}}.stl",
                       "--each")
            self.assertIn("without label 0", said)
            self.assertEqual(sum(name.endswith(".stl") for name in os.listdir(folder)), 3)
            said = run("surface", folder, "--overlap", "first", "-o", f"{folder}/all.vtp")
        self.assertIn("note        interfaces of all labels are no closed surface: --labels", said)

    def test_thick_slices_name_their_axis(self):
        np.save("thick.npy", np.ones((6, 8, 8), np.uint8))
        for axis, spacing in zip("xyz", ("3,1,1", "1,3,1", "1,1,3")):
            said = run("mesh", "thick.npy", "-o", "thick.vtu", "--spacing", spacing)
            self.assertIn(f"slices along {axis} are 3 times as thick", said)

    def test_names_that_others_have(self):
        """A mask can be called as the group of another one, or have no letter that is allowed."""
        os.makedirs("named", exist_ok=True)
        for name, mask in zip(("liver", "mask_liver", "ä"), masks().values()):
            save_mask(f"named/{name}.nrrd", mask)
        run("mesh", "named", "--overlap", "all", "-o", "n.msh", "--ascii")
        with open("n.msh", encoding="utf-8") as file:
            names = re.findall(r'^3 \d+ "(.*)"$', file.read(), re.MULTILINE)
        self.assertEqual(sorted(names), sorted(set(names)))
        self.assertIn("mask_liver_", names)
        run("convert", "n.msh", "n.feb")
        names = [e.get("name") for e in xml.etree.ElementTree.parse("n.feb").find("Mesh")]
        self.assertEqual(sorted(names), sorted(set(names)))
        run("convert", "n.msh", "n.inp")
        with open("n.inp", encoding="utf-8") as file:
            self.assertIn("*ELSET, ELSET=MASK_3\n", file.read())
        # Names may be as long as any that are kept, and the same.
        write_segmentation("long.seg.nrrd", masks().values(), ["n" * 1000] * 3)
        run("mesh", "long.seg.nrrd", "--overlap", "all", "-o", "n.vtu")
        rows = json.loads(run("info", "n.vtu", "--json"))["masks"]
        self.assertEqual([row["name"] for row in rows], ["n" * 1000, "2", "3"])
        # The box of an object is that of all masks together, also where these are files.
        regions = json.loads(run("info", "named", "--overlap", "all", "--object", "2", "--json"))
        self.assertEqual([row["label"] for row in regions["labels"]["per_label"]], [0, 2])

    def test_without_a_label_for_each_set_there_are_none(self):
        run("mesh", *self.options[:1], "--overlap", "last", "-o", "l.vtu")
        self.assertNotIn("masks", json.loads(run("info", "l.vtu", "--json")))
        self.assertEqual(start("verify", "v.seg.nrrd", "m.vtu", *self.options[1:3]).returncode, 0)


if __name__ == "__main__":
    unittest.main()
