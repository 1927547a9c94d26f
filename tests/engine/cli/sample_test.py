#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Values of images in tets against tets that numpy splits along all planes of the image's grid."""
import json
import os
import sys
import unittest

from program import enter_folder, refused, run

try:
    import h5py
    from reading_meshio import meshio
    import nibabel
    import numpy as np
    from netCDF4 import Dataset
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

LEAST = 1e-6  # of a tet or a voxel: less counts as nothing


def volume(tets):
    edges = tets[:, 1:] - tets[:, :1]
    return np.abs(np.linalg.det(edges)) / 6


def split(tets, of, axis, bound):
    """Parts of tets [n, 4, 3] on both sides of a plane, and which tet each is of."""
    below = tets[:, :, axis] < bound
    count = below.sum(1)
    out, owners = [tets[(count == 0) | (count == 4)]], [of[(count == 0) | (count == 4)]]
    for many in (1, 2, 3):
        chosen = count == many
        if not chosen.any():
            continue
        order = np.argsort(~below[chosen], axis=1, kind="stable")
        if many == 3:
            order = order[:, ::-1]
        corners = np.take_along_axis(tets[chosen], order[:, :, None], axis=1)

        def cut(i, j):
            p, q = corners[:, i], corners[:, j]
            share = (bound - p[:, axis]) / (q[:, axis] - p[:, axis])
            middle = p + share[:, None] * (q - p)
            middle[:, axis] = bound
            return middle

        a, b, c, d = (corners[:, i] for i in range(4))
        if many == 2:
            ac, ad, bc, bd = cut(0, 2), cut(0, 3), cut(1, 2), cut(1, 3)
            prisms = [(a, ac, ad, b, bc, bd), (c, ac, bc, d, ad, bd)]
        else:
            ab, ac, ad = cut(0, 1), cut(0, 2), cut(0, 3)
            out.append(np.stack([a, ab, ac, ad], axis=1))
            owners.append(of[chosen])
            prisms = [(ab, ac, ad, b, c, d)]
        for p in prisms:
            for rows in ((0, 1, 2, 5), (0, 1, 4, 5), (0, 3, 4, 5)):
                out.append(np.stack([p[i] for i in rows], axis=1))
                owners.append(of[chosen])
    return np.concatenate(out), np.concatenate(owners)


def sampled(tets, image):
    """Of tets in voxels of the image [z, y, x]: mean, min, max and mode of each."""
    parts, of = tets, np.arange(len(tets))
    for axis in range(3):
        for bound in range(image.shape[2 - axis] + 1):
            parts, of = split(parts, of, axis, bound)
            keep = volume(parts) > 1e-15
            parts, of = parts[keep], of[keep]
    voxels = np.floor(parts.mean(1)).astype(int)
    inside = ((voxels >= 0) & (voxels < image.shape[::-1])).all(1)
    parts, of, voxels = parts[inside], of[inside], voxels[inside]
    values = image[voxels[:, 2], voxels[:, 1], voxels[:, 0]].astype(float)
    known = np.isfinite(values)
    of, values, voxels = of[known], values[known], voxels[known]
    shares = volume(parts[known])
    numbers = np.ravel_multi_index(voxels.T, image.shape[::-1])
    out = np.full((len(tets), 4), np.nan)
    for tet, whole in enumerate(volume(tets)):
        mine = of == tet
        inside = shares[mine].sum()
        if inside < LEAST * whole:
            continue
        mean = values[mine] @ shares[mine] / inside
        _, first, which = np.unique(numbers[mine], return_index=True, return_inverse=True)
        counts = np.bincount(which, shares[mine]) >= LEAST * min(1, whole)
        seen = values[mine][first][counts]
        kinds, which = np.unique(values[mine], return_inverse=True)
        mode = kinds[np.argmax(np.bincount(which, shares[mine]))]
        out[tet] = mean, seen.min(), seen.max(), mode
    return out


