# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The Python package as its users call it; numpy alone is the oracle."""

import ast
import concurrent.futures
import contextlib
import copy
import csv
import doctest
import gc
import html
import inspect
import io
import json
import os
import pathlib
import pickle
import re
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import unittest.mock
import warnings

try:
    import numpy as np
except ImportError:
    print("skipped: no numpy")
    sys.exit(77)

import mwmesh
import mwmesh._mesh

PROGRAM = os.environ["MW_PROGRAM"]


def optional(name):
    try:
        return __import__(name)
    except ImportError:
        return None


def needs(name):
    return unittest.skipUnless(optional(name), f"no {name}")


def options(use):
    """The arguments of a use that are neither settings nor about the place of a volume."""
    return [name for name in mwmesh._options.arguments_of(use)
            if name not in mwmesh.settings() and name not in mwmesh.PLACE]


def grains(shape=(22, 18, 20), labels=6, seed=3):
    return mwmesh.synth("voronoi", shape, labels, seed)


class InFolder(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def program(self, *arguments):
        run = subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout


class Documentation(unittest.TestCase):

    def test_examples_run(self):
        for module in (mwmesh, mwmesh._mesh):
            result = doctest.testmod(module)
            self.assertEqual(result.failed, 0)
            self.assertGreater(result.attempted, 0)

    def test_every_argument_is_documented(self):
        for name in (*mwmesh.PLACE, "names", *mwmesh._options.arguments_of("mesh")):
            self.assertIn(name, mwmesh.mesh.__doc__)
        for function, use in ((mwmesh.Mesh.save, "write"), (mwmesh.Mesh.verify, "verify")):
            for name in options(use):
                self.assertRegex(function.__doc__, rf"\n    {name}: \w")
        self.assertIn("max_distance", mwmesh.settings())
        self.assertEqual([name for name in dir(mwmesh) if not name.startswith("_")],
                         sorted(mwmesh.__all__))

    def test_a_library_of_another_version_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            package = pathlib.Path(folder, "mwmesh")
            shutil.copytree(pathlib.Path(mwmesh.__file__).parent, package)
            call = [sys.executable, "-B", "-c", "import mwmesh"]
            environment = {**os.environ, "PYTHONPATH": folder}
            subprocess.run(call, env=environment, check=True)
            version = package / "_version.py"
            text = version.read_text(encoding="utf-8").replace(mwmesh.__version__, "77.0.0")
            version.write_text(text, encoding="utf-8")
            done = subprocess.run(call, env=environment, capture_output=True, text=True)
            for piece in ("ImportError: mwmesh: ", str(package / "libmwmesh.so"), "77.0.0",
                          "build the target mwmesh_python again"):
                self.assertIn(piece, done.stderr)
            (package / "libmwmesh.so").write_bytes(b"no library")
            done = subprocess.run(call, env=environment, capture_output=True, text=True)
            self.assertIn("ImportError: mwmesh: ", done.stderr)

    def test_functions_are_those_of_the_header(self):
        header = pathlib.Path(__file__).parents[3] / "engine" / "mwmesh_c.h"
        declared = re.findall(r"MW_PUBLIC [^;(]*\bmw_(\w+)\(([^;]*)\);",
                              header.read_text(encoding="utf-8"))
        known = {**mwmesh._library._CERTAIN, **mwmesh._library._FALLIBLE}
        takes = {name: arguments.count(",") + (arguments != "void")
                 for name, arguments in declared if "(*read)" not in arguments}
        self.assertLessEqual(known.keys() - {"volume_of_reader"}, takes.keys())
        for name, count in takes.items():
            if name in known:
                own = len(known[name]) - 1 + (name in mwmesh._library._FALLIBLE)
                self.assertEqual(own, count, name)

    def test_types_are_of_what_there_is(self):
        stub = pathlib.Path(mwmesh.__file__).with_suffix(".pyi")
        signatures, module = {}, ast.parse(stub.read_text(encoding="utf-8")).body
        of_mesh = next(node.body for node in module if getattr(node, "name", "") == "Mesh")
        for node in [*of_mesh, *module]:
            if isinstance(node, ast.FunctionDef):
                arguments = node.args.posonlyargs + node.args.args + node.args.kwonlyargs
                signatures[node.name] = arguments
        stubs = {name: {one.arg for one in arguments} for name, arguments in signatures.items()}
        place = {*mwmesh.PLACE, "names"}
        self.assertEqual(stubs["as_volume"], {"source", *place})
        self.assertEqual(stubs["mesh"], {"volume", "progress", *place, *options("mesh")})
        self.assertEqual(stubs["verify"], {"self", "volume", *options("verify")})
        self.assertEqual(stubs["save"], {"self", "path", "values", *options("write")})
        for function, name, expected in (
                ("save", "element", "Literal['tet4', 'tet10', 'tet10-curved']"),
                ("verify", "labels", "_Label | Iterable[_Label] | None"), ("mesh", "from_kept", "bool")):
            argument, = (one for one in signatures[function] if one.arg == name)
            self.assertEqual(ast.unparse(argument.annotation), expected)
        public = next(node.value for node in module if getattr(node, "targets", None)
                      and node.targets[0].id == "__all__")
        self.assertEqual(set(ast.literal_eval(public)), set(mwmesh.__all__))
        for function in (mwmesh.Mesh.surface, mwmesh.Mesh.picture, mwmesh.read, mwmesh.synth):
            self.assertEqual(stubs[function.__name__], {*inspect.signature(function).parameters})
        self.assertLessEqual({*inspect.signature(mwmesh.mesh_to_file).parameters} - {"arguments"},
                             stubs["mesh_to_file"])


class SameMesh(InFolder):
    """Whatever the labels come in, it is the mesh of the program."""

    def setUp(self):
        super().setUp()
        self.labels = grains()
        np.save(self.path("v.npy"), self.labels.astype(np.uint8))
        self.place = {"spacing": (1, 2, 1.5), "origin": (5, 6, 7)}
        self.program("mesh", "v.npy", "-o", "v.vtu", "--spacing", "1,2,1.5", "--origin", "5,6,7",
                     "--max-distance", "1.25", "--report", "r.json")
        with open(self.path("r.json"), encoding="utf-8") as file:
            self.report = json.load(file)

    def check(self, volume, **place):
        mesh = mwmesh.mesh(volume, max_distance=1.25, **{**self.place, **place})
        self.assertEqual(mesh.digest, self.report["digest"])
        return mesh

    def test_arrays(self):
        mesh = self.check(self.labels)
        for key in ("digest", "quality", "shape", "topology", "distance"):
            self.assertEqual(mesh.report[key], self.report[key], key)
        for kind in ("u1", "i2", "<u4", ">u4", ">i8", "f4", "f8"):
            self.check(self.labels.astype(kind))
        self.check(np.asfortranarray(self.labels))
        self.check(self.labels.T, axes="xyz")
        wide = np.zeros([2 * n for n in self.labels.shape], np.uint16)
        wide[::2, 1::2, ::-2] = self.labels
        self.check(wide[::2, 1::2, ::-2])
        self.check(self.labels.tolist())

    def test_one_voxel_axes(self):
        for shape in ((1, 5, 6), (4, 1, 6), (4, 5, 1), (1, 1, 1)):
            flat = np.arange(np.prod(shape)).reshape(shape) % 3
            mesh = mwmesh.mesh(flat)
            self.assertAlmostEqual(sum(mesh.volumes().values()), np.prod(shape))
            self.assertTrue(mesh.verify(flat))

    def test_files(self):
        self.check(self.path("v.npy"))
        self.check(__import__("pathlib").Path(self.path("v.npy")), threads=1)
        mwmesh.mesh_to_file(self.labels, self.path("f.msh"), max_distance=1.25, **self.place)
        self.assertEqual(mwmesh.read(self.path("f.msh")).digest, self.report["digest"])
        self.assertEqual(mwmesh.read(self.path("v.vtu")).digest, self.report["digest"])

    def test_meshes_an_object_alone(self):
        wanted = int(self.labels.max())
        alone = mwmesh.mesh(self.path("v.npy"), object=wanted)
        self.assertEqual(list(alone.volumes()), [wanted])
        where = np.argwhere(self.labels == wanted)
        lo = np.maximum(where.min(0) - 4, 0)
        box = tuple(map(slice, lo, where.max(0) + 5))
        by_hand = np.where(self.labels == wanted, self.labels, 0)[box]
        by_hand = mwmesh.mesh(by_hand, labels=[wanted], origin=[int(v) for v in lo[::-1]])
        self.assertEqual(alone.digest, by_hand.digest)
        merged = mwmesh.mesh(self.path("v.npy"), object=wanted, merge={wanted: 77})
        self.assertEqual(list(merged.volumes()), [77])
        self.assertEqual(len(merged.tets), len(alone.tets))
        rest = mwmesh.mesh(self.path("v.npy"), object=[wanted], background=wanted)
        self.assertEqual(list(rest.volumes()), [0])
        with self.assertRaisesRegex(mwmesh.InputError, "no voxel has 99"):
            mwmesh.mesh(self.path("v.npy"), object=99)
        with self.assertRaisesRegex(mwmesh.InputError, r"no voxel has -1 \(or 18446744073709551615\)"):
            mwmesh.mesh(self.path("v.npy"), object=-1)

    def test_crops(self):
        part = mwmesh.mesh(self.path("v.npy"), crop=((2, 3, 4), (20, 15, 16)))
        self.assertEqual(part.digest,
                         mwmesh.mesh(self.labels[4:16, 3:15, 2:20], origin=(2, 3, 4)).digest)

    def test_curved_tets_that_were_read_are_judged_as_the_program_does(self):
        labels = grains()
        mwmesh.mesh(labels).save(self.path("c.vtu"), element="tet10-curved")
        read = mwmesh.read(self.path("c.vtu"))
        verdict = read.verify(labels)
        self.assertTrue(verdict)
        self.assertIn("P2 Jacobians", [check[0] for check in verdict.checks])
        self.assertTrue(pickle.loads(pickle.dumps(read)).verify(labels))

    def test_curves_and_pairs_need_single_vertices(self):
        labels, file = grains(), self.path("no.vtu")
        with self.assertRaisesRegex(mwmesh.UsageError, "tet10 is"):
            mwmesh.mesh(labels, split="*").save(file, element="tet10-curved")
        for options in ({"element": "tet10-curved"}, {"periodic": "x", "pairs": self.path("p.csv")}):
            with self.assertRaisesRegex(mwmesh.UsageError, "vertices"):
                mwmesh.mesh_to_file(labels, file, split="*", progress=lambda *_: self.fail("it began"),
                                    **options)

    @needs("nibabel")
    def test_images_lie_where_their_files_do(self):
        import nibabel
        data = grains().astype(np.uint8)
        turn = np.array([[.6, -.8, 0, 3], [.8, .6, 0, -7.3], [0, 0, 1.1, .4], [0, 0, 0, 1]])
        rotations = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3, 3)))[0]
        oblique = [np.vstack([np.hstack([r * (.8, .9, 1.2), [[3.3], [-2], [.7]]]), [[0, 0, 0, 1]]])
                   for r in rotations]
        for affine in (np.diag([.7, .7, 1.1, 1]), np.diag([-.7, .9, 3, 1]), turn, *oblique):
            nibabel.save(nibabel.Nifti1Image(data, affine), self.path("i.nii"))
            for frame in (None, "ras", "lps", "voxel"):
                made = mwmesh.mesh(nibabel.load(self.path("i.nii")), frame=frame)
                self.assertEqual(made.digest, mwmesh.mesh(self.path("i.nii"), frame=frame).digest)
            image = nibabel.load(self.path("i.nii"))  # as edited, and saved again
            made = mwmesh.mesh(image)
            self.assertEqual(made.digest, mwmesh.mesh(data, affine=image.affine, frame="ras").digest)
            nibabel.save(nibabel.Nifti1Image(data, image.affine), self.path("j.nii"))
            self.assertEqual(made.digest, mwmesh.mesh(self.path("j.nii")).digest)
        with self.assertRaises(mwmesh.UsageError):
            mwmesh.mesh(nibabel.load(self.path("i.nii")), spacing=1)

    @needs("nibabel")
    def test_nibabel_images(self):
        import nibabel
        affine = np.array([[0, -3, 0, 10], [2, 0, 0, 20], [0, 0, 4, 30], [0, 0, 0, 1.0]])
        for data in (self.labels.T.astype(np.int16), self.labels.T.astype(np.float32)):
            image = nibabel.Nifti1Image(data, affine)
            nibabel.save(image, self.path("v.nii.gz"))
            made = mwmesh.mesh(image)
            self.assertEqual(made.digest, mwmesh.mesh(self.path("v.nii.gz")).digest)
            self.assertEqual(made.digest, mwmesh.mesh(nibabel.load(self.path("v.nii.gz"))).digest)
            self.assertEqual(made.digest, mwmesh.mesh(self.labels.T, affine=affine,
                                                      frame="ras").digest)
            image.header["pixdim"][1:4] = 0  # some programs leave the affine alone to tell
            self.assertEqual(made.digest, mwmesh.mesh(image).digest)
            low = (affine @ [-0.5, -0.5, -0.5, 1])[:3]
            high = (affine @ [21.5, 17.5, 19.5, 1])[:3]
            np.testing.assert_allclose(made.points.min(axis=0), np.minimum(low, high))
            np.testing.assert_allclose(made.points.max(axis=0), np.maximum(low, high))
            self.assertAlmostEqual(sum(made.volumes().values()) / (24 * self.labels.size), 1)

    def test_regions(self):
        self.check(Watched(self.labels))

    @needs("h5py")
    def test_h5py(self):
        import h5py
        with h5py.File(self.path("v.h5"), "w") as file:
            file.create_dataset("labels", data=self.labels, chunks=(8, 8, 8), compression="gzip")
        with h5py.File(self.path("v.h5")) as file:
            self.check(file["labels"])

    @needs("zarr")
    def test_zarr(self):
        import zarr
        self.check(zarr.array(self.labels, chunks=(7, 8, 9)))

    @needs("dask")
    def test_dask(self):
        import dask.array
        self.check(dask.array.from_array(self.labels, chunks=(7, 8, 9)))


