# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Effective tensors of cells that repeat themselves, from CalculiX, against what theory gives."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: no numpy")
    sys.exit(77)

import mwmesh

RATIO = 0.3
MODULI = {1: 1.0, 2: 10.0}


def isotropic(modulus):
    shear = modulus / (2 * (1 + RATIO))
    lame = modulus * RATIO / ((1 + RATIO) * (1 - 2 * RATIO))
    out = np.diag([2 * shear] * 3 + [shear] * 3)
    out[:3, :3] += lame
    return out


def laminate(phases, normal):
    """The stiffness of layers, (share, stiffness) each, across axis `normal` (Backus; Milton, sec. 9.5)."""
    order = [0, 1, 2, 3, 4, 5]
    across = [normal, *(k for k in (3, 4, 5) if k != normal + 3)]
    along = [k for k in order if k not in across]
    inverse = sum(f * np.linalg.inv(c[np.ix_(across, across)]) for f, c in phases)
    outer = np.linalg.inv(inverse)
    mixed = sum(f * np.linalg.solve(c[np.ix_(across, across)], c[np.ix_(across, along)]) for f, c in phases)
    rest = sum(f * (c[np.ix_(along, along)] - c[np.ix_(along, across)] @ np.linalg.solve(
        c[np.ix_(across, across)], c[np.ix_(across, along)])) for f, c in phases)
    out = np.zeros((6, 6))
    out[np.ix_(across, across)] = outer
    out[np.ix_(across, along)] = outer @ mixed
    out[np.ix_(along, across)] = out[np.ix_(across, along)].T
    out[np.ix_(along, along)] = rest + mixed.T @ outer @ mixed
    return out


def fibres(voxels, radius):
    """Fibres of label 2 along x, in a square array."""
    place = np.arange(voxels) + 0.5 - voxels / 2
    inside = place[:, None] ** 2 + place[None, :] ** 2 < radius**2
    return np.repeat(np.where(inside, 2, 1).astype(np.uint8)[:, :, None], voxels, 2)


@unittest.skipUnless(shutil.which("ccx"), "no CalculiX")
class Homogenise(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def solved(self, labels, deck, values, **options):
        """The tensor of a cell whose label l has values[l], a modulus or a conductivity."""
        job = os.path.join(self.folder, "cell.inp")
        mwmesh.mesh_to_file(labels, job, periodic="xyz", deck=deck, **options)
        with open(job, encoding="ascii") as file:
            text = file.read()
        for label, value in values.items():
            for card, before in (("ELASTIC", "1000, 0.3"), ("CONDUCTIVITY", "1.")):
                text = text.replace(f"NAME=LABEL_{label}\n*{card}\n{before}",
                                    f"NAME=LABEL_{label}\n*{card}\n{value}" + ", 0.3" * (card == "ELASTIC"))
        with open(job, "w", encoding="ascii") as file:
            file.write(text)
        done = subprocess.run(["ccx", "cell"], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout[-500:])
        return mwmesh.homogenise(job)

    def test_a_laminate_is_exact(self):
        labels = np.ones((8, 12, 8), np.uint8)
        labels[:, 5:9] = 2
        phases = [(2 / 3, isotropic(MODULI[1])), (1 / 3, isotropic(MODULI[2]))]
        wanted = laminate(phases, 1)
        for element in ("tet4", "tet10"):
            with self.subTest(element):
                found = self.solved(labels, "periodic", MODULI, element=element)
                np.testing.assert_allclose(found, wanted, rtol=1e-4, atol=1e-4)

    def test_conduction_of_a_laminate_is_exact(self):
        labels = np.ones((8, 8, 12), np.uint8)
        labels[:, :, 2:6] = 2
        series = 1 / (2 / 3 / 1 + 1 / 3 / 10)
        found = self.solved(labels, "conduction", MODULI)
        np.testing.assert_allclose(found, np.diag([series, 4, 4]), rtol=1e-4, atol=1e-4)

    def test_fibres_have_the_symmetry_of_their_array(self):
        found = self.solved(fibres(24, 7.5), "periodic", MODULI, element="tet10")
        np.testing.assert_allclose(found, found.T, atol=1e-4 * found.max())
        for a, b in (((1, 1), (2, 2)), ((0, 1), (0, 2)), ((4, 4), (5, 5))):
            self.assertLess(abs(found[a] / found[b] - 1), 0.003, (a, b))
        coupled = found.copy()
        coupled[:3, :3] = 0
        np.fill_diagonal(coupled, 0)
        self.assertLess(abs(coupled).max(), 0.003 * found.max())
        share = (fibres(24, 7.5) == 2).mean()
        voigt = (1 - share) * isotropic(1.0) + share * isotropic(10.0)
        self.assertGreater(np.linalg.eigvalsh(voigt - found).min(), -1e-6)

    def test_pores_count_as_empty(self):
        labels = np.ones((16, 16, 16), np.uint8)
        labels[4:12, 4:12, 4:12] = 2
        whole = self.solved(labels, "conduction", {1: 1.0, 2: 1.0})
        np.testing.assert_allclose(whole, np.eye(3), atol=1e-4)
        porous = self.solved(labels, "conduction", {1: 1.0}, background=2)
        self.assertLess(porous.max(), 1 - (labels == 2).mean())

    def test_what_is_missing_is_said(self):
        job = os.path.join(self.folder, "cell.inp")
        labels = np.ones((4, 4, 4), np.uint8)
        with self.assertRaisesRegex(mwmesh.InputError, "cannot open"):
            mwmesh.homogenise(job)
        mwmesh.mesh_to_file(labels, job, periodic="xyz", deck="periodic")
        with self.assertRaisesRegex(mwmesh.InputError, "run CalculiX on the job first"):
            mwmesh.homogenise(job)
        with open(os.path.join(self.folder, "cell.dat"), "w", encoding="ascii") as file:
            file.write(" stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz) for set CELL\n")
        with self.assertRaisesRegex(mwmesh.InputError, "has not a line for each"):
            mwmesh.homogenise(job)
        mwmesh.mesh_to_file(labels, job, deck="static")
        with self.assertRaisesRegex(mwmesh.InputError, "is not a job"):
            mwmesh.homogenise(job)
        for options in ({}, {"periodic": "xy"}):
            with self.assertRaisesRegex(mwmesh.UsageError, "periodic xyz"):
                mwmesh.mesh_to_file(labels, job, deck="periodic", **options)
        with self.assertRaisesRegex(mwmesh.UsageError, "no such job is written in .feb"):
            mwmesh.mesh_to_file(labels, job[:-3] + "feb", deck="periodic", periodic="xyz")


if __name__ == "__main__":
    unittest.main()