def read_msh2(path):
    """Values and centres of tets; meshio 5.3 takes a list's length for that of a block here."""
    with open(path, encoding="utf-8") as file:
        lines = file.read().splitlines()

    def rows(section, head):
        begin = lines.index(f"${section}", rows.at) + 1 + head
        rows.at = lines.index(f"$End{section}", begin)
        return lines[begin - head:begin], [line.split() for line in lines[begin:rows.at]]

    rows.at = 0
    points = np.array([row[1:] for row in rows("Nodes", 1)[1]], float)
    elements = rows("Elements", 1)[1]
    tets = [row for row in elements if row[1] in ("4", "11")]
    values = {}
    while "$ElementData" in lines[rows.at:]:
        head, data = rows("ElementData", 8)
        assert head[0] == "1" and head[2:7] == ["1", "0", "3", "0", "1"], head
        assert int(head[7]) == len(data) == len(elements)
        values[head[1].strip('"')] = np.array([row[1] for row in data], float)[-len(tets):]
    corners = np.array([row[5:9] for row in tets], int) - 1
    return values, points[corners].mean(1)


def read_values(path):
    """{name: values}, centres of tets: by readers that are not ours."""
    ending = path.split(".")[-1]
    if ending == "msh2":
        return read_msh2(path)
    if ending == "vtkhdf":
        with h5py.File(path) as file:
            grid = file["VTKHDF"]
            nodes = 10 if grid["Types"][0] == 24 else 4
            rows = grid["Connectivity"][:].reshape(-1, nodes)
            return ({n: grid["CellData"][n][:] for n in "ab"},
                    grid["Points"][:][rows[:, :4]].mean(1))
    if ending == "exo":
        with Dataset(path) as file:
            blocks = range(1, file.dimensions["num_el_blk"].size + 1)
            names = ["".join(c.decode() for c in row.compressed() if c)
                     for row in np.ma.array(file["name_elem_var"][:])]
            assert names == ["a", "b"] and file["time_whole"][:].tolist() == [0], names
            values = {n: np.concatenate([np.ma.getdata(file[f"vals_elem_var{v}eb{b}"][0])
                                         for b in blocks]) for v, n in enumerate(names, 1)}
            rows = np.concatenate([file[f"connect{b}"][:] for b in blocks]) - 1
            points = np.stack([file[f"coord{x}"][:] for x in "xyz"], axis=1)
            return values, points[rows[:, :4]].mean(1)
    mesh = meshio.read(path.replace(".xdmf", ".cells.xdmf"))
    blocks = [i for i, block in enumerate(mesh.cells) if block.type.startswith("tetra")]
    tets = np.concatenate([mesh.cells[i].data for i in blocks])
    return ({n: np.concatenate([mesh.cell_data[n][i] for i in blocks]).ravel() for n in "ab"},
            mesh.points[tets[:, :4]].mean(1))


def values_in_order(path):
    """Rows of values, tets by their centres."""
    values, centres = read_values(path)
    order = np.lexsort(centres.round(9).T)
    return np.stack([values[n][order] for n in "ab"])


