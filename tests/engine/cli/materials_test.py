#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Element sets by ranges of an image's values, and a bone of 50 materials that CalculiX solves."""
import csv
import shutil
import subprocess
import sys
import unittest

from program import enter_folder, refused, run

try:
    from reading_meshio import meshio
    import numpy as np
    from netCDF4 import Dataset
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def element_sets(path):
    """{name: numbers} of an .inp file, those of its elements as well."""
    out, members = {}, None
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("*"):
                words = line.strip().split("ELSET=")
                is_element = line.startswith("*ELEMENT")
                members = out.setdefault(words[1], []) if len(words) > 1 else None
            elif members is not None:
                numbers = [int(word) for word in line.split(",")]
                members.extend(numbers[:1] if is_element else numbers)
    return out


class Materials(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        run("synth", "voronoi", "--shape", "14,12,10", "--labels", "3", "--seed", "4",
            "-o", "v.npy")
        image = np.random.default_rng(1).normal(size=(10, 12, 14))
        image[:6] = np.nan
        np.save("image.npy", image)
        # The values of tets, which the sets are held against.
        run("mesh", "v.npy", "-o", "m.vtu", "--sample", "hu=image.npy")
        mesh = meshio.read("m.vtu")
        corners = mesh.points[mesh.cells_dict["tetra"]]
        cls.volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
        cls.values = mesh.cell_data_dict["hu"]["tetra"].ravel()
        labels = mesh.cell_data_dict["label"]["tetra"].ravel()
        cls.order = np.argsort(labels, kind="stable")  # of the elements of grouped formats

    def check(self, rows, sets, lo, hi, count):
        values, volumes = self.values[self.order], self.volumes[self.order]
        self.assertEqual(len(rows), count)
        bins = np.clip(np.floor((values - lo) / (hi - lo) * count), 0, count - 1)
        self.assertTrue(np.isnan(values).any())
        used = 0
        for number, row in enumerate(rows, 1):
            mine = np.flatnonzero(bins == number - 1)
            self.assertEqual(int(row["material"]), number)
            self.assertAlmostEqual(float(row["from"]), lo + (hi - lo) * (number - 1) / count, 12)
            self.assertAlmostEqual(float(row["to"]), lo + (hi - lo) * number / count, 12)
            self.assertEqual(int(row["tets"]), len(mine))
            self.assertEqual(row["set"], f"hu_{number}" if len(mine) else "")
            self.assertEqual(f"hu_{number}" in sets, len(mine) > 0)
            if not len(mine):
                continue
            used += 1
            self.assertEqual(list(sets[f"hu_{number}"]), list(mine + 1))
            self.assertAlmostEqual(float(row["volume"]), volumes[mine].sum(), 9)
            mean = volumes[mine] @ values[mine] / volumes[mine].sum()
            self.assertAlmostEqual(float(row["mean"]), mean, 9)
        self.assertGreater(used, count // 2)

    def test_sets_have_the_elements_of_their_ranges(self):
        lo, hi = np.nanmin(self.values), np.nanmax(self.values)
        for arguments, lo, hi, count in (("hu=12", lo, hi, 12), ("hu=7:-0.5:0.75", -0.5, 0.75, 7)):
            for element in ("tet4", "tet10"):
                run("mesh", "v.npy", "-o", "m.inp", "--sample", "hu=image.npy",
                    "--materials", arguments, "--element", element)
                self.check(table("m.inp.materials.csv"), element_sets("m.inp"), lo, hi, count)
                run("mesh", "v.npy", "-o", "m.exo", "--sample", "hu=image.npy",
                    "--materials", arguments, "--element", element)
                with Dataset("m.exo") as file:
                    names = ["".join(c.decode() for c in row.compressed() if c)
                             for row in np.ma.array(file["els_names"][:])]
                    sets = {name: file[f"elem_els{i}"][:].tolist()
                            for i, name in enumerate(names, 1)}
                self.check(table("m.exo.materials.csv"), sets, lo, hi, count)

    def test_gmsh_has_numbers_of_materials(self):
        """meshio reads .msh; .msh2 is read by hand."""
        run("mesh", "v.npy", "-o", "m.inp", "--sample", "hu=image.npy", "--materials", "hu=6")
        rows, sets = table("m.inp.materials.csv"), element_sets("m.inp")
        wanted = np.zeros(len(self.values))
        for row in rows:
            if row["set"]:
                wanted[np.array(sets[row["set"]]) - 1] = int(row["material"])
        self.assertGreater(len(np.unique(wanted)), 3)
        for arguments in (("m.msh",), ("m.msh", "--ascii"), ("m.msh2",)):
            run("mesh", "v.npy", "-o", *arguments, "--sample", "hu=image.npy",
                "--materials", "hu=6", "--element", "tet10")
            self.assertEqual(table(f"{arguments[0]}.materials.csv"), rows)
            if arguments[0] == "m.msh":
                mesh = meshio.read("m.msh")
                found = np.concatenate([data for block, data in zip(
                    mesh.cells, mesh.cell_data["hu_material"]) if block.type == "tetra10"])
            else:
                with open("m.msh2", encoding="utf-8") as file:
                    lines = file.read().split('"hu_material"\n')[1].split("$End")[0].split("\n")
                found = np.array([line.split()[1] for line in lines[6:-1]], float)
                self.assertEqual(len(found), int(lines[5]))
                found = found[-len(wanted):]
            np.testing.assert_array_equal(found.ravel(), wanted)
            # They come back as values do.
            run("convert", arguments[0], "back.vtu")
            back = meshio.read("back.vtu").cell_data_dict["hu_material"]["tetra10"]
            np.testing.assert_array_equal(np.sort(back), np.sort(wanted))

    def test_labels_with_the_names_of_sets_get_others(self):
        with open("n.csv", "w", encoding="utf-8") as file:
            file.write("id,name\n1,HU_2\n2,hu_1\n")
        run("mesh", "v.npy", "-o", "n.inp", "--sample", "hu=image.npy", "--materials", "hu=2",
            "--names", "n.csv", "--deck", "static")
        with open("n.inp", encoding="utf-8") as file:
            names = [line.split("ELSET=")[1].strip().upper() for line in file
                     if line.startswith(("*ELEMENT", "*ELSET"))]
        self.assertEqual(len(names), len(set(names)), names)
        self.assertTrue({"HU_1", "HU_2"} <= set(names), names)

    def test_convert_makes_the_same_sets(self):
        run("mesh", "v.npy", "-o", "a.inp", "--sample", "hu=image.npy", "--materials", "hu=9")
        for ending in ("vtkhdf", "msh"):
            run("mesh", "v.npy", "-o", f"a.{ending}", "--sample", "hu=image.npy")
            self.assertEqual(run("convert", f"a.{ending}", "b.inp", "--materials", "hu=9"), "")
            self.assertEqual(table("b.inp.materials.csv"), table("a.inp.materials.csv"))
            self.assertEqual(element_sets("b.inp"), element_sets("a.inp"))
        refused(["no values of that name"], "convert", "a.msh", "b.inp", "--materials", "density=9", code=2)

    def test_what_cannot_be_is_said(self):
        sample = ("--sample", "hu=image.npy")
        for output, arguments, word in (
                ("m.vtu", (*sample, "--materials", "hu=3"), "no place for materials"),
                ("m.inp", ("--materials", "hu=3"), "no --sample is called 'hu'"),
                ("m.inp", (*sample, "--materials", "hu=0"), "--materials"),
                ("m.inp", (*sample, "--materials", "hu=3:1"), "--materials"),
                ("m.inp", (*sample, "--materials", "hu=3:2:1"), "--materials")):
            refused([word], "mesh", "v.npy", "-o", output, "--force", *arguments, code=2)

    @unittest.skipUnless(shutil.which("ccx"), "no CalculiX")
    def test_a_bone_of_50_materials(self):
        """A bar whose modulus rises along z, pulled: 1 / E adds up along z (layers in series)."""
        shape, low, high = (40, 8, 8), 1000.0, 4000.0
        np.save("bar.npy", np.ones(shape, np.uint8))
        z = (np.arange(shape[0]) + 0.5) / shape[0]
        density = np.broadcast_to((200 + 1000 * z)[:, None, None], shape)
        np.save("ct.npy", density.astype(np.int16))
        run("mesh", "bar.npy", "-o", "bar.inp", "--size", "2", "--element", "tet10",
            "--sample", "hu=ct.npy", "--materials", "hu=50")
        rows = [row for row in table("bar.inp.materials.csv") if row["set"]]
        self.assertGreater(len(rows), 40)
        with open("job.inp", "w", encoding="utf-8") as job:
            job.write("*INCLUDE, INPUT=bar.inp\n")
            for row in rows:
                modulus = low + (high - low) * (float(row["mean"]) - 200) / 1000
                job.write(f"*MATERIAL, NAME={row['set']}\n*ELASTIC\n{modulus}, 0\n"
                          f"*SOLID SECTION, ELSET={row['set']}, MATERIAL={row['set']}\n")
            job.write("*BOUNDARY\nX_MIN, 1, 1\nY_MIN, 2, 2\nZ_MIN, 3, 3\n*STEP\n*STATIC\n"
                      f"*BOUNDARY\nZ_MAX, 3, 3, {shape[0] / 100}\n"
                      "*NODE PRINT, NSET=Z_MAX, TOTALS=ONLY\nRF\n*END STEP\n")
        subprocess.run(["ccx", "job"], capture_output=True, check=True)
        with open("job.dat", encoding="utf-8") as file:
            force = float(file.read().split()[-1])
        effective = force / (shape[1] * shape[2]) / 0.01
        in_series = (high - low) / np.log(high / low)
        print(f"effective modulus {effective:.2f}, in series {in_series:.2f}")
        self.assertLess(abs(effective / in_series - 1), 0.01)


if __name__ == "__main__":
    unittest.main()
