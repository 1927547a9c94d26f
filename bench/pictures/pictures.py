#!/usr/bin/python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of bench/README.md: `--surface voxel` and `--surface smooth` of a ball and of a brain.

Usage: xvfb-run -a bench/pictures/pictures.py [NAME]...
Writes bench/pictures/NAME.png; without names those that bench/README.md and the manual
show: ball, organ, cut, cell, kidney, teeth, spine and shell.  The others, plate and
junction, are for a comparison before and after a change: a plate of one voxel, and a grain of a
polycrystal.
MW_PROGRAM is the program (default: build/release/mwmesh).
apt-get install python3-numpy python3-pil python3-vtk9 xvfb xauth libgl1-mesa-dri mricron-data
VTK of Debian 12 draws through an X server only; any DISPLAY will do, xvfb-run gives one.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy

import scene
import volumes

HERE = pathlib.Path(__file__).resolve().parent
SURFACES = ("voxel", "smooth")
COLOURS = (
    "e8b45a", "6fa8d6", "d9776b", "86b878", "b08cc4", "e0d65a", "5cc8c0", "e59cc4", "a87c50",
    "5a74c8", "b8d890", "d85a90", "4c9468",
)
BACKGROUND = "eeeeee"
LARGE = 1000  # voxels of a label whose volume is promised
BALL_RADIUS = 20  # voxels
PLATE_EDGE = 24  # voxels
SHELL_RADIUS = 26  # voxels
GRAINS_EDGE, GRAINS = 56, 16  # voxels, and how many
CELL_EDGE, CELL_GRAINS = 48, 12
# Of the right half of the brain: caudate, thalamus, hippocampus, amygdala.
ORGAN = (72, 78, 38, 42)
CUT_CORNER, CUT_SHAPE = (92, 88, 46), (64, 48, 56)  # voxels x, y, z: around the right basal ganglia
CUT_LAYER = 30  # along y: what is behind stays


def main():
    names = sys.argv[1:] or SHOWN
    if not set(names) <= set(PICTURES):
        raise SystemExit(__doc__)
    if "DISPLAY" not in os.environ:
        raise SystemExit("pictures: no DISPLAY; xvfb-run -a " + sys.argv[0])
    for name in names:
        with tempfile.TemporaryDirectory() as folder:
            PICTURES[name](HERE / f"{name}.png", pathlib.Path(folder))


def draw_ball(png, folder):
    halves = [
        ([scene.surface(file, 1)], caption(report, [1]))
        for file, report in mesh_both(volumes.ball(BALL_RADIUS), folder)
    ]
    scene.draw(png, halves, colours([1]), ((1, 1, 1), 1.6))


def draw_organ(png, folder):
    halves = [
        ([scene.surface(file, label) for label in ORGAN], caption(report, ORGAN))
        for file, report in mesh_both(volumes.only(volumes.atlas(), ORGAN), folder)
    ]
    scene.draw(png, halves, colours(ORGAN), ((-1, 0.3, 0.3), 1.6))


def draw_cut(png, folder):
    volume = volumes.crop(volumes.atlas(), CUT_CORNER, CUT_SHAPE)
    sizes = numpy.bincount(volume.ravel())
    labels = [int(label) for label in numpy.argsort(-sizes) if label and sizes[label]]
    halves = [
        ([scene.behind(file, (0, CUT_LAYER, 0), (0, 1, 0))], caption(report, labels))
        for file, report in mesh_both(volume, folder)
    ]
    scene.draw(png, halves, {0: BACKGROUND} | colours(labels), ((0.25, 1, 0.2), 1.35))


def draw_plate(png, folder):
    halves = [
        ([scene.surface(file, 1)], caption(report, [1]))
        for file, report in mesh_both(volumes.plate(PLATE_EDGE), folder)
    ]
    scene.draw(png, halves, colours([1]), ((0.5, -1, 0.8), 1.2))


