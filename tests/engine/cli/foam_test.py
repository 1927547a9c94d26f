#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""A .msh2 with awkward names, read by OpenFOAM's gmshToFoam and judged by its checkMesh."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from program import enter_folder, run

if shutil.which("gmshToFoam") is None or shutil.which("checkMesh") is None:
    print("skipped: no gmshToFoam, checkMesh (apt-get install openfoam)")
    sys.exit(77)
os.environ.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")  # where Debian has etc/controlDict

NAMES = {1: "Left kidney", 2: "Größe (all), 50 %", 3: "größe [all] 50", 4: "4"}
DICTIONARIES = {
    "controlDict": "application none; startFrom startTime; startTime 0; stopAt endTime; endTime 1; "
                   "deltaT 1; writeControl timeStep; writeInterval 1;",
    "fvSchemes": "".join(f"{kind}Schemes {{default {scheme};}}\n" for kind, scheme in (
        ("ddt", "steadyState"), ("grad", "Gauss linear"), ("div", "none"), ("laplacian", "none"),
        ("interpolation", "linear"), ("snGrad", "corrected"))),
    "fvSolution": "",
}


def foam(program, *arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout


class Foam(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        system = pathlib.Path("system")
        system.mkdir()
        for name, text in DICTIONARIES.items():
            (system / name).write_text(
                f"FoamFile{{version 2.0;format ascii;class dictionary;object {name};}}\n{text}\n")
        run("synth", "voronoi", "--shape", "24,22,20", "--labels", 4, "--seed", 1, "-o", "v.npy")
        rows = [f'{label},"{name}"' for label, name in NAMES.items()]
        pathlib.Path("names.csv").write_text("\n".join(["id,name", *rows]), encoding="utf-8")
        run("mesh", "v.npy", "-o", "v.msh2", "--names", "names.csv", "--report", "r.json")
        cls.report = json.loads(pathlib.Path("r.json").read_text())
        cls.read = foam("gmshToFoam", "v.msh2")
        cls.checked = foam("checkMesh")

    def test_the_mesh_is_sound(self):
        self.assertIn("Mesh OK.", self.checked)
        self.assertRegex(self.checked, rf"cells: +{self.report['output']['tets']}\n")
        self.assertNotIn("FATAL", self.read)

    def test_each_label_is_a_zone_of_cells_by_its_name(self):
        table = re.search(r"^ *CellZone .*\n((?:    \S+ .*\n)+)", self.checked, re.M)
        zones = {row.split()[0]: int(row.split()[1]) for row in table[1].splitlines()}
        tets = {row["name"]: row["tets"] for row in self.report["shape"]["per_label"]}
        self.assertEqual(sorted(zones.values()), sorted(tets[name] for name in NAMES.values()))
        self.assertEqual(zones["Left_kidney"], tets["Left kidney"], zones)

    def test_interfaces_are_zones_of_faces_and_sides_are_patches(self):
        sizes = re.search(r"FaceZones:\nZone\tSize\n((?: +\d+\t\d+\n)+)", self.read)
        self.assertGreater(len(sizes[1].splitlines()), 2)
        self.assertNotIn("\t0\n", sizes[1])
        boundary = pathlib.Path("constant/polyMesh/boundary").read_text()
        patches = dict(re.findall(r"^    (\S+)\n    \{.*?nFaces +(\d+);", boundary, re.M | re.S))
        for side in ("x_min", "x_max", "y_min", "y_max", "z_min", "z_max"):
            with self.subTest(side=side):
                self.assertGreater(int(patches[side]), 0)
        self.assertNotIn("defaultFaces", patches)


if __name__ == "__main__":
    unittest.main()
