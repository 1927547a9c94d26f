#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes for solvers, and tets of ten nodes, read by meshio, VTK and Python's XML."""
import collections
import csv
import json
import pathlib
import re
import subprocess
import sys
import unittest
from xml.etree import ElementTree

from program import PROGRAM, enter_folder, run

try:
    from reading_meshio import meshio
    import numpy
    from netCDF4 import Dataset
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOExodus import vtkExodusIIReader
    from vtkmodules.vtkIOHDF import vtkHDFReader
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]


def set_ids(path, prefix):
    """Returns {name: id} of the side sets ("ss") or node sets ("ns") of an Exodus file."""
    with Dataset(path) as file:
        names = ["".join(c.decode() for c in row if c)
                 for row in numpy.ma.filled(file[prefix + "_names"][:], b"")]
        ids = file[prefix + "_prop1"][:].tolist()
    assert len(set(names)) == len(ids)
    return dict(zip(names, ids))


def volumes(points, tets):
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a) / 6


def canonical(points, tets, labels):
    """Tets by the positions of their corners, with their labels: whatever the order of rows."""
    corners = numpy.sort(points[tets[:, :4]].view("f8,f8,f8").reshape(len(tets), 4), axis=1)
    rows = [(*map(tuple, four.tolist()), int(label)) for four, label in zip(corners, labels)]
    return sorted(rows)


def numbers(path):
    with open(path, newline="", encoding="utf-8") as file:
        return {int(row["number"]): int(row["id"]) for row in csv.DictReader(file)}