class Watched:
    """An array that is read by region, and notes what is asked of it."""

    def __init__(self, labels, fail_at=None):
        self.labels, self.shape, self.dtype = labels, labels.shape, labels.dtype
        self.largest, self.reads, self.fail_at = 0, 0, fail_at

    def __getitem__(self, region):
        self.reads += 1
        if self.reads == self.fail_at:
            raise KeyError("a chunk is missing")
        part = self.labels[region]
        self.largest = max(self.largest, part.size)
        return part


class Masks(InFolder):
    def save(self, name, mask):
        z, y, x = mask.shape
        head = f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: {x} {y} {z}\nencoding: raw\n\n"
        pathlib.Path(self.path(name)).write_bytes(head.encode() + mask.astype(np.uint8).tobytes())

    def test_each_mask_is_known_as_a_whole(self):
        z, y, x = np.indices((10, 11, 12))
        os.mkdir(self.path("masks"))
        self.save("masks/a.nrrd", (x < 7) & (y < 8))
        self.save("masks/b.nrrd", (x > 3) & (y > 2) & (z > 2))
        np.save(self.path("image.npy"), np.ones((10, 11, 12)))
        made = mwmesh.mesh(self.path("masks"), overlap="all",
                           sample={"mask_a": self.path("image.npy")})
        made.save(self.path("m.vtkhdf"))
        for mesh in (made, mwmesh.read(self.path("m.vtkhdf")), copy.copy(made)):
            self.assertEqual(mesh.masks, {"a": [1, 3], "b": [2, 3]})
            # A value has that name already, as in files.
            self.assertEqual(list(mesh._mask_cells()), ["mask_a_", "mask_b"])
            for labels, cells in zip(mesh.masks.values(), mesh._mask_cells().values()):
                np.testing.assert_array_equal(cells, np.isin(mesh.labels, labels))
        self.assertEqual(mwmesh.mesh(self.path("masks"), overlap="last").masks, {})


class Regions(unittest.TestCase):

    def test_the_volume_is_never_whole(self):
        labels = mwmesh.synth("tubes", (160, 150, 140), 20, 1).astype(np.uint16)
        watched = Watched(labels)
        watched.chunks = (32, 32, 32)
        mesh = mwmesh.mesh(watched, surface="voxel", max_distance=None, report=False)
        self.assertLess(watched.largest, labels.size / 4)
        self.assertEqual(mesh.digest,
                         mwmesh.mesh(labels, surface="voxel", max_distance=None).digest)

    def test_its_errors_pass_through(self):
        for number in (1, 2, 3):
            with self.assertRaises(KeyError):
                mwmesh.mesh(Watched(grains(), number))
        with self.assertRaises(mwmesh.InputError):
            mwmesh.mesh(Watched(grains() + 0.5))


class Changing(Watched):
    """Other labels from a given reading on."""

    def __init__(self, labels, others, change_at):
        super().__init__(labels)
        self.others, self.change_at = others, change_at

    def __getitem__(self, region):
        part = super().__getitem__(region)
        return part if self.reads < self.change_at else self.others[region]


