#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes of probabilities and signed distances (--values), from files that numpy and nibabel write,
against the shapes that the values tell of."""
import json
import sys
import unittest

from program import enter_folder, refused, run

try:
    from reading_meshio import meshio
    import nibabel
    import numpy as np
    from tet_mesh import Mesh
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

EDGE = 24
CENTRE = np.array([12.3, 11.8, 12.1])
RADIUS = 6.0


def voxel_centres():
    """Coordinates x, y, z, each indexed [z, y, x]."""
    z, y, x = np.meshgrid(*[np.arange(EDGE) + 0.5] * 3, indexing="ij")
    return np.stack([x, y, z])


def ball():
    return np.linalg.norm(voxel_centres() - CENTRE[:, None, None, None], axis=0) - RADIUS


def curved_volume(tets):
    """The volume of tets of ten nodes, (n, 10, 3), by 64 points of Gauss in each."""
    at, weights = np.polynomial.legendre.leggauss(4)
    at, weights = (at + 1) / 2, weights / 2
    edges = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
    slopes = np.array([[-1, -1, -1], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    volume = 0
    for i, j, k in np.ndindex(4, 4, 4):
        u, v = at[i], at[j] * (1 - at[i])
        w = at[k] * (1 - at[i]) * (1 - at[j])
        hats = np.array([1 - u - v - w, u, v, w])
        of_nodes = np.concatenate([
            (4 * hats - 1)[:, None] * slopes,
            [4 * (hats[a] * slopes[b] + hats[b] * slopes[a]) for a, b in edges]])
        scale = weights[i] * weights[j] * weights[k] * (1 - at[i])**2 * (1 - at[j])
        volume += scale * np.linalg.det(np.einsum("nkd,ke->nde", tets, of_nodes)).sum()
    return volume


class Values(unittest.TestCase):
    def setUp(self):
        enter_folder(self)

    def mesh(self, name, *options):
        run("mesh", name, "-o", "m.vtu", *options)
        return Mesh("m.vtu")

    def digest(self, name, *options):
        run("mesh", name, "-o", "d.vtu", *options)
        return run("digest", "d.vtu").split()[0]

    def test_a_ball_is_where_its_distances_say(self):
        np.save("f.npy", ball())
        true = 4 / 3 * np.pi * RADIUS**3
        for size, volume_bound, mean_bound in BALL_BOUNDS:
            with self.subTest(size=size):
                made = self.mesh("f.npy", "--values", "distances", *size)
                off = np.linalg.norm(made.interface() - CENTRE, axis=1) - RADIUS
                self.assertLess(abs(made.volume(1) / true - 1), volume_bound)
                self.assertLess(np.abs(off).mean(), mean_bound)
                verdict = run("verify", "f.npy", "m.vtu", "--values", "distances")
                self.assertIn("all checks hold", verdict)

    def test_curved_tets_follow_the_values(self):
        """Corners and middles of edges lie where distances are 0, except for some that tets hold
        back, and the volume is that of the ball."""
        np.save("f.npy", ball())
        run("mesh", "f.npy", "-o", "c.vtu", "--values", "distances", "--size", "3",
            "--element", "tet10-curved")
        mesh = meshio.read("c.vtu")
        tets = mesh.cells_dict["tetra10"]
        is_ball = mesh.cell_data_dict["label"]["tetra10"].ravel() == 1
        nodes = np.intersect1d(tets[is_ball], tets[~is_ball])
        off = np.abs(np.linalg.norm(mesh.points[nodes] - CENTRE, axis=1) - RADIUS)
        self.assertGreater((off < 0.01).mean(), 0.95)
        self.assertLess(np.median(off), 0.004)
        true = 4 / 3 * np.pi * RADIUS**3
        self.assertLess(abs(curved_volume(mesh.points[tets[is_ball]]) / true - 1), 4e-4)
        # Tets that are cut have corners outside of the ball, by as much as their volume asks for.
        made = self.mesh("f.npy", "--values", "distances", "--size", "1")
        off = np.abs(np.linalg.norm(made.interface() - CENTRE, axis=1) - RADIUS)
        self.assertGreater((off < 0.03).mean(), 0.95)
        self.assertLess(abs(made.volume(1) / true - 1), 6e-4)
        self.assertIn("all checks hold", run("verify", "f.npy", "m.vtu", "--values", "distances"))

    def test_curved_tets_of_three_classes(self):
        """Two half-spaces, and a slab between them that ends where all three meet."""
        x, y, z = voxel_centres()
        np.save("f.npy", np.stack([x - 9.3 + 0.2 * y, 14.6 - x - 0.1 * z]))
        run("mesh", "f.npy", "-o", "c.vtu", "--values", "distances", "--element", "tet10-curved")
        self.assertIn("all checks hold", run("verify", "f.npy", "c.vtu", "--values", "distances"))
        mesh = meshio.read("c.vtu")
        tets = mesh.cells_dict["tetra10"]
        labels = mesh.cell_data_dict["label"]["tetra10"].ravel()
        one, none = (np.unique(tets[labels == label]) for label in (1, 0))
        at = mesh.points[np.intersect1d(one, none)]
        inside = ((at > 1) & (at < EDGE - 1)).all(axis=1)
        self.assertLess(np.median(np.abs(at[:, 0] - 9.3 + 0.2 * at[:, 1])[inside]), 1e-3)

    def test_planes_are_nearer_to_their_distances_than_to_voxels(self):
        random = np.random.default_rng(5)
        squares = {"f.npy": [], "labels.npy": []}
        for _ in range(6):
            normal = random.normal(size=3)
            normal /= np.linalg.norm(normal)
            place = normal @ np.full(3, EDGE / 2) + random.uniform(-1, 1)
            distances = np.tensordot(normal, voxel_centres(), 1) - place
            np.save("f.npy", distances)
            np.save("labels.npy", (distances < 0).astype(np.uint8))
            for name, options in (("f.npy", ("--values", "distances")), ("labels.npy", ())):
                made = self.mesh(name, "--size", "4", *options)
                squares[name].extend((made.interface() @ normal - place) ** 2)
        errors = {name: np.sqrt(np.mean(all_of)) for name, all_of in squares.items()}
        self.assertLess(errors["f.npy"], PLANE_BOUND)
        self.assertLess(errors["f.npy"], 0.7 * errors["labels.npy"], errors)

    def test_probabilities_are_read_from_all_containers(self):
        classes = np.stack([ball(), 2 - ball(), 0.3 * ball() + 1])
        classes = ((classes - classes.min()) / np.ptp(classes)).astype(np.float32)
        np.save("p.npy", classes)
        image = nibabel.Nifti1Image(classes.transpose(3, 2, 1, 0), np.eye(4))
        nibabel.save(image, "p.nii.gz")
        for i, one in enumerate(classes):
            nibabel.save(nibabel.Nifti1Image(one.transpose(2, 1, 0), np.eye(4)), f"c{i}.nii")
        np.save("labels.npy", classes.argmax(0).astype(np.uint8))
        options = ("--values", "probabilities", "--frame", "voxel")
        digests = {self.digest(name, *options)
                   for name in ("p.npy", "p.nii.gz", "c0.nii,c1.nii,c2.nii")}
        self.assertEqual(len(digests), 1)
        self.assertNotEqual(digests, {self.digest("labels.npy", "--frame", "voxel")})
        self.assertIn("all checks hold", run("verify", "labels.npy", "d.vtu", "--frame", "voxel"))

    def test_without_smooth_surfaces_only_labels_count(self):
        np.save("f.npy", ball())
        np.save("labels.npy", (ball() < 0).astype(np.uint8))
        for options in (("--surface", "voxel"), ("--max-distance", "none")):
            self.assertEqual(self.digest("f.npy", "--values", "distances", *options),
                             self.digest("labels.npy", *options))

    def test_threads_and_crops_change_nothing_but_the_part(self):
        np.save("f.npy", ball())
        one = self.digest("f.npy", "--values", "distances", "--threads", "1")
        self.assertEqual(self.digest("f.npy", "--values", "distances", "--threads", "2"), one)
        np.save("part.npy", ball()[2:20, 1:23, 3:24])
        self.assertEqual(self.digest("part.npy", "--values", "distances"),
                         self.digest("f.npy", "--values", "distances", "--crop", "3,1,2,24,23,20",
                                     "--origin", "0,0,0"))

    def test_the_report_tells_values_apart_that_have_the_same_labels(self):
        found = set()
        for scale in (1.0, 1.5):
            shifted = ball()
            shifted[shifted > 0] *= scale
            np.save("f.npy", shifted)
            run("mesh", "f.npy", "-o", "m.vtu", "--values", "distances", "--certify", "on",
                "--report", "r.json")
            with open("r.json", encoding="utf-8") as file:
                found.add(json.load(file)["certificate"]["label_fingerprint"])
        self.assertEqual(len(found), 2)

    def test_what_does_not_go_with_values_is_refused(self):
        np.save("f.npy", ball())
        for options in (("--merge", "1=5"), ("--keep", "kept", "--order", "colour"),
                        ("--overlap", "first")):
            refused([options[0]], "mesh", "f.npy", "-o", "m.vtu", "--values", "distances", *options, code=2)
        bad = ball()
        bad[3, 4, 5] = np.nan
        np.save("bad.npy", bad)
        refused(["bad.npy: voxel (5, 4, 3)"], "mesh", "bad.npy", "-o", "m.vtu", "--values", "distances")
        np.save("bytes.npy", np.full((3, 4, 5), 255, np.uint8))
        refused(["bytes.npy: voxel (0, 0, 0): the value 255 is no probability"], "mesh", "bytes.npy", "-o",
                "m.vtu", "--values", "probabilities")


# What was found, rounded up: options, relative error of the volume, mean distance in voxels.  The
# corners of a coarse mesh of a ball are outside, as it keeps the volume.
BALL_BOUNDS = (((), 0.008, 0.5), (("--size", "3"), 0.003, 0.15), (("--size", "2"), 0.0015, 0.08))
PLANE_BOUND = 0.025  # root of the mean square, voxels

if __name__ == "__main__":
    unittest.main()
