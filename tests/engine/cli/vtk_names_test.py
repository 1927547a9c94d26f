#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""VTK sees the names of labels in our files, and we see them in files that VTK has written."""
import csv
import json
import sys
import unittest

from program import enter_folder, run

try:
    from vtkmodules.vtkCommonCore import vtkStringArray
    from vtkmodules.vtkIOHDF import vtkHDFReader
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

NAMES = {
    1: ('Left "big" one', (255, 0, 10, 255)),
    2: ("<grain> & 'grain'; ]]>", (1, 2, 3, 128)),
    3: ("Größe 漢字 \U0001f9e0", None),
    4: ("", (9, 8, 7, 6)),
    99: ("not in the volume", (1, 1, 1, 1)),
}


def grid_of(reader, path):
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def names_in(grid):
    """Label to (name, colour) from the field data."""
    fields = grid.GetFieldData()
    ids, names, colours = (
        fields.GetAbstractArray(key) for key in ("label_id", "label_name", "label_colour")
    )
    if not names.IsA("vtkStringArray"):  # a .vtu of ours: bytes, a NUL behind each name
        parts = bytes(int(names.GetTuple1(i)) for i in range(names.GetNumberOfTuples())).split(b"\0")
        names = vtkStringArray()
        for part in parts[:-1]:
            names.InsertNextValue(part.decode())
    rows = {}
    for i in range(ids.GetNumberOfTuples()):
        colour = tuple(int(part) for part in colours.GetTuple(i))
        rows[int(ids.GetTuple1(i))] = (names.GetValue(i), colour if any(colour) else None)
    return rows


class VtkNames(unittest.TestCase):
    def setUp(self):
        enter_folder(self)
        run("synth", "voronoi", "--shape", "12,12,12", "--labels", "12", "--seed", "1", "-o", "v.npy")
        with open("names.csv", "w", newline="", encoding="utf-8") as file:
            table = csv.writer(file)
            table.writerow(["id", "name", "r", "g", "b", "a"])
            for label, (name, colour) in NAMES.items():
                table.writerow([label, name, *(colour or ("", "", "", ""))])
        self.labels = {row["label"] for row in self.info("v.npy")["labels"]["per_label"]}
        self.expected = {label: row for label, row in NAMES.items() if label in self.labels}
        self.assertGreaterEqual(len(self.expected), 4)

    def info(self, path):
        return json.loads(run("info", path, "--json"))

    def names_by_info(self, path):
        rows = self.info(path)["volume"]["per_label"]
        self.assertEqual({row["label"] for row in rows}, self.labels)
        return {
            row["label"]: (row.get("name", ""), tuple(row["colour"]) if "colour" in row else None)
            for row in rows
            if "name" in row or "colour" in row
        }

    def mesh(self, path):
        run("mesh", "v.npy", "-o", path, "--names", "names.csv")

    def test_vtk_reads_ours(self):
        for path, reader in (("v.vtu", vtkXMLUnstructuredGridReader()), ("v.vtkhdf", vtkHDFReader())):
            with self.subTest(path):
                self.mesh(path)
                grid = grid_of(reader, path)
                self.assertEqual(grid.GetNumberOfCells(), self.info(path)["tets"])
                self.assertEqual(names_in(grid), self.expected)
                self.assertEqual(self.names_by_info(path), self.expected)

    def test_we_read_vtks(self):
        self.mesh("v.vtu")
        grid = grid_of(vtkXMLUnstructuredGridReader(), "v.vtu")
        digest = run("digest", "v.vtu")
        for mode in ("Ascii", "Binary", "Appended"):
            for packed in (False, True):
                for encoded in (False, True):
                    with self.subTest(mode=mode, packed=packed, encoded=encoded):
                        writer = vtkXMLUnstructuredGridWriter()
                        getattr(writer, f"SetDataModeTo{mode}")()
                        writer.SetEncodeAppendedData(encoded)
                        if packed:
                            writer.SetCompressorTypeToZLib()
                        else:
                            writer.SetCompressorTypeToNone()
                        writer.SetFileName("vtk.vtu")
                        writer.SetInputData(grid)
                        self.assertEqual(writer.Write(), 1)
                        self.assertEqual(self.names_by_info("vtk.vtu"), self.expected)
                        if mode != "Ascii":  # which rounds coordinates
                            self.assertEqual(run("digest", "vtk.vtu"), digest)


if __name__ == "__main__":
    unittest.main(verbosity=2)