class ChangedInput(unittest.TestCase):
    """Labels that change under a run are an error; the interpreter goes on."""

    def check(self, volume):
        with self.assertRaisesRegex(mwmesh.InputError, "changed while it was read"):
            mwmesh.mesh(volume)

    def test_regions_that_answer_differently(self):
        labels = grains().astype(np.int64)
        first = Watched(labels)
        mwmesh.mesh(first, certify="off")
        for others in (labels + 40_000, labels - 2**40, labels + 2**60, labels * 3 + 1):
            for number in (first.reads // 2 + 1, first.reads + 1):
                self.check(Changing(labels, others, number))

    def test_an_array_that_another_thread_writes_to(self):
        labels = grains((60, 60, 60), 40).astype(np.uint16)
        stop = threading.Event()

        def write():
            kept, number = labels.copy(), 0
            while not stop.is_set():
                number += 1
                labels[:] = kept + number % 3 * 1000

        thread = threading.Thread(target=write)
        thread.start()
        try:
            for _ in range(3):
                try:  # a mesh, when the first reading happened to see all that came later
                    mwmesh.mesh(labels)
                except mwmesh.InputError as error:
                    self.assertIn("changed while it was read", str(error))
        finally:
            stop.set()
            thread.join()


class Figures(unittest.TestCase):
    """What is told of a mesh, against plain loops over its tets."""

    def setUp(self):
        self.volume = mwmesh.synth("spheres", (24, 22, 20), 3, 2).astype(np.int32) - 1
        self.spacing = (1, 1.5, 2)
        self.mesh = mwmesh.mesh(self.volume, spacing=self.spacing)

    def facets(self):
        """{sorted corners: [labels of the tets there]}."""
        out = {}
        for tet, label in zip(self.mesh.tets.tolist(), self.mesh.labels.tolist()):
            for left_out in range(4):
                key = tuple(sorted(tet[:left_out] + tet[left_out + 1:]))
                out.setdefault(key, []).append(label)
        return out

    def area(self, corners):
        a, b, c = self.mesh.points[list(corners)]
        return np.linalg.norm(np.cross(b - a, c - a)) / 2

    def test_signed_labels(self):
        self.assertEqual(self.mesh.labels.dtype, np.int64)
        self.assertEqual(list(self.mesh.label_list()), [-1, 0, 1, 2])

    def test_volumes(self):
        volumes = self.mesh.volumes()
        self.assertAlmostEqual(sum(volumes.values()), self.volume.size * 3)
        for label, volume in volumes.items():
            voxels = np.count_nonzero(self.volume == label) * 3
            self.assertLess(abs(volume - voxels) / voxels, 0.1)

    def test_contacts(self):
        expected = {}
        for corners, labels in self.facets().items():
            if len(labels) == 2 and labels[0] != labels[1]:
                pair = tuple(sorted(labels))
                expected[pair] = expected.get(pair, 0) + self.area(corners)
        contacts = self.mesh.contacts()
        self.assertEqual(contacts.keys(), expected.keys())
        for pair, area in contacts.items():
            self.assertAlmostEqual(area, expected[pair])

    def test_facets_and_surfaces(self):
        for label in self.mesh.label_list():
            expected = {tuple(sorted(c)) for c, labels in self.facets().items()
                        if labels.count(label) == 1}
            points, triangles = self.mesh.surface(label)
            where = {tuple(p): i for i, p in enumerate(self.mesh.points)}
            rows = np.array([where[tuple(p)] for p in points])
            self.assertEqual({tuple(sorted(t)) for t in rows[triangles].tolist()}, expected)
            # Closed, and seen from outside: the volume inside is the label's.
            a, b, c = (points[triangles[:, i]] for i in range(3))
            inside = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
            self.assertAlmostEqual(inside, self.mesh.volumes()[label])
        one = self.mesh.facets(-1, 0)
        other = self.mesh.facets(0, -1)
        np.testing.assert_array_equal(one, other[:, ::-1])
        # Balls in a background: from inside the ball its normals point away from its middle.
        a, b, c = (self.mesh.points[other[:, i]] for i in range(3))
        out = np.einsum("ij,ij->i", a - a.mean(axis=0), np.cross(b - a, c - a)).sum()
        self.assertGreater(out, 0)
        self.assertGreater(len(self.mesh.surface(-1)[1]), len(self.mesh.surface(-1, False)[1]))
        with self.assertRaises(mwmesh.UsageError):
            self.mesh.surface(77)

    def test_an_open_surface_ends_at_the_box_alone(self):
        """Facets towards labels that were left out are no side of the box."""
        volume = np.zeros((12, 12, 12), np.uint8)
        volume[:, 3:9, 3:9] = 1  # a bar through the box, between z = 0 and 12
        whole = mwmesh.mesh(volume, surface="voxel")
        part = mwmesh.mesh(volume, surface="voxel", background=0)
        moved = mwmesh.mesh(volume, surface="voxel", background=0, affine=np.diag([2, 3, 4, 1]))
        for mesh in (whole, part, moved):
            points, triangles = mesh.surface(1, closed=False)
            self.assertLess(len(triangles), len(mesh.surface(1).triangles))
            height = points[triangles][:, :, 2]
            self.assertTrue((np.ptp(height, axis=1) > 0).all())  # none lies on a side along z
        self.assertEqual(len(part.surface(1, closed=False).triangles),
                         len(whole.surface(1, closed=False).triangles))

    def test_arrays_are_views_that_outlive_the_mesh(self):
        points, total = self.mesh.points, self.mesh.points.sum()
        for array in (points, self.mesh.tets, self.mesh.labels, self.mesh.label_list()):
            self.assertFalse(array.flags.owndata and array is not self.mesh.label_list())
            with self.assertRaises(ValueError):
                array[0] = 0
        self.mesh = None
        self.assertEqual(points.sum(), total)

    def test_verify(self):
        self.assertTrue(self.mesh.verify(self.volume, spacing=self.spacing))
        tets = self.mesh.tets.copy()
        moved = mwmesh.Mesh(self.mesh.points, tets, self.mesh.labels)
        self.assertEqual(moved.digest, self.mesh.digest)
        tets[7, :2] = tets[7, 1::-1].copy()
        self.assertEqual(moved.digest, self.mesh.digest)
        verdict = mwmesh.Mesh(self.mesh.points, tets, self.mesh.labels).verify(self.volume, spacing=self.spacing)
        self.assertFalse(verdict)
        self.assertIn("P2 orientation", [name for name, passed, _ in verdict.checks if not passed])
        self.assertIn("FAIL", repr(verdict))

    def test_verify_uses_names_that_the_volume_can_have(self):
        labels = np.ones((6, 6, 6), np.int8)
        labels[2:4, 2:4, 2:4] = -1
        mesh = mwmesh.mesh(labels, names={-1: "neg", 1: "pos"})
        self.assertTrue(mesh.verify(labels))
        verdict = mesh.verify(np.ones((6, 6, 6), np.uint8))
        self.assertFalse(verdict)
        self.assertIn("label is not in the volume", repr(verdict))
        with self.assertRaisesRegex(mwmesh.UsageError, "names"):
            mesh.verify(np.ones((6, 6, 6), np.uint8), names={-1: "neg"})

    def test_what_hangs_is_welded(self):
        blocks = np.zeros((12, 12, 12), np.uint8)
        blocks[2:10, 2:6, 2:6] = 1
        blocks[2:10, 6:10, 6:10] = 2
        hanging = mwmesh.mesh(blocks, background=0)
        whole = mwmesh.mesh(blocks, background=0, weld=0)
        self.assertEqual(hanging.report["parts"]["found"], 2)
        self.assertEqual(whole.report["parts"]["found"], 1)
        self.assertEqual(whole.report["welds"]["voxels"], 8)
        welded, plain = whole.verify(blocks, weld=[0]), whole.verify(blocks)
        self.assertTrue(welded)
        places = [next(check for check in verdict.checks if check[0] == "P4 place")
                  for verdict in (welded, plain)]
        self.assertNotEqual(*places)

    def test_thick_slices_are_interpolated(self):
        z, y, x = np.meshgrid(5 * np.arange(8) + 2.5, np.arange(40) + 0.5, np.arange(40) + 0.5,
                              indexing="ij")
        ball = ((x - 20)**2 + (y - 20)**2 + (z - 20)**2 < 14**2).astype(np.uint8)
        mesh = mwmesh.mesh(ball, spacing=(1, 1, 5), interpolate_slices=True)
        self.assertEqual(mesh.report["interpolated"], {"axis": "z", "slices": 8, "layers": 5})
        self.assertTrue(mesh.verify(ball, spacing=(1, 1, 5), interpolate_slices=True))
        exact = 4 / 3 * np.pi * 14**3
        self.assertLess(abs(mesh.volumes()[1] / exact - 1), 0.03)
        with self.assertRaisesRegex(mwmesh.UsageError, "no thick slices"):
            mwmesh.mesh(ball, interpolate_slices=True)

    def test_parts_and_splits(self):
        labels = np.zeros((12, 12, 20), np.uint8)
        labels[2:10, 2:10, 2:6] = 1
        labels[2:10, 2:10, 6:10] = 2
        labels[4:8, 4:8, 14:18] = 3
        place = {"names": {1: "left"}, "background": 0}
        whole = mwmesh.mesh(labels, **place)
        self.assertEqual([whole.report["parts"][k] for k in ("written", "hanging", "free")], [2, 0, 1])
        largest = mwmesh.mesh(labels, parts="largest", **place)
        self.assertEqual(list(largest.label_list()), [1, 2])
        self.assertEqual(mwmesh.mesh(labels, parts=len(largest.tets), **place).digest, largest.digest)
        self.assertTrue(largest.verify(labels))
        split = mwmesh.mesh(labels, split=[("left", 2)], open_hinges=True, **place)
        np.testing.assert_array_equal(split.points[split.tets], whole.points[whole.tets])
        one, other = (set(split.tets[split.labels == label].ravel()) for label in (1, 2))
        self.assertFalse(one & other)
        copies = split.report["parts"]["doubled"]["copies"]
        self.assertEqual(len(split.points) - len(whole.points), copies)
        self.assertEqual(split.report["parts"]["doubled"]["parts_after"], 3)
        self.assertTrue(split.verify(labels))
        frozen = mwmesh.mesh(labels, split=frozenset({("left", 2)}), open_hinges=True, **place)
        np.testing.assert_array_equal(frozen.tets, split.tets)
        same = mwmesh.mesh(labels, split="*", **place)
        self.assertEqual((same.digest, len(same.points)), (split.digest, len(split.points)))
        with self.assertRaises(mwmesh.UsageError):
            mwmesh.mesh(labels, parts=10**9, **place)

    def test_wedges(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        labels = np.ones((8, 8, 12), np.int8)
        labels[:, :, 6:] = -2
        split = mwmesh.mesh(labels, split=[(1, -2)])
        self.assertEqual((split.wedges.shape, split.wedge_labels.shape), ((0, 6), (0, 2)))
        for first, second in ((1, -2), (-2, 1)):
            mesh = mwmesh.mesh(labels, cohesive=[(first, second)])
            self.assertEqual(mesh.digest, split.digest)
            self.assertEqual(mesh.report["parts"]["doubled"]["wedges"], len(mesh.wedges))
            np.testing.assert_array_equal(mesh.wedge_labels, [[first, second]] * len(mesh.wedges))
            self.assertEqual(mesh.wedge_labels.dtype, np.int64)
            for label, side in ((first, mesh.wedges[:, :3]), (second, mesh.wedges[:, 3:])):
                tets = mesh.tets[mesh.labels == label]
                facets = {frozenset(np.delete(t, i)) for t in tets for i in range(4)}
                self.assertTrue(all(frozenset(t) in facets for t in side))
            a, b, c, above = (mesh.points[mesh.wedges[:, i]] for i in (0, 1, 2, 3))
            np.testing.assert_array_equal(a, above)
            normals = np.cross(b - a, c - a) / 2
            np.testing.assert_allclose(normals.sum(axis=0), [64 if first == 1 else -64, 0, 0], atol=1e-9)
            mesh.save(folder / "w.vtu")
            for other in (pickle.loads(pickle.dumps(mesh)), mwmesh.read(folder / "w.vtu")):
                np.testing.assert_array_equal(other.points[other.wedges], mesh.points[mesh.wedges])
            with self.assertRaises(mwmesh.UsageError):
                mesh.save(folder / "w.mesh")
            with self.assertRaises(mwmesh.UsageError):
                mwmesh.mesh_to_file(labels, folder / "w.bdf", cohesive="*")
            with self.assertRaises(ValueError):
                mesh.wedges[0] = 0

    def test_interfaces_that_were_opened(self):
        labels = np.ones((8, 8, 12), np.int8)
        labels[:, :, 4:] = 3
        labels[2:6, 2:6, 8:] = 2
        whole = mwmesh.mesh(labels)
        for opened in (mwmesh.mesh(labels, split="*"), mwmesh.mesh(labels, cohesive=[(1, 3)])):
            self.assertGreater(len(opened.points), len(whole.points))
            self.assertEqual(whole.contacts().keys(), opened.contacts().keys())
            for pair, area in whole.contacts().items():
                self.assertAlmostEqual(opened.contacts()[pair], area, 9)
            for label in (1, 2, 3):
                points, triangles = opened.surface(label)
                edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
                counts = np.unique(edges, axis=0, return_counts=True)[1]
                self.assertEqual(set(counts), {2})
                a, b, c = points[triangles].transpose(1, 0, 2)
                self.assertAlmostEqual((a * np.cross(b, c)).sum() / 6, opened.volumes()[label], 9)
            mine, others = opened.facets(1, 3), opened.facets(3, 1)
            self.assertTrue(np.isin(mine, opened.tets[opened.labels == 1]).all())
            self.assertTrue(np.isin(others, opened.tets[opened.labels == 3]).all())

    @needs("vtkmodules")
    @needs("meshio")
    def test_wedges_elsewhere(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        labels = np.ones((8, 8, 12), np.int8)
        labels[:, :, 4:] = 3
        labels[:, :, 8:] = 2
        image = np.arange(labels.size, dtype=np.float64).reshape(labels.shape)
        np.save(folder / "v.npy", image)
        mesh = mwmesh.mesh(labels, cohesive="*", sample={"v": folder / "v.npy"})
        mesh.save(folder / "w.vtu")
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(folder / "w.vtu"))
        reader.Update()
        file, grid, other = reader.GetOutput(), mesh.to_vtk(), mesh.to_meshio()
        points = vtk_to_numpy(file.GetPoints().GetData())

        def cells(array, of_points):
            nodes, ends = (vtk_to_numpy(a) for a in (array.GetConnectivityArray(),
                                                     array.GetOffsetsArray()))
            return sorted(of_points[n].tolist() for n in np.split(nodes, ends[1:-1]) if len(n) == 6)

        self.assertGreater(len(mesh.wedges), 0)
        self.assertEqual(cells(grid.GetCells(), mesh.points), cells(file.GetCells(), points))
        np.testing.assert_array_equal(other.cells_dict["wedge"], mesh.wedges)
        for name in ("label", "v", "cohesive"):
            made, read = (vtk_to_numpy(g.GetCellData().GetArray(name)) for g in (grid, file))
            wedges = len(mesh.wedges)
            self.assertEqual(sorted(made[-wedges:]), sorted(read[-wedges:]), name)
            np.testing.assert_array_equal(np.concatenate(other.cell_data[name]), made, name)
        self.assertEqual(vtk_to_numpy(grid.GetCellData().GetScalars())[0], mesh.labels[0])

    def test_choices(self):
        mesh = mwmesh.mesh(self.volume, labels=[-1, 2], merge={1: 2}, names={2: "ball"})
        self.assertEqual(list(mesh.label_list()), [-1, 2])
        self.assertEqual(mesh.names, {2: "ball"})
        self.assertTrue(mesh.verify(self.volume, labels=[-1, 2], merge={1: 2}))
        self.assertEqual(list(mwmesh.mesh(self.volume, background=-1).label_list()), [0, 1, 2])
        sized = mwmesh.mesh(self.volume, size={0: 2.5}, report=False)
        self.assertGreater(len(sized.tets), len(mwmesh.mesh(self.volume).tets))
        self.assertIsNone(sized.report)


class Names(InFolder):
    """A label goes by its number or its name, wherever it is asked for."""

    def setUp(self):
        super().setUp()
        self.volume = grains(labels=4, seed=5)
        with open(self.path("names.csv"), "w", encoding="utf-8") as file:
            file.write("id,name,color\n1,Air,#000000\n2,Grey matter,#ff8000\n3,Lesion,#0000ff\n")
        self.names = {1: "Air", 2: "Grey matter", 3: "Lesion"}

    def test_come_from_dictionaries_lists_and_files(self):
        for names in (self.names, [None, "Air", "Grey matter", "Lesion"], self.path("names.csv"),
                      {str(k): v for k, v in self.names.items()}):
            self.assertEqual(mwmesh.mesh(self.volume, names=names).names, self.names)
        mesh = mwmesh.mesh(self.volume, names=self.path("names.csv"))
        again = mwmesh.Mesh(mesh.points, mesh.tets, mesh.labels, mesh.names)
        self.assertEqual(again.names, self.names)
        mesh.save(self.path("m.vtu"))
        colours = {row.name: row.colour for row in mwmesh.read(self.path("m.vtu"))._core.names}
        self.assertEqual(colours["Lesion"], [0, 0, 255, 255])

    def test_are_taken_wherever_labels_are(self):
        names = {"names": self.path("names.csv")}

        def same(by_name, by_number):
            self.assertEqual(mwmesh.mesh(self.volume, **names, **by_name).digest,
                             mwmesh.mesh(self.volume, **by_number).digest)

        same({"labels": ["Lesion", 2]}, {"labels": [3, 2]})
        same({"labels": "Lesion"}, {"labels": 3})
        same({"background": "Air"}, {"background": 1})
        same({"size": {"Lesion": 3}}, {"size": {3: 3}})
        same({"size": "lesion=3"}, {"size": {3: 3}})
        same({"merge": {"Lesion": "Grey matter"}}, {"merge": {3: 2}})
        mesh = mwmesh.mesh(self.volume, **names, background="Air")
        np.testing.assert_array_equal(mesh.surface("Lesion").triangles, mesh.surface(3).triangles)
        np.testing.assert_array_equal(mesh.facets("Lesion", 2), mesh.facets(3, 2))
        self.assertTrue(mesh.verify(self.volume, labels=["Lesion", "Grey matter", 4]))
        self.assertTrue(mesh.verify(mwmesh.as_volume(self.volume, **names), background="Air"))

    def test_that_no_label_or_several_have_are_errors(self):
        for names, told, piece in ((self.names, "lesions", "near it: Lesion"),
                                   (None, "Lesion", "no label has a name"),
                                   ({1: "a", 2: "a"}, "a", "1, 2")):
            with self.assertRaisesRegex(mwmesh.UsageError, f"^labels: .*{piece}"):
                mwmesh.mesh(self.volume, labels=[told], names=names)
        with self.assertRaisesRegex(mwmesh.InputError, "nowhere.csv"):
            mwmesh.mesh(self.volume, names=self.path("nowhere.csv"))


class Copies(InFolder):

    def test_are_the_mesh(self):
        volume = mwmesh.synth("spheres", (20, 20, 20), 2, 1).astype(np.int16) - 2
        mesh = mwmesh.mesh(volume, names={-1: "ball"}, max_distance=1.25)
        mesh.volumes()
        for made in (copy.copy(mesh), copy.deepcopy(mesh), pickle.loads(pickle.dumps(mesh))):
            self.assertEqual(made.digest, mesh.digest)
            self.assertEqual(made.names, mesh.names)
            self.assertEqual(made.report, mesh.report)
            self.assertEqual(made.volumes(), mesh.volumes())
            self.assertEqual(made.labels.dtype, np.int64)
            checked = made.verify(volume).report["asked"]
            self.assertEqual((checked["of_run"], checked["max_distance"]), (True, 1.25))


class Values(InFolder):

    def test_pairs_of_a_cell_that_repeats_itself(self):
        labels = np.indices((12, 8, 10)).sum(0) % 3 + 1
        mesh = mwmesh.mesh(labels.astype(np.uint8), periodic="xy")
        mesh.save(self.path("m.vtu"), pairs=self.path("p.csv"))
        rows = np.loadtxt(self.path("p.csv"), delimiter=",", skiprows=1, dtype=int)
        apart = mesh.points[rows[:, 0] - 1] - mesh.points[rows[:, 1] - 1]
        np.testing.assert_allclose(apart, rows[:, 2:] * np.ptp(mesh.points, axis=0), atol=1e-9)
        mwmesh.mesh_to_file(labels.astype(np.uint8), self.path("m.inp"), periodic="xy",
                            pairs=self.path("q.csv"))
        np.testing.assert_array_equal(np.loadtxt(self.path("q.csv"), delimiter=",", skiprows=1), rows)
        with self.assertRaises(mwmesh.Error):
            mwmesh.mesh(labels.astype(np.uint8)).save(self.path("n.vtu"), pairs=self.path("p.csv"))

    def test_of_images_are_those_of_their_voxels(self):
        """Means times volumes add up to the sum of all voxels."""
        labels = grains()
        image = np.random.default_rng(2).normal(size=labels.shape)
        np.save(self.path("image.npy"), image)
        mesh = mwmesh.mesh(labels, spacing=2, sample={
            "hu": self.path("image.npy"), "most": self.path("image.npy") + ":max"})
        self.assertEqual(sorted(mesh.values), ["hu", "most"])
        self.assertAlmostEqual(mesh.values["hu"] @ mesh.tet_volumes(), 8 * image.sum(), 6)
        self.assertTrue((mesh.values["most"] >= mesh.values["hu"]).all())
        self.assertEqual(mesh.digest, mwmesh.mesh(labels, spacing=2).digest)
        again = pickle.loads(pickle.dumps(mesh))
        np.testing.assert_array_equal(again.values["hu"], mesh.values["hu"])
        mesh.save(self.path("m.vtu"))
        mesh.save(self.path("m.inp"), values=False, materials="hu=3")
        with self.assertRaisesRegex(mwmesh.UsageError, "^values: "):
            mesh.save(self.path("m.msh"), values=False, materials="hu=3")
        np.save(self.path("v.npy"), labels)
        part = mwmesh.mesh(self.path("v.npy"), crop=((2, 1, 3), (9, 8, 10)),
                           sample={"hu": self.path("image.npy")})
        self.assertAlmostEqual(part.values["hu"] @ part.tet_volumes(), image[3:10, 1:8, 2:9].sum(), 6)
        self.check_materials(mesh)
        with self.assertRaisesRegex(mwmesh.UsageError, "no values 'density'"):
            mesh.materials("density", 3)
        with self.assertRaisesRegex(mwmesh.UsageError, "from 1 to 10000"):
            mesh.materials("hu", 0)
        for count, bounds, named in (("x", None, "count"), (2.5, None, "count"), (3, 7, "bounds"),
                                     (3, (1, 0), "bounds"), (3, (0, np.nan), "bounds"),
                                     (3, (0, 1, 2), "bounds")):
            with self.assertRaisesRegex(mwmesh.UsageError, named):
                mesh.materials("hu", count, bounds)
        with self.assertRaisesRegex(mwmesh.UsageError, "no place for values"):
            mesh.save(self.path("m.bdf"))
        mesh.save(self.path("m.bdf"), values=False)
        mesh.save(self.path("m.inp"), materials="hu=4", deck=True)
        with open(self.path("m.inp"), encoding="ascii") as file:
            text = file.read()
        self.assertIn("*ELSET, ELSET=hu_4\n", text)
        self.assertIn("*STEP\n*STATIC\n", text)
        np.save(self.path("v.npy"), labels)
        mwmesh.mesh_to_file(self.path("v.npy"), self.path("f.inp"), spacing=2, materials="hu=4",
                            deck=True, sample={"hu": self.path("image.npy")})
        with open(self.path("f.inp"), encoding="ascii") as file:
            self.assertEqual(file.read().count("*SOLID SECTION"), text.count("*SOLID SECTION"))
        with self.assertRaisesRegex(mwmesh.UsageError, "deck is for .inp, .feb"):
            mesh.save(self.path("n.vtu"), deck=True)
        back = mwmesh.read(self.path("m.vtu"))
        self.assertEqual(list(back.values), ["hu", "most"])
        np.testing.assert_array_equal(back.values["hu"], mesh.values["hu"])

    def check_materials(self, mesh):
        """They are those of the program, which writes them by other code."""
        for text, arguments in (("hu=7", ("hu", 7)), ("hu=5:-0.5:0.25", ("hu", 5, (-0.5, 0.25)))):
            self.program("convert", "m.vtu", "m.inp", "--materials", text)
            found = mesh.materials(*arguments)
            with open(self.path("m.inp.materials.csv"), encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(found.tets.tolist(), [int(row["tets"]) for row in rows])
            self.assertGreater(np.count_nonzero(found.tets), 3)
            self.assertEqual(np.bincount(found.numbers)[1:].tolist(), found.tets.tolist())
            for column, numbers in (("from", found.begins), ("to", found.ends),
                                    ("volume", found.volumes)):
                np.testing.assert_allclose(numbers, [float(row[column]) for row in rows], 1e-12)
            used = found.tets > 0
            np.testing.assert_allclose(found.means[used], [float(r["mean"]) for r in rows if r["mean"]],
                                       1e-9, 1e-12)
            self.assertTrue(np.isnan(found.means[~used]).all())


class Seen(InFolder):
    """Pictures and windows."""

    def setUp(self):
        super().setUp()
        self.mesh = mwmesh.mesh(mwmesh.synth("spheres", (24, 24, 24), 3, 1))

    def test_a_notebook_shows_the_picture_of_the_program(self):
        self.mesh.save(self.path("m.vtu"))
        self.program("picture", "m.vtu", "-o", "m.png", "--pixels", "800x600")
        with open(self.path("m.png"), "rb") as file:
            self.assertEqual(self.mesh._repr_png_(), file.read())
        self.program("picture", "m.vtu", "-o", "m.png")
        with open(self.path("m.png"), "rb") as file:
            self.assertEqual(self.mesh.picture(), file.read())
        for bad in ({"width": 15}, {"height": 10**30}, {"width": "x"}):
            with self.assertRaisesRegex(mwmesh.UsageError, "pixels|width"):
                self.mesh.picture(**bad)
        self.assertIsNone(mwmesh.Mesh([], np.zeros((0, 4), int), [])._repr_png_())

    def test_print_says_what_the_program_says(self):
        labels = mwmesh.synth("spheres", (24, 24, 24), 3, 1)
        np.save(self.path("v.npy"), labels)
        said = self.program("mesh", "v.npy", "-o", "m.vtu")
        made = mwmesh.mesh(self.path("v.npy"))
        facts = ("tets ", "edges ", "shape ", "volumes ", "labels ", "checks ")
        for text in (str(made), str(pickle.loads(pickle.dumps(made)))):
            for line in said.splitlines():
                if line.startswith(facts):
                    self.assertIn(line, text)
            self.assertIn(": background 0 leaves it out", text)
        self.assertIn(html.escape(str(made)), made._repr_html_())
        self.assertIn("data:image/png;base64,", made._repr_html_())
        read = str(mwmesh.read(self.path("m.vtu"))).splitlines()
        self.assertEqual([line.split()[0] for line in read], ["tets", "edges", "shape", "labels"])
        self.assertEqual([line for line in said.splitlines() if line in read], read)
        self.assertIn("tets        0", str(mwmesh.Mesh([], np.zeros((0, 4), int), [])))
        made.report = {"output": 1}
        with self.assertRaisesRegex(mwmesh.InputError, "report"):
            str(made)

    @needs("vtkmodules")
    def test_pyvista_is_asked_for_what_is_not_around(self):
        pyvista = unittest.mock.MagicMock()
        with unittest.mock.patch.dict(sys.modules, {"pyvista": pyvista}), \
                unittest.mock.patch.object(mwmesh._mesh, "_can_draw", lambda: True):
            self.mesh.plot(off_screen=True)
            self.mesh.plot(labels=[1, 2])
            named = mwmesh.Mesh(self.mesh.points, self.mesh.tets, self.mesh.labels, {1: "neg"})
            named.plot(labels="neg")
            named.plot(labels=1)
        (first,), (second,), (third,), (fourth,) = (
            call.args for call in pyvista.wrap.call_args_list)
        for grid in (third, fourth):
            self.assertEqual(grid.GetNumberOfCells(), np.count_nonzero(self.mesh.labels == 1))
        inner = np.count_nonzero(self.mesh.labels != 0)
        self.assertEqual(first.GetNumberOfCells(), inner)
        self.assertEqual(second.GetNumberOfCells(), np.isin(self.mesh.labels, (1, 2)).sum())
        self.assertIn(unittest.mock.call(scalars="label", off_screen=True),
                      pyvista.wrap().plot.call_args_list)

    @needs("vtkmodules")
    def test_else_vtk_opens_the_window(self):
        window = unittest.mock.MagicMock()
        with unittest.mock.patch.dict(sys.modules, {"pyvista": None}), \
                unittest.mock.patch.dict(os.environ, {"DISPLAY": ":0"}), \
                unittest.mock.patch.object(mwmesh._mesh, "_can_draw", lambda: True), \
                unittest.mock.patch.object(mwmesh._mesh, "_window", window):
            self.mesh.plot()
        window().Start.assert_called_once()
        self.assertLess(window.call_args_list[0].args[0].GetNumberOfCells(), len(self.mesh.tets))

    @needs("vtkmodules")
    def test_without_a_display_there_is_a_picture_and_the_interpreter_lives(self):
        self.mesh.save(self.path("m.vtu"))
        code = ("import sys, mwmesh\n"
                "sys.modules['pyvista'] = None\n"
                "picture = mwmesh.read('m.vtu').plot(labels=1)\n"
                "assert picture._repr_png_() == picture\n"
                "open('m.png', 'wb').write(picture)\n")
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        for display in ({}, {"DISPLAY": ":54321"}):
            done = subprocess.run([sys.executable, "-c", code], cwd=self.folder,
                                  env={**environment, **display}, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("no window can be opened here", done.stderr)
            png = pathlib.Path(self.path("m.png"))
            self.assertTrue(png.read_bytes().startswith(b"\x89PNG"))
            png.unlink()
        with unittest.mock.patch.dict(sys.modules, {"pyvista": None}), \
                warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertTrue(self.mesh.plot(off_screen=True).startswith(b"\x89PNG"))

    def test_a_package_that_is_missing_is_named(self):
        missing = dict.fromkeys(("pyvista", "vtkmodules", "meshio"))
        with unittest.mock.patch.dict(sys.modules, missing):
            for call, name in ((self.mesh.plot, "vtk"), (self.mesh.to_meshio, "meshio"),
                               (self.mesh.to_pyvista, "pyvista")):
                with self.assertRaisesRegex(mwmesh.MissingPackageError, f"pip install {name}"):
                    call()
        self.assertTrue(issubclass(mwmesh.MissingPackageError, ImportError))


class OtherTools(InFolder):

    def setUp(self):
        super().setUp()
        self.mesh = mwmesh.mesh(grains(), names={1: "one", 4: "four"})

    def test_files(self):
        for name in ("m.vtu", "m.vtkhdf", "m.mesh", "m.msh"):
            self.mesh.save(self.path(name))
            self.assertEqual(mwmesh.read(self.path(name)).digest, self.mesh.digest, name)

    @needs("meshio")
    def test_meshio(self):
        made = self.mesh.to_meshio()
        np.testing.assert_array_equal(made.cells_dict["tetra"], self.mesh.tets)
        np.testing.assert_array_equal(made.cell_data["label"][0], self.mesh.labels)
        self.assertEqual({name: tuple(row) for name, row in made.field_data.items()},
                         {"one": (1, 3), "four": (4, 3)})

    def test_names_that_several_labels_have_are_told_apart(self):
        made = mwmesh._mesh._distinct({1: "A", 2: "A", 3: "A (1)", 4: "b"})
        self.assertEqual(made, {"A (1)": 3, "b": 4, "A (1) (1)": 1, "A (2)": 2})
        mesh = mwmesh.mesh(grains(), names={1: "A", 2: "A"})
        with unittest.mock.patch.object(mwmesh._mesh, "_package") as package:
            mesh.to_meshio()
        fields = package.return_value.Mesh.call_args.kwargs["field_data"]
        self.assertEqual({name: row[0] for name, row in fields.items()}, {"A (1)": 1, "A (2)": 2})

    @needs("vtkmodules")
    def test_vtk(self):
        from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
        from vtkmodules.util.numpy_support import vtk_to_numpy
        grid = self.mesh.to_vtk()
        self.assertEqual(grid.GetNumberOfCells(), len(self.mesh.tets))
        ids, names = (grid.GetFieldData().GetAbstractArray(f"label_{key}") for key in ("id", "name"))
        self.assertEqual({int(vtk_to_numpy(ids)[i]): names.GetValue(i) for i in range(2)},
                         self.mesh.names)
        quality = vtkMeshQuality()
        quality.SetInputData(grid)
        quality.SetTetQualityMeasureToVolume()
        quality.Update()
        volumes = vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality"))
        np.testing.assert_allclose(volumes, self.mesh.tet_volumes(), rtol=1e-9)


class Runs(InFolder):

    def test_progress(self):
        seen = []
        mwmesh.mesh(grains((60, 60, 60), 40), window=16, threads=1,
                    progress=lambda done, total, left: seen.append((done, total)))
        self.assertEqual(seen, sorted(seen))
        self.assertEqual(*seen[-1])
        with self.assertRaises(ZeroDivisionError):
            mwmesh.mesh(grains((60, 60, 60), 40), window=16, threads=1,
                        progress=lambda *_: 1 / 0)

    def test_python_goes_on_meanwhile(self):
        # The interpreter would stand still if the run kept its lock.
        ticks = []
        done = threading.Event()

        def tick():
            while not done.wait(0.01):
                ticks.append(time.monotonic())

        thread = threading.Thread(target=tick)
        thread.start()
        start = time.monotonic()
        mwmesh.mesh(grains((70, 70, 70), 60), threads=1)
        seconds = time.monotonic() - start
        done.set()
        thread.join()
        self.assertGreater(len(ticks), seconds / 0.01 / 20)

    def test_threads_of_python(self):
        expected, made = mwmesh.mesh(grains()).digest, []
        threads = [threading.Thread(target=lambda: made.append(mwmesh.mesh(grains()).digest))
                   for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(made, [expected] * 4)

    def test_ctrl_c(self):
        script = ("import mwmesh, sys\n"
                  "v = mwmesh.synth('noise', (90, 90, 90), 3, 1)\n"
                  "try:\n"
                  "  mwmesh.mesh(v, workdir='w', progress=lambda *a: print(a, flush=True))\n"
                  "except KeyboardInterrupt:\n"
                  "  print('stopped', flush=True)\n")
        child = subprocess.Popen([sys.executable, "-c", script], cwd=self.folder,
                                 stdout=subprocess.PIPE, text=True)
        child.stdout.readline()
        child.send_signal(signal.SIGINT)
        start = time.monotonic()
        with child.stdout:
            rest = child.stdout.read()
        self.assertEqual(child.wait(), 0)
        self.assertIn("stopped", rest)
        self.assertLess(time.monotonic() - start, 60)

    def test_ctrl_c_while_a_server_is_silent(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            server.settimeout(60)
            address = f"http://127.0.0.1:{server.getsockname()[1]}/p"
            for call in (f"mwmesh.mesh('{address}')", f"mwmesh.mesh(v, sample={{'hu': '{address}'}})"):
                with self.subTest(call):
                    script = ("import mwmesh\n"
                              "v = mwmesh.synth('voronoi', (9, 9, 9), 3, 1)\n"
                              "try:\n"
                              f"  {call}\n"
                              "except KeyboardInterrupt:\n"
                              "  print('stopped')\n")
                    child = subprocess.Popen([sys.executable, "-c", script], cwd=self.folder,
                                             stdout=subprocess.PIPE, text=True)
                    self.addCleanup(child.kill)
                    with server.accept()[0]:
                        child.send_signal(signal.SIGINT)
                        start = time.monotonic()
                        self.assertEqual(child.communicate(timeout=100)[0], "stopped\n")
                        self.assertLess(time.monotonic() - start, 20)

    def test_daemon_threads_end_with_the_interpreter(self):
        # A thread that asks for the lock too late is ended by force, which aborts the program.
        work = {"a mesh": "mwmesh.mesh(voxels, threads=1, window=16)",
                "digests": "[mesh._core.digest() for _ in range(9999)]",
                "meshes": "[mwmesh.mesh(voxels[:9], threads=1) for _ in range(9999)]"}
        for name, call in work.items():
            with self.subTest(name):
                script = ("import mwmesh, os, sys, threading, time\n"
                          "class Slow:\n"  # the end takes long enough for the thread to see it
                          "  def __del__(self, sleep=time.sleep): sleep(.3)\n"
                          "slow = Slow()\n"
                          "begun = threading.Event()\n"
                          "voxels = mwmesh.synth('voronoi', (70, 70, 70), 90, 3)\n"
                          "mesh = mwmesh.mesh(voxels[:30], report=False, certify='off')\n"
                          f"def work():\n  begun.set()\n  {call}\n"
                          "threading.Thread(target=work, daemon=True).start()\n"
                          "begun.wait()\n"
                          "time.sleep(.05)\n"
                          "child = os.fork()\n"  # it waits for no thread, as it has one alone
                          "if child == 0: sys.exit()\n"
                          "sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n")
                done = subprocess.run([sys.executable, "-c", script], capture_output=True, timeout=600)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertNotIn(b"Traceback", done.stderr)

    def test_a_child_that_a_function_for_progress_forks_can_exit(self):
        script = ("import mwmesh, os, sys\n"
                  "def fork(*_):\n"
                  "  child = os.fork()\n"
                  "  if child == 0: sys.exit(3)\n"
                  "  print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
                  "mwmesh.mesh(mwmesh.synth('voronoi', (9, 9, 9), 3, 1), progress=fork)\n")
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True,
                              timeout=120)
        self.assertEqual(set(done.stdout.split()), {"3"}, done.stderr)

    def test_resume(self):
        volume = grains((60, 60, 60), 40)
        options = {"window": 16, "workdir": self.path("work"), "threads": 1}

        class Enough(Exception):
            pass

        def stop(done, total, _left):
            if done > total / 4:
                raise Enough

        with self.assertRaises(Enough):
            mwmesh.mesh(volume, progress=stop, **options)
        self.assertTrue(os.path.isdir(self.path("work")))
        mesh = mwmesh.mesh(volume, resume=True, **options)
        self.assertGreater(mesh.report["engine"]["windows_resumed"], 0)
        self.assertEqual(mesh.digest, mwmesh.mesh(volume, window=16).digest)

    def test_a_kept_folder_of_a_run_that_was_interrupted(self):
        def stop(done, total, _seconds):
            if 2 * done > total:
                raise StopIteration

        volume = grains((40, 40, 40))
        settings = {"order": "colour", "window": 16, "keep": self.path("kept")}
        with self.assertRaises(StopIteration):
            mwmesh.mesh(volume, threads=1, progress=stop, **settings)
        made = mwmesh.mesh(volume, from_kept=True, **settings)
        self.assertEqual(made.digest, mwmesh.mesh(volume, order="colour", window=16).digest)

    def test_memory_is_text_or_bytes(self):
        mesh = mwmesh.mesh(grains(), memory="512MiB")
        self.assertEqual(mesh.report["settings"]["memory"], 512 << 20)
        self.assertEqual(mwmesh.mesh(grains(), memory=512 << 20).digest, mesh.digest)
        with self.assertRaises(mwmesh.ResourceError):
            mwmesh.mesh(grains(), memory="1M")

    def test_warnings_of_a_run_are_those_of_python(self):
        labels = grains().astype(np.float32) + np.float32(1e-4)
        with self.assertWarnsRegex(RuntimeWarning, "within 0.001 of whole ones") as caught:
            rounded = mwmesh.mesh(labels)
        self.assertEqual(caught.filename, __file__)
        self.assertEqual(rounded.digest, mwmesh.mesh(grains().astype(np.float32)).digest)
        with self.assertWarnsRegex(RuntimeWarning, "1 x 1 x 25 layers.*; spacing sets another"):
            mwmesh.mesh(grains()[:2, :6, :6], spacing=(1, 1, 25))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            mwmesh.mesh(grains())

    @needs("zarr")
    def test_labels_that_are_read_by_box_are_rounded_too(self):
        import zarr
        labels = grains().astype(np.float32)
        with self.assertWarnsRegex(RuntimeWarning, "within 0.001 of whole ones"):
            rounded = mwmesh.mesh(zarr.array(labels - np.float32(1e-4), chunks=(9, 9, 9)))
        self.assertEqual(rounded.digest, mwmesh.mesh(labels).digest)

    def test_an_image_is_meshed_by_force_alone(self):
        random = np.random.default_rng(2)
        grey = np.round(12 * np.arange(16) + random.normal(0, 8, (12, 14, 16))).astype(np.int16)
        with self.assertRaisesRegex(mwmesh.UsageError, "or force meshes it"):
            mwmesh.mesh(grey)
        self.assertGreater(len(mwmesh.mesh(grey, force=True, certify="off").tets), 1000)

    def test_memory_does_not_grow(self):
        labels = grains((4, 4, 4), 3)
        fast = {"threads": 1, "report": False, "certify": "off"}

        def fail(*_):
            raise KeyboardInterrupt

        def work(times):
            for turn in range(times):
                if turn % 10:
                    self.assertEqual(mwmesh.mesh(labels, names={1: "one"}, **fast).points.shape[1], 3)
                else:
                    with self.assertRaises(KeyboardInterrupt):
                        mwmesh.mesh(labels, progress=fail, **fast)
            return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

        before = work(100)
        self.assertLess(work(1000) - before, 1 << 10)  # in KiB

    @needs("tqdm")
    def test_bar(self):
        mwmesh.mesh(grains(), progress=True)


class Errors(InFolder):

    def check(self, error, piece, *arguments, call=mwmesh.mesh, **more):
        with self.assertRaises(error) as caught:
            call(*arguments, **more)
        self.assertIn(piece, str(caught.exception))
        self.assertNotIn("--", str(caught.exception))
        self.assertIsInstance(caught.exception, mwmesh.Error)

    def test_without_the_package_of_the_bar_there_is_a_line(self):
        with unittest.mock.patch.dict(sys.modules, {"tqdm": None, "tqdm.auto": None}), \
                contextlib.redirect_stderr(io.StringIO()) as shown:
            mwmesh.mesh(grains(), progress=True)
            self.assertRegex(shown.getvalue(), r"\r(\d+)/\1 windows")
            said = len(shown.getvalue())
            mwmesh.mesh(grains())
            self.assertEqual(len(shown.getvalue()), said)

    def test_values_that_make_no_sense_name_their_argument(self):
        labels = grains()
        nan, inf = float("nan"), float("inf")
        values = {
            "spacing": (-1, 0, nan, inf, (1, -1, 1), (1, 1), (1, nan, 1), "x", {}, [[1, 1, 1]]),
            "origin": (nan, (0, inf, 0), (1, 2), "x"),
            "affine": ("x", np.eye(3), np.full((4, 4), nan), np.diag([1, 1, 1, 2]), -1),
            "axes": ("yzx", 3), "frame": (3, "mni"), "unit": (3,), "names": (3, {1: 2}, {2**64: "a"}),
            "threads": (-1, 1025, 30_000, 10**9, 2**31, 10**30, 1.5, nan, True, "2", None),
            "memory": (-1, 0, 1.5, 10**30, "x", "-1G", nan, True),
            "labels": ([2**64], [-1], [1.5], [nan], [True], [None], [], "x", 2**64, {1: 2}.values),
            "background": (2**70, -1, 0.5, "Air", True, [1]),
            "merge": ({2**64: 1}, {1: 2**64}, {1: -1}, {"a": 1}, {1: 1.5}),
            "drop_specks": (-1, 2.5, 10**30, (5, 7), "x", True),
            "weld": ([2**64], [-1], [1.5], [True], [], "x", 77),
            "sample": (3, "x", {"hu": 3}, {"2": "a"}, {"hu": "a\0b"}),
            "workdir": (3, "a\0b"), "resume": ("yes", 2), "certify": (True, "maybe", []),
            "report": ("no",), "parts": (0, -1, "most", 1.5, None, True), "open_hinges": ("yes", 2),
            "split": ("1|2", 3, [1], [(1, 1)], [(1, 2, 0)], [(1, "x")], [(1, 77)]),
            "cohesive": ("1|2", 3, [(1, 1)], [(1, 77)], [(0, 1), (1, 0)]),
            "size": ({1: -1}, {1: nan}, {1: "x"}, {"Liver": 3}, {2**64: 3}),
            "window": (5, 1001.0, 2**40, True, nan, "x", [32]), "max_distance": (nan, inf, -1, "x"),
            "surface": ("smoth", 1), "preset": ("quick",), "gradation": (0.2, -1),
        }
        values["merge"] += ([(1, 2)],)
        values["drop_specks"] += ((5,),)
        values["changed"] = (5, [5])
        values["progress"] = (5, "no", [])
        for name, bad in values.items():
            for value in bad:
                with self.subTest(name=name, value=value):
                    self.check(ValueError, name, labels, **{name: value})
        self.check(ValueError, "got an array of shape", labels,
                   size=np.ones(labels.shape))
        self.check(ValueError, "path with ';' in it", labels, sample={"hu": self.path("a;b.npy")})
        self.check(ValueError, "did you mean spacing", labels, call=mwmesh.as_volume, spacings=1)
        self.check(ValueError, "max_distance", labels, call=mwmesh.mesh(labels).verify, max_distance=1)
        self.assertEqual(mwmesh.mesh(labels, affine=np.eye(4)[:3]).digest,
                         mwmesh.mesh(labels, affine=np.eye(4)).digest)
        self.assertEqual(mwmesh.mesh(labels, labels={1, 2}, count=500.0).digest,
                         mwmesh.mesh(labels, labels=[1, 2], count=500).digest)
        np.save(self.path("v.npy"), labels)
        values = {"spacing": (-1, nan, (1, 1)), "origin": (inf,), "scale": (-1, 2**40, 0.5, 0),
                  "use_form": ("pixdim", 1, "qform"),
                  "dataset": (3, "a"), "frame": ("mni",),
                  "crop": (((0, 0), (1, 1)), ((0, 0, 0), (1, 1, 1.5)), ((-1, 0, 0), (4, 4, 4)), 3,
                           ((0, 0, 0), (2**70, 4, 4)))}
        for name, bad in values.items():
            for value in bad:
                with self.subTest(name=name, value=value):
                    self.check(ValueError, name, self.path("v.npy"), **{name: value})
        values = {"shape": ((-1, 2, 2), (2, 2), "x", (2, 2, 2.5), (2**40, 2**40, 2**40), 3),
                  "labels": (-1, 2**64, 1.5, True), "seed": (-1, 2**64, nan), "kind": ("cubes", 3)}
        for name, bad in values.items():
            for value in bad:
                with self.subTest(name=name, value=value):
                    good = {"kind": "noise", "shape": (4, 4, 4)}
                    self.check(ValueError, name, call=mwmesh.synth, **{**good, name: value})

    def test_numbers_of_numpy_are_numbers(self):
        labels = grains()
        expected = mwmesh.mesh(labels, spacing=2, labels=[1, 2], window=32, max_distance=1.5).digest
        for kind in (np.uint8, np.int32, np.float32, np.float64):
            mesh = mwmesh.mesh(labels, spacing=kind(2), labels=np.array([1, 2], kind),
                               window=int(kind(32)), max_distance=np.float32(1.5),
                               threads=kind(1), inner_vertices=np.bool_(False))
            self.assertEqual(mesh.digest, expected)
        self.assertEqual(mwmesh.mesh(labels, spacing=np.full(3, 2), labels=np.array([2, 1])).digest,
                         expected)
        np.save(self.path("v.npy"), labels)
        self.program("mesh", "v.npy", "-o", "v.vtu", "--spacing", "2", "--labels", "1,2")
        self.assertEqual(mwmesh.read(self.path("v.vtu")).digest, expected)

    def test_paths(self):
        mesh = mwmesh.mesh(grains())
        for path in ("a\0b", 3, None):
            for call in (mwmesh.read, mesh.save, lambda p: mwmesh.mesh_to_file(grains(), p)):
                with self.assertRaises(mwmesh.UsageError):
                    call(path)
        with self.assertRaises(mwmesh.UsageError):
            mwmesh.mesh("a\0b")

    def test_arguments(self):
        labels = grains()
        for bad in ({"threads": 5000}, {"max_distance": -1}, {"labels": ["x"]}, {"resume": True}):
            with self.assertRaises(mwmesh.UsageError) as caught:
                mwmesh.mesh(labels, **bad)
            self.assertEqual(caught.exception.option, *bad)
        self.check(mwmesh.UsageError, "mean max_distance?", labels, max_distanse=1)
        self.check(mwmesh.UsageError, "mean background?", labels, backgroud=1)
        self.check(mwmesh.UsageError, "there are preset", labels, xyzzy=1)
        self.check(mwmesh.UsageError, "even", labels, window=5)
        self.check(mwmesh.UsageError, "axes", labels, axes="yzx")
        self.check(mwmesh.UsageError, "4 axes", labels[None])
        self.check(mwmesh.UsageError, "type", labels.astype(complex))
        self.check(mwmesh.UsageError, "affine", labels, affine=np.eye(4), spacing=1)
        self.check(mwmesh.UsageError, "no label 99", labels, labels=[99])
        self.check(mwmesh.UsageError, "crop: for files only, and this is an array; slice it", labels,
                   crop=((0, 0, 0), (1, 1, 1)))
        self.check(mwmesh.UsageError, "object, trust_paths: for files", labels, object=1,
                   trust_paths=True)
        self.check(mwmesh.ResourceError, "of 1.5MiB is too small", labels, memory=3 << 19)
        self.check(mwmesh.ResourceError, "of 2 bytes is too small; memory 6", labels, memory=2)
        self.check(mwmesh.UsageError, "shape", labels[:0])
        self.check(mwmesh.InputError, "1.5", np.full((2, 2, 2), 1.5))
        self.check(mwmesh.InputError, "nowhere.npy", self.path("nowhere.npy"))

    def test_arrays_that_repeat_themselves(self):
        slab = np.zeros((10, 12), np.uint8)
        slab[3:8, 4:9] = 1
        for array in (np.broadcast_to(slab[..., None], (10, 12, 9)), np.broadcast_to(slab, (9, 10, 12)),
                      np.broadcast_to(np.uint8(3), (8, 8, 8))):
            self.assertEqual(mwmesh.mesh(array).digest, mwmesh.mesh(array.copy()).digest)

    def test_types_and_frames_that_are_not_taken(self):
        self.check(mwmesh.UsageError, 'convert others, as with astype', grains().astype(np.float16))
        for place in ({}, {"affine": np.eye(4)}):
            self.check(mwmesh.UsageError, "frame: expected own, ras, lps or voxel, got 'xyz'",
                       grains(), frame="xyz", **place)
        for frame in ("own", "ras", "lps", "voxel"):
            mwmesh.mesh(grains(), frame=frame)

    def test_masked_arrays(self):
        masked = np.ma.masked_equal(grains(), 2)
        self.check(mwmesh.UsageError, "is masked; fill it", masked)

        class Blocks:
            shape, dtype = masked.shape, masked.dtype

            def __getitem__(self, box):
                return masked[box]

        self.check(mwmesh.UsageError, "is masked; fill it", Blocks())
        self.check(mwmesh.UsageError, "names", grains(), names={"a", "b"})

    def test_regions_that_are_not_what_was_asked(self):
        class Blocks:
            def __init__(self, array, dtype, turn=False):
                self.array, self.turn = array, turn
                self.shape, self.dtype = array.shape, np.dtype(dtype)

            def __getitem__(self, box):
                block = self.array[box]
                return block.reshape(block.shape[::-1]) if self.turn else block

        labels = np.ones((6, 7, 8), np.int64)
        mwmesh.mesh(Blocks(labels, np.uint8))
        self.check(mwmesh.InputError, "another shape", Blocks(labels, np.int64, turn=True))
        for label, dtype in ((-1, np.uint8), (-1, np.uint64), (300, np.uint8), (200, np.int8)):
            labels[2, 3, 4] = label
            self.check(mwmesh.InputError, "cannot hold", Blocks(labels, dtype))
        labels[2, 3, 4] = -1
        mwmesh.mesh(Blocks(labels, np.int8))
        large = labels.astype(np.uint64)
        self.check(mwmesh.InputError, "cannot hold", Blocks(large, np.int64))
        for bad in (1.5, float("nan"), float("inf"), 2.0**64):
            floats = np.ones((6, 7, 8))
            floats[2, 3, 4] = floats[2, 4, 3] = bad
            for array in (floats, Blocks(floats, np.float64)):
                self.check(mwmesh.InputError, "array: voxel (4, 3, 2)", array)
                self.check(mwmesh.InputError, "array: voxel (2, 4, 3)", array, axes="xyz")

    def test_sheared_affines_have_a_way_out(self):
        sheared = np.array([[2, 0.6, 0, 5], [0, 0.8, 0, 6], [0, 0, 3, 7]])
        self.check(mwmesh.InputError, "give frame voxel", grains(), affine=sheared)
        self.assertEqual(mwmesh.mesh(grains(), affine=sheared, frame="voxel").digest,
                         mwmesh.mesh(grains(), axes="xyz", spacing=(2, 1, 3)).digest)

    def test_meshes(self):
        mesh = mwmesh.mesh(grains())
        with self.assertRaises(mwmesh.UsageError):
            mesh.save(self.path("m.docx"))
        self.assertEqual(os.listdir(self.folder), [])
        points, tets, labels = np.zeros((4, 3)), np.array([[0, 1, 2, 3]]), [1]
        for bad, piece in (((np.zeros((4, 2)), tets, labels), "points"),
                           (("x", tets, labels), "points"),
                           ((points, tets[:, :3], labels), "tets"),
                           ((points, tets + 0.5, labels), "tets"),
                           ((points, tets + 1, labels), "tets"),
                           ((points, tets - 1, labels), "tets"),
                           ((points, tets, [1.5]), "labels"),
                           ((points, tets, [float("nan")]), "labels"),
                           ((points, tets, ["a"]), "labels"),
                           ((points, tets, [1, 2]), "label"),
                           ((points, tets, [[1]]), "label")):
            self.check(mwmesh.UsageError, piece, *bad, call=mwmesh.Mesh)
        self.assertEqual(mwmesh.Mesh(points, tets * 1.0, [2.0]).tets.tolist(), tets.tolist())


class Sessions(InFolder):

    def expect_fresh(self, session):
        fresh = mwmesh.mesh(session.array, order="colour", window=8)
        self.assertTrue(np.array_equal(session.mesh.points, fresh.points))
        self.assertTrue(np.array_equal(session.mesh.tets, fresh.tets))
        self.assertTrue(np.array_equal(session.mesh.labels, fresh.labels))

    def expect_edits(self, source, array, **settings):
        """Edits a session of a source and its array, and compares with fresh runs of `array`, which
        is called with the labels as they are."""
        session = mwmesh.Session(source, window=8, **settings)
        for box, label in ((((1, 1, 1), (4, 3, 5)), 3), (((6, 2, 2), (9, 9, 6)), 2)):
            session.update(box, label)
            fresh = array(session.array)
            self.assertEqual(session.mesh.digest, fresh.digest)
            self.assertEqual(session.mesh.names, fresh.names)
        return session

    @needs("nibabel")
    def test_a_session_takes_images_and_files(self):
        import nibabel
        affine = np.array([[-1.5, 0, 0, 7], [0, 2, 0, -3], [0, 0, 2.5, 11], [0, 0, 0, 1]])
        labels = grains((12, 10, 14)).astype(np.uint8)
        image = nibabel.Nifti1Image(labels, affine)
        nibabel.save(image, self.path("v.nii"))
        names = {2: "two"}
        def of_image(array):
            return mwmesh.mesh(nibabel.Nifti1Image(array, affine, image.header), names=names,
                               labels=["two", 3], window=8, order="colour")
        session = self.expect_edits(image, of_image, names=names, labels=["two", 3])
        self.assertEqual((session.array.dtype, session.array.shape), (labels.dtype, labels.shape))
        session = self.expect_edits(self.path("v.nii"), lambda array: of_image(array.T),
                                    names=names, labels=["two", 3])
        self.assertEqual((session.array.dtype, session.array.shape), (np.uint8, labels.T.shape))
        opened = mwmesh.Session(mwmesh.as_volume(image), window=8)
        self.assertTrue(np.array_equal(opened.array, labels.T))
        with open(self.path("v.nii"), "r+b") as file:
            file.seek(112)  # scl_slope
            file.write(np.float32(300).tobytes())
        scaled = mwmesh.Session(self.path("v.nii"), window=8)
        self.assertTrue(np.array_equal(scaled.array, 300 * labels.T.astype(np.int64)))
        for wrong in ({"values": "probabilities"}, {"overlap": "all"}, {"object": 3}):
            with self.assertRaisesRegex(mwmesh.UsageError, f"^{[*wrong][0]}: a session"):
                mwmesh.Session(self.path("v.nii"), **wrong)

    @needs("zarr")
    def test_a_session_takes_lists_and_arrays_that_are_read_by_box(self):
        import zarr
        labels = grains((12, 10, 14))
        for source in (labels.tolist(), zarr.array(labels, chunks=(4, 5, 6))):
            self.expect_edits(source, lambda array: mwmesh.mesh(
                array, spacing=(1, 2, 1), window=8, order="colour"), spacing=(1, 2, 1))

    def test_edits_that_change_nothing(self):
        session = mwmesh.Session(grains(), window=8)
        digest = session.mesh.digest
        for edit in ((session.array.copy(),), (((1, 1, 1), (2, 2, 2)), session.array[1, 1, 1])):
            mesh, delta = session.update(*edit)
            self.assertEqual((mesh.digest, delta["voxels_changed"]), (digest, 0))

    def test_updates_of_two_threads_come_one_after_the_other(self):
        session = mwmesh.Session(grains(), window=8)
        boxes = [((k, 2, 2), (k + 3, 6, 6)) for k in (1, 5, 9)]
        with concurrent.futures.ThreadPoolExecutor(3) as threads:
            done = [threads.submit(session.update, box, 77) for box in boxes]
        for update in done:
            update.result()
        expected = grains()
        for (x0, y0, z0), (x1, y1, z1) in boxes:
            expected[z0:z1, y0:y1, x0:x1] = 77
        np.testing.assert_array_equal(session.array, expected)
        self.assertEqual(session.mesh.digest, mwmesh.mesh(expected, window=8, order="colour").digest)

    def test_a_session_goes_on_with_the_folder_of_another(self):
        labels = grains()
        with self.assertRaises(mwmesh.UsageError):
            mwmesh.Session(labels, from_kept=True, window=8)
        mwmesh.Session(labels, keep=self.path("kept"), window=8).update(((1, 2, 2), (4, 6, 6)), 77)
        labels[2:6, 2:6, 1:5] = 77  # one voxel more along x
        session = mwmesh.Session(labels, keep=self.path("kept"), from_kept=True, window=8)
        self.expect_fresh(session)
        remesh = session.mesh.report["engine"]["remesh"]
        self.assertTrue(any(march["skipped"] > 0 for march in remesh["marches"]))
        session.update(((9, 9, 9), (12, 12, 12)), 5)
        self.expect_fresh(session)

    def test_another_run_in_the_folder_does_not_leak_into_the_mesh(self):
        mine = mwmesh.Session(grains(), keep=self.path("kept"), window=8)
        other = mwmesh.Session(grains(), keep=self.path("kept"), from_kept=True, window=8)
        other.update(((1, 1, 1), (3, 3, 3)), 77)
        with self.assertWarnsRegex(RuntimeWarning, "another run was here"):
            mine.update(((6, 6, 6), (8, 8, 8)), 5)
        self.expect_fresh(mine)

    def test_the_byte_order_of_arrays_does_not_matter(self):
        labels = grains().astype(np.int32)
        session = mwmesh.Session(labels.astype(">i4"), window=8)
        labels[3:5, 3:5, 3:5] = 77
        session.update(labels)
        self.assertTrue(np.array_equal(session.array, labels))
        self.expect_fresh(session)

    def test_an_update_may_not_update(self):
        sessions = []
        def nested(*_):
            for session in sessions:
                session.update(((0, 0, 0), (1, 1, 1)), 5)
        session = mwmesh.Session(grains(), window=8, progress=nested)
        sessions.append(session)
        with self.assertRaisesRegex(mwmesh.UsageError, "may not update again"):
            session.update(((1, 2, 2), (4, 6, 6)), 77)

    def test_ten_edits_give_the_meshes_of_fresh_runs(self):
        random = np.random.default_rng(5)
        session = mwmesh.Session(grains() * 3, window=8)
        self.expect_fresh(session)
        for step in range(10):
            lo = [int(random.integers(0, n - 3)) for n in (22, 18, 20)]
            hi = [n + 3 for n in lo]
            old = session.array.copy()
            if step % 3 == 2:
                mesh, delta = session.update(np.where(old == old[9, 9, 9], old[0, 0, 0], old))
            else:
                mesh, delta = session.update((lo, hi), int(old[9, 9, 9]) + step % 2)
            self.assertIs(mesh, session.mesh)
            self.assertEqual(delta["voxels_changed"], int((old != session.array).sum()))
            self.expect_fresh(session)

    def test_a_folder_that_may_not_hold_all_gives_the_same_meshes(self):
        sizes = []
        for limit in (None, "120KB"):
            folder = pathlib.Path(self.path(f"kept {limit}"))
            session = mwmesh.Session(grains(), keep=folder, keep_bytes=limit, window=8)
            for lo in ((2, 3, 4), (9, 9, 9)):
                session.update((lo, tuple(v + 2 for v in lo)), 1)
                self.expect_fresh(session)
            sizes.append(sum(file.stat().st_size for file in folder.iterdir()))
        self.assertLess(sizes[1], sizes[0])
        with self.assertRaises(mwmesh.UsageError):
            mwmesh.mesh(grains(), keep_bytes="1GB")

    def test_arguments_that_are_none_are_not_given(self):
        session = mwmesh.Session(grains(), affine=None, axes=None, window=8)
        session.update(((2, 3, 4), (5, 6, 6)), 1)
        self.expect_fresh(session)

    def test_updates_that_raise_leave_no_labels_behind(self):
        run = mwmesh.mesh

        def run_and_be_interrupted(*arguments, **settings):
            run(*arguments, **settings)
            raise KeyboardInterrupt

        volume = grains((20, 16, 12))
        session = mwmesh.Session(volume, window=8)
        mesh = session.mesh
        for label in (50, 51):
            for box in (((3, 3, 3), (6, 6, 6)), ((12, 2, 2), (14, 4, 4))):
                with unittest.mock.patch.object(mwmesh, "mesh", run_and_be_interrupted), \
                        self.assertRaises(KeyboardInterrupt):
                    session.update(box, label)
            self.assertTrue(np.array_equal(session.array, volume))
            self.assertIs(session.mesh, mesh)
            volume[8:10, 8:10, 8:10] = label + 10
            mesh, delta = session.update(((8, 8, 8), (10, 10, 10)), label + 10)
            self.assertEqual(delta["voxels_changed"], 8)
            self.assertEqual(mesh.digest, run(volume, order="colour", window=8).digest)

    def test_a_folder_that_nobody_named_goes_without_a_warning(self):
        with unittest.mock.patch.object(tempfile, "tempdir", self.folder):
            session = mwmesh.Session(grains(), window=8)
        self.assertEqual(len(os.listdir(self.folder)), 1)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with unittest.mock.patch.object(sys, "unraisablehook") as hook:
                del session
                gc.collect()
        hook.assert_not_called()
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_session_cannot_be_copied(self):
        session = mwmesh.Session(grains(), window=8)
        for copied in (copy.copy, copy.deepcopy, pickle.dumps):
            with self.assertRaises(mwmesh.UsageError):
                copied(session)

    def test_edits_that_make_no_sense_change_nothing(self):
        session = mwmesh.Session(grains().astype(np.uint8), keep=self.path("kept"), window=8)
        before = session.array.copy()
        box = ((0, 0, 0), (2, 2, 2))
        for wrong in (300, -1, 2.7, "a", None, np.full((2, 2, 2), 300), np.full((2, 2, 2), 1.5),
                      np.zeros((3, 2, 2), int), [1, 2, 3]):
            with self.subTest(values=wrong), self.assertRaises(mwmesh.UsageError):
                session.update(box, wrong)
        for wrong in [(((0, 0, 0), (99, 1, 1)), 1), (before[1:],), (), (1, 2, 3)]:
            with self.assertRaises(mwmesh.UsageError):
                session.update(*wrong)
        masked = np.ma.masked_equal(before, before[0, 0, 0])
        for edit in ((masked,), (box, masked[:2, :2, :2])):
            with self.assertRaisesRegex(mwmesh.UsageError, "is masked"):
                session.update(*edit)
        with self.assertRaisesRegex(mwmesh.UsageError, "is masked"):
            mwmesh.Session(masked)
        self.assertTrue(np.array_equal(session.array, before))
        floats = mwmesh.Session(before.astype(np.float64), window=8)
        for wrong in (2**53 + 1, np.full((2, 2, 2), 2**53 + 1), 2**64 - 1):
            with self.assertRaisesRegex(mwmesh.UsageError, "can hold"):
                floats.update(box, wrong)
        with self.assertRaises(mwmesh.UsageError):
            mwmesh.Session(before, order="raster")
        with self.assertRaises(mwmesh.UsageError):
            mwmesh.Session(before, keep=self.path("kept"), window=8)


if __name__ == "__main__":
    unittest.main()
