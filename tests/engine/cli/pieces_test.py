#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""VTK reads a mesh in pieces, whole or a share of them, and finds out which vertices are shared."""
import json
import sys
import unittest

from program import enter_folder, run

try:
    from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

PIECES = 6


def tets_of(grid, ids=None):
    """(rows, label) of each cell; ids: rows of the grid's points in the whole mesh."""
    labels = grid.GetCellData().GetArray("label")
    out = []
    for cell in range(grid.GetNumberOfCells()):
        points = grid.GetCell(cell).GetPointIds()
        rows = [points.GetId(i) for i in range(4)]
        out.append((tuple(int(ids.GetTuple1(r)) if ids else r for r in rows), labels.GetTuple1(cell)))
    return sorted(out)


class Pieces(unittest.TestCase):
    def setUp(self):
        enter_folder(self)
        run("synth", "voronoi", "--shape", "24,20,16", "--labels", "9", "--seed", "1", "-o", "v.npy")
        run("mesh", "v.npy", "-o", "whole.vtu")
        run("convert", "whole.vtu", "parts.pvtu", "--pieces", str(PIECES))
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName("whole.vtu")
        reader.Update()
        self.whole = reader.GetOutput()

    def read(self, piece, pieces):
        reader = vtkXMLPUnstructuredGridReader()
        reader.SetFileName("parts.pvtu")
        reader.UpdateInformation()
        reader.UpdatePiece(piece, pieces, 0)
        return reader.GetOutput()

    def test_all_together_are_the_mesh(self):
        grid = self.read(0, 1)
        ids = grid.GetPointData().GetGlobalIds()
        self.assertEqual(tets_of(grid, ids), tets_of(self.whole))

    def test_shared_vertices_have_one_id_and_one_place(self):
        seen, tets = {}, []
        for piece in range(PIECES):
            grid = self.read(piece, PIECES)
            ids = grid.GetPointData().GetGlobalIds()
            self.assertEqual(ids.GetName(), "GlobalNodeIds")
            for point in range(grid.GetNumberOfPoints()):
                row = int(ids.GetTuple1(point))
                self.assertEqual(grid.GetPoint(point), self.whole.GetPoint(row))
                seen[row] = seen.get(row, 0) + 1
            tets += tets_of(grid, ids)
        self.assertEqual(len(seen), self.whole.GetNumberOfPoints())
        self.assertGreater(max(seen.values()), 1)
        self.assertEqual(sorted(tets), tets_of(self.whole))

    def test_they_are_read_as_the_mesh(self):
        self.assertEqual(run("digest", "parts.pvtu"), run("digest", "whole.vtu"))
        self.assertIn("all checks hold", run("verify", "v.npy", "parts.pvtu"))
        facts = [json.loads(run("info", m, "--json")) for m in ("parts.pvtu", "whole.vtu")]
        for key in ("vertices", "tets", "labels", "box", "digest"):
            self.assertEqual(facts[0][key], facts[1][key])
        run("convert", "parts.pvtu", "again.vtkhdf")
        self.assertEqual(run("digest", "again.vtkhdf"), run("digest", "whole.vtu"))


if __name__ == "__main__":
    unittest.main()
