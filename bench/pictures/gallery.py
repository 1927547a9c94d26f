#!/usr/bin/python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The gallery of README.md: four kinds of volumes, meshed by the commands that it shows.

Usage: bench/pictures/gallery.py [organ] [em] [grains] [cell]; writes bench/pictures/gallery_*.png.
MW_PROGRAM is the program (default: build/release/mwmesh).  EM is a stand-in: `synth`'s tubes laid
through its grains.
apt-get install python3-numpy python3-pil mricron-data
"""

import os
import pathlib
import subprocess
import sys
import tempfile

import numpy
import PIL.Image

import volumes

HERE = pathlib.Path(__file__).resolve().parent
PROGRAM = os.environ.get("MW_PROGRAM", HERE.parent.parent / "build" / "release" / "mwmesh")
EM_SHAPE, EM_CELLS, EM_TUBES = "96,96,64", 12, 24
GRAINS_SHAPE, GRAINS = "64,64,64", 40
CELL_EDGE, CELL_GRAINS = 48, 12
TEMPLATES = pathlib.Path("/usr/share/mricron/templates")


def synth(kind, shape, count, seed, folder):
    run("synth", kind, "--shape", shape, "--count", str(count), "--seed", str(seed), "-o",
        folder / f"{kind}.npy")
    return numpy.load(folder / f"{kind}.npy")


def atlas(folder):
    return TEMPLATES / "aal.nii.gz"


def tissue(folder):
    cells = synth("voronoi", EM_SHAPE, EM_CELLS, 2, folder).astype(numpy.uint16)
    tubes = synth("tubes", EM_SHAPE, EM_TUBES, 3, folder)
    numpy.save(folder / "em.npy", numpy.where(tubes > 0, tubes + EM_CELLS, cells))
    return folder / "em.npy"


def grains(folder):
    synth("voronoi", GRAINS_SHAPE, GRAINS, 1, folder)
    return folder / "voronoi.npy"


def cell(folder):
    numpy.save(folder / "cell.npy", volumes.cell(CELL_EDGE, CELL_GRAINS))
    return folder / "cell.npy"


# Name: the volume, options of mesh, options of picture.
GALLERY = {
    "organ": (atlas, ["--names", TEMPLATES / "aal.nii.txt", "--labels", "71-78"],
              ["--view", "30,20"]),
    "em": (tissue, ["--spacing", "40"], ["--cut", "y=0.5"]),
    "grains": (grains, ["--size", "5", "--spacing", "1"], []),
    "cell": (cell, ["--periodic", "xyz", "--spacing", "1"], []),
}


def draw(name):
    volume, meshing, drawing = GALLERY[name]
    png = HERE / f"gallery_{name}.png"
    with tempfile.TemporaryDirectory() as text:
        folder = pathlib.Path(text)
        run("mesh", volume(folder), "-o", folder / "m.vtu", *meshing)
        run("picture", folder / "m.vtu", "-o", folder / "p.png", "--pixels", "1200x900", *drawing)
        picture = PIL.Image.open(folder / "p.png").convert("RGB").reduce(2)
        picture.quantize(128, dither=PIL.Image.Dither.NONE).save(png, optimize=True)


def run(*arguments):
    subprocess.run([PROGRAM, *arguments], check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    for chosen in sys.argv[1:] or GALLERY:
        draw(chosen)
