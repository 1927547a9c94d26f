#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""dolfinx solves heat conduction on our .xdmf: materials by label, temperatures by facet tag.

Layers across x with a conductivity each, temperatures on x_min and x_max, the other sides
insulated: the temperature is linear in each layer, the flux the same in all.
"""
import csv
import itertools
import sys
import unittest

from program import enter_folder, run

try:
    import dolfinx
    import numpy
    import ufl
    from dolfinx import fem
    from dolfinx.fem.petsc import LinearProblem
    from dolfinx.io import XDMFFile
    from mpi4py import MPI
    from petsc4py.PETSc import ScalarType
except Exception as missing:  # an MPI that does not start is no ImportError
    print(f"skipped: {missing}")
    sys.exit(77)

SHAPE = (12, 8, 6)  # x, y, z
SPACING = (0.5, 1.0, 1.25)
ENDS = [5, 8, 12]  # of the layers, voxels
LABELS = [7, 2**40 + 1, 3]
CONDUCTIVITY = {7: 1.0, 2**40 + 1: 10.0, 3: 0.25}
HOT, COLD = 300.0, 100.0


def layers():
    labels = numpy.empty(SHAPE[::-1], dtype=numpy.uint64)
    for begin, end, label in zip([0, *ENDS], ENDS, LABELS):
        labels[:, :, begin:end] = label
    return labels


def write_grid(path):
    """Each voxel as six tets, so that interfaces are where the layers end exactly."""
    count = numpy.array(SHAPE) + 1
    row = numpy.arange(numpy.prod(count)).reshape(count[::-1])
    z, y, x = numpy.meshgrid(*map(numpy.arange, count[::-1]), indexing="ij")
    points = numpy.stack([x, y, z], axis=-1).reshape(-1, 3) * SPACING
    tets = []
    for way in itertools.permutations(range(3)):  # from one end of a voxel's diagonal to the other
        at, corners = [0, 0, 0], []
        for axis in (*way, None):
            corners.append(row[tuple(slice(a, a - 1 or None) for a in at)].ravel())
            if axis is not None:
                at[axis] = 1
        tets.append(numpy.stack(corners, axis=-1))
    labels = numpy.tile(layers().ravel(), 6)
    with open(path, "w", encoding="ascii") as file:
        file.write(f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(points)}\n")
        file.writelines(f"{x} {y} {z} 0\n" for x, y, z in points.tolist())
        file.write(f"Tetrahedra\n{len(labels)}\n")
        for four, label in zip(numpy.concatenate(tets) + 1, labels.tolist()):
            file.write(f"{four[0]} {four[1]} {four[2]} {four[3]} {label}\n")
        file.write("End\n")


def exact(x):
    """Temperatures at places, from the resistances of the layers."""
    ends = numpy.array([0, *ENDS]) * SPACING[0]
    resistance = numpy.diff(ends) / [CONDUCTIVITY[label] for label in LABELS]
    at_ends = HOT - (HOT - COLD) * numpy.array([0, *numpy.cumsum(resistance)]) / sum(resistance)
    return numpy.interp(x[0], ends, at_ends)


class Dolfinx(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        write_grid("grid.mesh")
        run("convert", "grid.mesh", "tet4.xdmf")
        run("convert", "grid.mesh", "tet10.xdmf", "--element", "tet10")
        numpy.save("v.npy", layers())
        spacing = ",".join(map(str, SPACING))
        run("mesh", "v.npy", "-o", "meshed.xdmf", "--spacing", spacing)

    @staticmethod
    def read(stem):
        """Mesh, tags of cells and facets, label to number, name of facets to number."""
        with XDMFFile(MPI.COMM_WORLD, f"{stem}.xdmf", "r") as file:
            mesh = file.read_mesh(name="mesh")
            cells = file.read_meshtags(mesh, name="cell_tags")
            mesh.topology.create_connectivity(2, 3)
            facets = file.read_meshtags(mesh, name="facet_tags")
        with open(f"{stem}.xdmf.labels.csv", newline="", encoding="utf-8") as file:
            labels = {int(row["id"]): int(row["number"]) for row in csv.DictReader(file)}
        with open(f"{stem}.facets.csv", newline="", encoding="utf-8") as file:
            names = {row["name"]: int(row["number"]) for row in csv.DictReader(file)}
        return mesh, cells, facets, labels, names

    def test_volumes_and_areas(self):
        size = numpy.array(SHAPE) * SPACING
        # Smooth interfaces keep the volumes of labels to within some thousandths.
        for stem, delta in (("tet4", 1e-9), ("tet10", 1e-9), ("meshed", 5e-3)):
            mesh, cells, facets, labels, names = self.read(stem)
            self.assertEqual(set(labels), set(LABELS))
            dx = ufl.Measure("dx", mesh, subdomain_data=cells)
            one = fem.Constant(mesh, ScalarType(1))
            for begin, end, label in zip([0, *ENDS], ENDS, LABELS):
                volume = fem.assemble_scalar(fem.form(one * dx(labels[label])))
                expected = (end - begin) * SPACING[0] * size[1] * size[2]
                self.assertAlmostEqual(volume / expected, 1, delta=delta)
            ds = ufl.Measure("ds", mesh, subdomain_data=facets)
            for axis, letter in enumerate("xyz"):
                for end in ("min", "max"):
                    area = fem.assemble_scalar(fem.form(one * ds(names[f"{letter}_{end}"])))
                    self.assertAlmostEqual(area / (numpy.prod(size) / size[axis]), 1, delta=delta)
            dS = ufl.Measure("dS", mesh, subdomain_data=facets)
            for pair in ((3, 2**40 + 1), (7, 2**40 + 1)):
                tag = names[f"label_{pair[0]}|label_{pair[1]}"]
                area = fem.assemble_scalar(fem.form(one("+") * dS(tag)))
                self.assertAlmostEqual(area / (size[1] * size[2]), 1, delta=delta)

    def solve(self, stem, degree):
        mesh, cells, facets, labels, names = self.read(stem)
        piecewise = fem.FunctionSpace(mesh, ("DG", 0))
        conductivity = fem.Function(piecewise)
        for label, value in CONDUCTIVITY.items():
            where = cells.indices[cells.values == labels[label]]
            conductivity.x.array[where] = value
        space = fem.FunctionSpace(mesh, ("CG", degree))
        fixed = []
        for name, value in (("x_min", HOT), ("x_max", COLD)):
            at = facets.indices[facets.values == names[name]]
            dofs = fem.locate_dofs_topological(space, 2, at)
            fixed.append(fem.dirichletbc(ScalarType(value), dofs, space))
        u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
        a = conductivity * ufl.dot(ufl.grad(u), ufl.grad(v)) * ufl.dx
        right = fem.Constant(mesh, ScalarType(0)) * v * ufl.dx
        options = {"ksp_type": "preonly", "pc_type": "lu"}
        solution = LinearProblem(a, right, bcs=fixed, petsc_options=options).solve()
        expected = fem.Function(space)
        expected.interpolate(exact)
        return numpy.abs(solution.x.array - expected.x.array).max()

    def test_heat(self):
        for stem, most in (("tet4", 1e-9), ("tet10", 1e-9), ("meshed", 1e-2)):
            for degree in (1, 2):
                worst = self.solve(stem, degree)
                print(f"{stem}, degree {degree}: off by {worst:.2e} K of {HOT - COLD:g}")
                self.assertLess(worst, most * (HOT - COLD))


if __name__ == "__main__":
    unittest.main(verbosity=2)