class Samples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        run("synth", "voronoi", "--shape", "8,7,6", "--labels", "4", "--seed", "3", "-o", "v.npy")
        cls.labels = np.load("v.npy")
        cls.random = np.random.default_rng(5)
        # A turned grid of its own; labels lie at 4, 5, 6 in voxels of 1, 1.25, 1.5.
        nibabel.save(nibabel.Nifti1Image(
            cls.labels.T.astype(np.uint8), cls.affine((1, 1.25, 1.5), (4, 5, 6), 0)), "v.nii")

    @staticmethod
    def affine(spacing, corner, degrees):
        """Of voxels' centres, the first corner at `corner`, turned about z and then x."""
        angle = np.radians(degrees)
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ [[c, -s, 0], [s, c, 0], [0, 0, 1]]
        out = np.eye(4)
        out[:3, :3] = turn @ np.diag(spacing)
        out[:3, 3] = np.array(corner) + out[:3, :3] @ (0.5, 0.5, 0.5)
        return out

    @staticmethod
    def tets_of(mesh):
        return mesh.points[mesh.cells_dict["tetra"]]

    def check(self, mesh_file, image, affine, names, error=1e-9):
        """affine: from centres of voxels; None: the image's voxels are 1 apart from 0 on."""
        mesh = meshio.read(mesh_file)
        tets = self.tets_of(mesh)
        if affine is not None:
            centre = (tets - affine[:3, 3]) @ np.linalg.inv(affine[:3, :3]).T
            tets = centre + 0.5
        expected = sampled(tets, image)
        self.assertGreater(len(tets), 20)
        for name, column in names.items():
            found = mesh.cell_data_dict[name]["tetra"].ravel()
            np.testing.assert_allclose(found, expected[:, column], rtol=error, atol=error,
                                       err_msg=name)
        return expected

    def test_means_of_a_turned_image_of_floats(self):
        affine = self.affine((0.9, 1.3, 2.1), (2, 8, 1), 25)
        image = self.random.normal(size=(8, 7, 9)).astype(np.float32)
        image[3, 3, 4] = np.nan
        header = nibabel.Nifti1Image(image.T, affine)
        header.set_sform(affine, code=1)
        nibabel.save(header, "turned.nii.gz")
        affine = nibabel.load("turned.nii.gz").affine  # floats of 32 bits
        text = run("mesh", "v.nii", "-o", "t.vtu", "--report", "t.json",
                   *(f"--sample={s}=turned.nii.gz:{s}" for s in ("mean", "min", "max")))
        expected = self.check("t.vtu", image, affine, {"mean": 0, "min": 1, "max": 2},
                              error=1e-5)  # axes of 32 bits are straightened
        outside = int(np.isnan(expected[:, 0]).sum())
        self.assertIn(f"{outside} are outside and have NaN" if outside else "sample ", text)
        with open("t.json", encoding="utf-8") as file:
            fact = json.load(file)["samples"][0]
        self.assertEqual((fact["name"], fact["statistic"]), ("mean", "mean"))
        self.assertEqual(fact["tets_outside"], outside)
        self.assertGreater(fact["tets_partly_outside"], 0)
        self.assertAlmostEqual(fact["most"], np.nanmax(expected[:, 0]), 5)

    def test_integers_on_a_finer_grid_in_the_other_frame(self):
        """A MetaImage says where it lies in LPS, a NIfTI in RAS."""
        image = self.random.integers(-1000, 2000, size=(14, 12, 13)).astype(np.int16)
        spacing, corner = np.array((0.7, 0.8, 0.7)), np.array((3.7, 4.9, 5.8))
        first = (corner + spacing / 2) * (-1, -1, 1)
        with open("ct.mha", "wb") as file:
            file.write(("ObjectType = Image\nNDims = 3\nBinaryData = True\n"
                        "BinaryDataByteOrderMSB = False\n"
                        "TransformMatrix = -1 0 0 0 -1 0 0 0 1\n"
                        f"Offset = {first[0]} {first[1]} {first[2]}\n"
                        "ElementSpacing = 0.7 0.8 0.7\nDimSize = 13 12 14\n"
                        "ElementType = MET_SHORT\nElementDataFile = LOCAL\n").encode())
            file.write(image.tobytes())
        run("mesh", "v.nii", "-o", "i.vtu", "--sample", "ct=ct.mha", "--certify", "off")
        self.check("i.vtu", image, self.affine(spacing, corner, 0), {"ct": 0})

    def test_a_second_label_image_on_the_same_grid(self):
        second = self.random.integers(0, 5, size=self.labels.shape).astype(np.uint16)
        np.save("second.npy", second)
        run("mesh", "v.npy", "-o", "s.vtu", "--sample", "tag=second.npy:mode",
            "--sample", "least=second.npy:min", "--sample", "own=v.npy:mode")
        expected = self.check("s.vtu", second, None, {"tag": 3, "least": 1})
        self.assertTrue(np.isfinite(expected).all())
        run("mesh", "v.npy", "-o", "c.vtu", "--crop", "2,1,1,8,6,6", "--sample",
            "tag=second.npy:mode")
        self.check("c.vtu", second, None, {"tag": 3})

    def test_chunked_images_are_read_as_numbers(self):
        image = self.random.normal(size=self.labels.shape)
        with h5py.File("image.h5", "w") as file:
            file.create_dataset("volume", data=image, chunks=(4, 5, 3), compression="gzip")
        run("mesh", "v.npy", "-o", "h.vtu", "--sample", "x=image.h5#volume")
        self.check("h.vtu", image, None, {"x": 0})

    def test_all_formats_have_the_same_values(self):
        image = self.random.normal(size=self.labels.shape).astype(np.float32)
        image[:2] = np.nan
        np.save("image.npy", image)
        endings = ("vtu", "vtkhdf", "msh", "msh2", "xdmf", "exo")
        for element in ("tet4", "tet10"):
            for ending in endings:
                run("mesh", "v.npy", "-o", f"m.{ending}", "--element", element,
                    "--sample", "a=image.npy", "--sample", "b=image.npy:max")
            # Values do not count in digests.
            self.assertEqual(len({run("digest", f"m.{ending}")
                                  for ending in ("vtu", "vtkhdf", "msh", "msh2")}), 1)
            expected = values_in_order("m.vtu")
            self.assertGreater(len(np.unique(expected[0])), 20)
            self.assertTrue(np.isnan(expected).any())
            for ending in endings:
                np.testing.assert_array_equal(values_in_order(f"m.{ending}"), expected, ending)
            run("convert", "m.msh", f"{element}.pvtu", "--pieces", "3")
            run("convert", "m.vtu", "text.msh", "--ascii")
            for source in ("m.vtu", "m.vtkhdf", "m.msh", "m.msh2", f"{element}.pvtu",
                           "text.msh"):
                for ending in endings:
                    run("convert", source, f"c.{ending}", "--element", element, "--force")
                    np.testing.assert_array_equal(values_in_order(f"c.{ending}"), expected,
                                                  f"{source} {ending}")

    def test_convert_says_what_it_leaves_out(self):
        run("mesh", "v.npy", "-o", "m.vtu", "--sample", "a=v.npy", "--sample", "b=v.npy:max")
        for ending in ("mesh", "bdf", "feb", "inp"):
            text = run("convert", "m.vtu", f"c.{ending}")
            self.assertIn("left out: values a, b", text)
            self.assertEqual(text.count("\n"), 1)
        self.assertEqual(run("convert", "m.vtu", "c.exo"), "")
        self.assertEqual(run("convert", "c.mesh", "d.inp"), "")

    def test_commands_read_meshes_with_values(self):
        for options in ((), ("--split", "*")):
            for ending in ("vtkhdf", "vtu", "msh"):
                run("mesh", "v.npy", "-o", f"w.{ending}", "--sample", "a=v.npy", *options)
                run("info", f"w.{ending}", "v.npy", "--contacts")
                run("picture", f"w.{ending}", "-o", "w.png")
                run("surface", f"w.{ending}", "--labels", "1", "-o", "w.stl")
                if ending != "msh":  # the others tell what was doubled
                    run("verify", "v.npy", f"w.{ending}")

    def test_values_of_other_programs(self):
        """Their names are made plain; arrays of integers and of vectors are no values."""
        points = np.eye(4, 3)
        tets = np.array([[0, 1, 2, 3], [0, 2, 1, 3]])
        data = {"label": np.array([1, 2]), "Stress XX": np.array([1.5, np.inf]),
                "stress_xx": np.array([2.5, 3.5], np.float32), "9": np.array([4.0, 5.0]),
                "id": np.array([8, 9]), "vector": np.zeros((2, 3))}
        meshio.write("other.vtu", meshio.Mesh(points, [("tetra", tets)],
                                              cell_data={n: [x] for n, x in data.items()}))
        run("convert", "other.vtu", "own.vtkhdf")
        with h5py.File("own.vtkhdf") as file:
            found = {name: set[:].tolist() for name, set in file["VTKHDF/CellData"].items()}
        self.assertEqual(found, {"label": [1, 2], "Stress_XX": [1.5, np.inf],
                                 "stress_xx_2": [2.5, 3.5], "value_9": [4, 5]})

    def test_bytes_do_not_depend_on_how_it_runs(self):
        run("synth", "spheres", "--shape", "60,50,40", "--labels", "9", "--seed", "1", "-o",
            "big.npy")
        image = self.random.integers(0, 4000, size=(40, 50, 60)).astype(np.uint16)
        np.save("bigimage.npy", image)
        written = set()
        for threads, memory in ((1, "4GiB"), (4, "4GiB"), (3, "64MiB")):
            run("mesh", "big.npy", "-o", "big.vtkhdf", "--window", "16", "--threads", threads,
                "--memory", memory, "--sample", "x=bigimage.npy", "--force")
            with open("big.vtkhdf", "rb") as file:
                written.add(file.read())
        self.assertEqual(len(written), 1)

    def test_what_cannot_be_is_said(self):
        np.save("zero.npy", np.zeros(self.labels.shape, np.float32))
        for output in ("m.mesh", "m.bdf", "m.feb", "m.inp"):
            refused(["no place for values"], "mesh", "v.npy", "-o", output, "--sample", "x=zero.npy",
                    code=2)
            self.assertFalse(os.path.exists(output))
        for bad in ("zero.npy", "2x=zero.npy", "label=zero.npy", "x=", "x=zero.npy;X=zero.npy"):
            refused(["--sample"], "mesh", "v.npy", "-o", "m.vtu", f"--sample={bad}", code=2)
        refused(["missing.npy"], "mesh", "v.npy", "-o", "m.vtu", "--sample=x=missing.npy")
        refused(["--frame voxel"], "mesh", "v.nii", "-o", "m.vtu", "--frame", "voxel",
                "--sample=x=v.nii", code=2)
        sheared = np.eye(4)
        sheared[0, 1] = 0.3
        nibabel.save(nibabel.Nifti1Image(self.labels.T.astype(np.uint8), sheared), "sheared.nii")
        refused(["where it is the volume to mesh, give --frame voxel"], "mesh", "v.nii", "-o", "m.vtu",
                "--sample=x=sheared.nii")
        for unit in ("mm", "micron"):
            image = nibabel.Nifti1Image(self.labels.T.astype(np.uint8), np.eye(4))
            image.header.set_xyzt_units(unit)
            nibabel.save(image, f"{unit}.nii")
        refused(["micron.nii is in um, the labels are in mm"], "mesh", "mm.nii", "-o", "m.vtu",
                "--sample=x=micron.nii", code=2)
        refused(["--memory"], "mesh", "v.npy", "-o", "m.vtu", "--sample=x=v.npy", "--memory=8MiB", code=4)

    def test_an_image_that_lies_elsewhere(self):
        nibabel.save(nibabel.Nifti1Image(np.ones((3, 3, 3), np.uint8),
                                         self.affine((1, 1, 1), (500, 0, 0), 0)), "far.nii")
        text = run("mesh", "v.nii", "-o", "m.vtu", "--sample", "x=far.nii")
        self.assertIn("no tet has a value", text)
        self.assertTrue(np.isnan(meshio.read("m.vtu").cell_data_dict["x"]["tetra"]).all())


if __name__ == "__main__":
    unittest.main()