def draw_junction(png, folder):
    """The grain in the middle, whose faces are flat and meet in edges and corners."""
    volume = volumes.grains(GRAINS_EDGE, GRAINS)
    middle = int(volume[(GRAINS_EDGE // 2,) * 3])
    halves = [
        ([scene.surface(file, middle)], caption(report, [middle]))
        for file, report in mesh_both(volume, folder)
    ]
    scene.draw(png, halves, colours([middle]), ((1, 0.6, 0.5), 1.5))


def draw_kidney(png, folder):
    runs = (("default", ()), ("--preset fine", ("--preset", "fine")))
    draw_runs(png, folder, volumes.kidney(), runs, [1], ((-0.9, 1, 0.35), 1.12))


def draw_teeth(png, folder):
    runs = (("--size 2", ("--size", "2")), ("--size 1", ("--size", "1")))
    draw_runs(png, folder, volumes.teeth(), runs, [2, 3, 4], ((0.35, -1, 0.4), 1.3))


def draw_shell(png, folder):
    runs = (("--surface voxel", ("--surface", "voxel")), ("default", ()))
    draw_runs(png, folder, volumes.shell(SHELL_RADIUS, 1), runs, [1], ((1, -1, 0.8), 1.6))


def draw_spine(png, folder):
    size = ("--spacing", "1,1,6", "--size", "3")
    runs = (("--size 3", size),
            ("--size 3 --interpolate-slices", (*size, "--interpolate-slices")))
    draw_runs(png, folder, volumes.spine(), runs, range(1, 6), ((1, -0.4, 0.35), 1.3))


def draw_runs(png, folder, volume, runs, labels, view):
    """Some labels of a volume as two runs have them.  `runs`: pairs of a name and options."""
    numpy.save(folder / "volume.npy", volume)
    halves = []
    for number, (name, options) in enumerate(runs):
        file, report = mesh(folder / "volume.npy", folder / str(number), *options)
        halves.append(
            ([scene.surface(file, label) for label in labels], caption(report, labels, name))
        )
    scene.draw(png, halves, colours(labels), view)


def draw_cell(png, folder):
    """A polycrystal that repeats itself, and eight of it in a cube."""
    numpy.save(folder / "volume.npy", volumes.cell(CELL_EDGE, CELL_GRAINS))
    file, report = mesh(folder / "volume.npy", folder / "cell", "--periodic", "xyz")
    halves = [
        ([scene.whole(file)], f"--periodic xyz\n{report['output']['tets']:,} tets"),
        ([scene.tiled(file, CELL_EDGE)], "2 x 2 x 2 of it\nfaces are flat, and match node for node"),
    ]
    view = ((-1, -0.8, 0.6), 1.0)
    scene.draw(png, halves, colours(range(1, CELL_GRAINS + 1)), view, one_camera=False)


def colours(labels):
    """By label; more labels than colours share them."""
    return {label: COLOURS[i % len(COLOURS)] for i, label in enumerate(labels)}


def mesh_both(volume, folder):
    """Mesh and report for each surface."""
    numpy.save(folder / "volume.npy", volume)
    return [
        mesh(folder / "volume.npy", folder / surface, "--surface", surface) for surface in SURFACES
    ]


def mesh(volume, stem, *options):
    program = os.environ.get("MW_PROGRAM", HERE.parent.parent / "build" / "release" / "mwmesh")
    file, report = stem.with_suffix(".vtu"), stem.with_suffix(".json")
    command = [program, "mesh", volume, "-o", file, "--report", report, *options]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return file, json.loads(report.read_text())


def caption(report, labels, name=None):
    """The volume is that of the label that is worst off.  The name is by default the surface's."""
    shape = report["shape"]
    mine = [row for row in shape["per_label"] if row["label"] in labels]
    rows = [row for row in mine if large(row)] or mine
    worst = max((row["volume_error"] for row in rows), key=abs)
    text = (
        f"{name or '--surface ' + report['settings']['surface']}\n"
        f"{report['output']['vertices']:,} vertices,  "
        f"volume {100 * worst:+.2f} %,  sharp edges {100 * shape['sharp_share']:.1f} %"
    )
    print(text.replace("\n", ": "))
    return text


def large(row):
    return row["voxels"] >= LARGE


SHOWN = ["ball", "organ", "cut", "cell", "kidney", "teeth", "spine", "shell"]
PICTURES = {"ball": draw_ball, "organ": draw_organ, "cut": draw_cut, "cell": draw_cell,
            "kidney": draw_kidney, "teeth": draw_teeth, "spine": draw_spine, "shell": draw_shell,
            "plate": draw_plate, "junction": draw_junction}


if __name__ == "__main__":
    main()