class Solvers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        run("synth", "voronoi", "--shape", "16,14,12", "--labels", 8, "--seed", 1, "-o", "v.npy")
        with open("names.csv", "w", encoding="utf-8") as file:
            file.write('id,name\n1,"a <b> & ""c"""\n2,same\n3,other\n4,Größe\n')
        run("mesh", "v.npy", "-o", "m.vtu", "--spacing", "0.3,1,2.5")
        run("mesh", "v.npy", "-o", "named.mesh", "--names", "names.csv", "--spacing", "0.3,1,2.5")
        # A mesh of another program may have a name twice; a file of names may not.
        named = pathlib.Path("named.mesh")
        named.write_bytes(named.read_bytes().replace(b'"other"', b'"same"'))
        cls.digest = run("digest", "m.vtu")
        mesh = meshio.read("m.vtu")
        cls.points, cls.tets = mesh.points, mesh.cells[0].data
        cls.labels = mesh.cell_data["label"][0]
        cls.rows = canonical(cls.points, cls.tets, cls.labels)

    def convert(self, name, *options, source="m.vtu"):
        run("convert", source, name, *options)
        if name.endswith((".vtu", ".vtkhdf")):  # the others are written, not read
            self.assertEqual(run("digest", name), self.digest)

    def test_vtu_has_one_number_a_tet(self):
        self.assertEqual(self.labels.shape, (len(self.tets),))
        self.assertTrue((volumes(self.points, self.tets) > 0).all())

    def test_xdmf_in_meshio(self):
        self.convert("x.xdmf", source="named.mesh")
        mesh = meshio.read("x.cells.xdmf")
        self.assertEqual(mesh.cells[0].type, "tetra")
        self.assertEqual(mesh.cell_data["label"][0].shape, (len(self.tets),))
        self.assertEqual(
            canonical(mesh.points, mesh.cells[0].data, mesh.cell_data["label"][0]), self.rows
        )
        self.convert("x10.xdmf", "--element", "tet10")
        mesh = meshio.read("x10.cells.xdmf")
        self.assertEqual(mesh.cells[0].type, "tetra10")
        self.check_middles(mesh.points, mesh.cells[0].data)

    def test_feb(self):
        for element, nodes in (("tet4", 4), ("tet10", 10)):
            self.convert("f.feb", "--element", element, source="named.mesh")
            model = ElementTree.parse("f.feb").getroot()
            self.assertEqual(model.attrib["version"], "4.0")
            materials = {m.attrib["name"]: m.attrib["id"] for m in model.find("Material")}
            self.assertEqual(
                list(materials.values()), [str(i + 1) for i in range(len(materials))]
            )
            domains = {d.attrib["name"]: d.attrib["mat"] for d in model.find("MeshDomains")}
            points = [list(map(float, n.text.split(","))) for n in model.iterfind("Mesh/Nodes/node")]
            ids = numbers("f.feb.labels.csv")
            tets, labels = [], []
            for part in model.iterfind("Mesh/Elements"):
                self.assertEqual(part.attrib["type"], element)
                label = ids[int(materials[domains[part.attrib["name"]]])]
                for row in part:
                    tets.append([int(node) - 1 for node in row.text.split(",")])
                    labels.append(label)
            points, tets = numpy.array(points), numpy.array(tets)
            self.assertEqual(tets.shape[1], nodes)
            self.assertEqual(canonical(points, tets, labels), self.rows)
            self.assertIn('a <b> & "c"', domains)
            self.assertIn("same (2)", domains)
            if element == "tet10":
                self.check_middles(points, tets)
            self.check_surfaces(model, points, tets, labels, set(domains))

    def check_surfaces(self, model, points, tets, labels, parts):
        """Triangles between labels are in a surface of each side, turned, and those on the outside
        in one; no other is in any."""
        sides = {}
        for tet, label in zip(tets, labels):
            for left_out in range(4):
                key = frozenset(numpy.delete(tet[:4], left_out))
                sides.setdefault(key, []).append(label)
        wanted = {key: len(pair) for key, pair in sides.items()
                  if pair[0] != pair[-1] or len(pair) == 1}
        turns = {}
        lo, hi = points.min(axis=0), points.max(axis=0)
        for surface in model.iterfind("Mesh/Surface"):
            name = surface.attrib["name"]
            for row in surface:
                nodes = [int(node) - 1 for node in row.text.split(",")]
                self.assertEqual(row.tag, f"tri{len(nodes)}")
                first = nodes.index(min(nodes[:3]))
                turns.setdefault(frozenset(nodes[:3]), set()).add(nodes[(first + 1) % 3])
                for i in range(3, len(nodes)):
                    middle = (points[nodes[i - 3]] + points[nodes[(i - 2) % 3]]) / 2
                    numpy.testing.assert_allclose(points[nodes[i]], middle, rtol=1e-12, atol=1e-12)
                if "|" in name:
                    self.assertEqual(len(set(sides[frozenset(nodes[:3])])), 2)
                    self.assertLessEqual(set(name.split("|")), parts)
                else:
                    axis, end = "xyz".index(name[0]), {"min": lo, "max": hi}[name[2:]]
                    self.assertTrue((points[nodes][:, axis] == end[axis]).all())
        self.assertEqual({key: len(ways) for key, ways in turns.items()}, wanted)

    def check_middles(self, points, tets):
        """In VTK's order, and each edge has one."""
        by_edge = {}
        for i, (a, b) in enumerate(EDGES):
            middle = (points[tets[:, a]] + points[tets[:, b]]) / 2
            numpy.testing.assert_allclose(points[tets[:, 4 + i]], middle, rtol=1e-12, atol=1e-12)
            for one, other, row in zip(tets[:, a], tets[:, b], tets[:, 4 + i]):
                self.assertEqual(by_edge.setdefault(frozenset((one, other)), row), row)
        self.assertEqual(len(set(by_edge.values())), len(by_edge))

    def test_exodus_in_meshio_and_vtk(self):
        for options in ((), ("--element", "tet10")):
            run("convert", "named.mesh", "m.exo", *options)
            mesh = meshio.read("m.exo")
            kind = "tetra10" if options else "tetra"
            self.assertEqual({block.type for block in mesh.cells}, {kind})
            ids = numbers("m.exo.labels.csv")
            labels = [ids[n] for n in sorted(ids)]
            tets = [(block.data, label) for block, label in zip(mesh.cells, labels)]
            rows = []
            for data, label in tets:
                self.assertGreater(volumes(mesh.points, data).min(), 0)
                rows += canonical(mesh.points, data, [label] * len(data))
            wanted = meshio.read("m.vtu")
            self.assertEqual(
                sorted(rows),
                canonical(wanted.points, wanted.cells[0].data, wanted.cell_data["label"][0]))
            self.check_side_sets("m.exo")

    def test_exodus_has_one_id_for_a_name(self):
        """libMesh adds the nodes of a side set to the node set of the same id."""
        run("mesh", "v.npy", "-o", "one.vtu", "--labels", "1")
        run("mesh", "v.npy", "-o", "split.vtu", "--split", "*")
        for source in ("m.vtu", "named.mesh", "one.vtu", "split.vtu"):
            for element in ("tet4", "tet10"):
                run("convert", source, "ids.exo", "--element", element)
                sides, nodes = set_ids("ids.exo", "ss"), set_ids("ids.exo", "ns")
                self.assertEqual(len(set(sides.values())), len(sides))
                self.assertEqual(nodes, {name: sides[name] for name in nodes})
                pairs = sum(name.startswith("FACE_") for name in sides)
                self.assertEqual(pairs > 0, source != "one.vtu")
                self.assertEqual(len(sides) - len(nodes), 0 if source == "split.vtu" else pairs / 2)

    def check_side_sets(self, path):
        """VTK makes the triangles of sides itself; those of FACE_a_b and FACE_b_a are the same."""
        reader = vtkExodusIIReader()
        reader.SetFileName(path)
        reader.UpdateInformation()
        names = [reader.GetSideSetArrayName(i) for i in range(reader.GetNumberOfSideSetArrays())]
        for name in names:
            reader.SetSideSetArrayStatus(name, 1)
        reader.Update()
        sets = reader.GetOutput().GetBlock(4)
        found = {}
        for i, name in enumerate(names):
            block = sets.GetBlock(i)
            points = vtk_to_numpy(block.GetPoints().GetData()).astype(float)
            cells = []
            for c in range(block.GetNumberOfCells()):
                ids = block.GetCell(c).GetPointIds()
                cells.append([ids.GetId(k) for k in range(3)])
            corners = points[numpy.array(cells)]
            normal = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            faces = sorted(tuple(sorted(map(tuple, face.tolist()))) for face in corners)
            found[name] = faces, normal.sum(axis=0) / 2
        pairs = [name for name in found if name.startswith("FACE_")]
        self.assertGreaterEqual(len(pairs), 4)
        for first, second in zip(pairs[::2], pairs[1::2]):
            self.assertEqual(found[first][0], found[second][0])
            numpy.testing.assert_allclose(found[first][1], -found[second][1], atol=1e-6)
        low, high = found["X_MIN"][1], found["X_MAX"][1]
        self.assertLess(low[0], 0)
        numpy.testing.assert_allclose(low, -high, rtol=1e-6, atol=1e-4)  # VTK reads floats

    def test_gmsh_2_in_meshio(self):
        run("convert", "named.mesh", "m.msh2", "--element", "tet10")
        mesh = meshio.read("m.msh2", file_format="gmsh")
        self.assertEqual({block.type for block in mesh.cells}, {"triangle6", "tetra10"})
        self.assertEqual(run("digest", "m.msh2"), self.digest)

    def test_nastran_in_meshio(self):
        run("convert", "named.mesh", "m.bdf", "--element", "tet10")
        mesh = meshio.read("m.bdf")
        wanted = meshio.read("m.vtu")
        (block,) = mesh.cells
        self.assertEqual(block.type, "tetra10")
        self.assertEqual(len(block.data), len(wanted.cells[0].data))
        middles = (mesh.points[block.data[:, [0, 1, 2, 0, 1, 2]]]
                   + mesh.points[block.data[:, [1, 2, 0, 3, 3, 3]]]) / 2
        numpy.testing.assert_allclose(mesh.points[block.data[:, 4:]], middles, atol=1e-7)
        ids = numbers("m.bdf.labels.csv")
        sizes = collections.Counter(ids[n] for n in mesh.cell_data["nastran:ref"][0])
        self.assertEqual(sizes, collections.Counter(wanted.cell_data["label"][0].tolist()))

    def test_pressures_of_nastran_act_on_faces_of_interfaces_and_sides(self):
        run("convert", "named.mesh", "m.bdf")
        tets, sets, loads, name = {}, {}, collections.defaultdict(list), None
        for line in pathlib.Path("m.bdf").read_text().splitlines():
            fields = [line[i:i + 8].strip() for i in range(0, 72, 8)]
            if line.startswith("$ SET"):
                name = line.split()[-1]
                sets[name] = []
            elif line.startswith("$ PLOAD4"):
                number, name = int(line.split()[2][:-1]), line.split()[-1]
                self.assertEqual(number, len(loads) + 1)
            elif line.startswith("CEND") or line.startswith("BEGIN"):
                pass
            elif line.startswith(("SET ", "  ")):
                sets[name] += [int(n) for n in re.findall(r"\d+", line.split("=")[-1])]
            elif fields[0] == "CTETRA":
                tets[int(fields[1])] = [int(n) for n in fields[3:7]]
            elif fields[0] == "PLOAD4":
                self.assertEqual(fields[1:4:2] + fields[4:7], [str(number), "1.0", "", "", ""])
                corners = tets[int(fields[2])]
                on, off = int(fields[7]), int(fields[8])
                self.assertNotEqual(on, off)
                self.assertIn(on, corners)
                face = set(corners) - {off}
                self.assertEqual(len(face), 3)
                loads[name].append((int(fields[2]), face))
        self.assertGreater(len(loads), len(sets) + 1)
        for name, faces in loads.items():
            nodes = set().union(*(face for _, face in faces))
            other = "_".join(["FACE", *name.split("_")[:0:-1]])
            wanted = sets.get(name, sets.get(other))
            if wanted is not None:
                self.assertEqual(nodes, set(wanted), name)
            self.assertEqual(len({tuple(sorted(face)) for _, face in faces}), len(faces))
        pairs = [name for name in loads if name.startswith("FACE_")]
        for one, two in zip(pairs[::2], pairs[1::2]):
            self.assertEqual(sorted(sorted(face) for _, face in loads[one]),
                             sorted(sorted(face) for _, face in loads[two]))
            self.assertFalse({tet for tet, _ in loads[one]} & {tet for tet, _ in loads[two]})

    def test_ten_nodes_in_vtk(self):
        for name, reader in (
            ("q.vtu", vtkXMLUnstructuredGridReader()),
            ("q.vtkhdf", vtkHDFReader()),
        ):
            self.convert(name, "--element", "tet10")
            reader.SetFileName(name)
            reader.Update()
            grid = reader.GetOutput()
            types = {grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}
            self.assertEqual(types, {24})
            points = vtk_to_numpy(grid.GetPoints().GetData())
            tets = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 10)
            labels = vtk_to_numpy(grid.GetCellData().GetArray("label"))
            self.check_middles(points, tets)
            self.assertEqual(canonical(points, tets, labels), self.rows)
        mesh = meshio.read("q.vtu")
        self.assertEqual(mesh.cells[0].type, "tetra10")
        self.assertEqual(mesh.cell_data["label"][0].shape, (len(self.tets),))

    def test_mesh_writes_ten_nodes(self):
        run("mesh", "v.npy", "-o", "d.vtu", "--spacing", "0.3,1,2.5", "--element", "tet10")
        self.assertEqual(run("digest", "d.vtu"), self.digest)
        self.assertEqual(json.loads(run("info", "d.vtu", "--json"))["tets"], len(self.tets))
        run("verify", "v.npy", "d.vtu", "--spacing", "0.3,1,2.5")

    def test_inputs_are_not_written_over(self):
        with open("w.facets.csv", "w", encoding="utf-8") as file:
            file.write("id,name\n1,one\n")
        done = subprocess.run(
            [PROGRAM, "mesh", "v.npy", "-o", "w.xdmf", "--names", "w.facets.csv"],
            capture_output=True, text=True,
        )
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("-o w.facets.csv: name used twice, this is --names", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
