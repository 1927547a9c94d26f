#!/usr/bin/python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The flux of the problem of bench/convergence.py, on the cut through the middle of two meshes.

Usage: bench/pictures/flux.py
Writes bench/pictures/flux.png: linear elements on the voxels, cut into tets, and on a mesh of `--size 6`.
MW_PROGRAM is the program (default: build/release/mwmesh).
apt-get install python3-numpy python3-scipy python3-meshio python3-matplotlib
"""
import os
import pathlib
import sys
import tempfile

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.collections
import matplotlib.pyplot as plt

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import convergence

PLANE = convergence.centre()[1]  # y


def cut_polygons(points, tets):
    """Where the plane cuts tets: their numbers, and a polygon [corners, 2] in x and z of each."""
    above = points[tets][:, :, 1] > PLANE
    numbers = np.flatnonzero(above.any(1) & ~above.all(1))
    polygons = []
    for number in numbers:
        corners = []
        for a, b in ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)):
            p, q = points[tets[number, [a, b]]]
            if (p[1] > PLANE) != (q[1] > PLANE):
                corners.append((p + (q - p) * (PLANE - p[1]) / (q[1] - p[1]))[[0, 2]])
        corners = np.array(corners)
        out = corners - corners.mean(0)
        polygons.append(corners[np.argsort(np.arctan2(out[:, 1], out[:, 0]))])
    return numbers, polygons


def draw(axes, name, mesh):
    points, tets, labels = mesh
    unknowns, h1, _, l2, u = convergence.solved(*mesh)
    _, _, gradients = next(convergence.at_points(points, tets))
    flux = np.linalg.norm(np.einsum("tnk,tn->tk", gradients, u[tets]), axis=1)
    flux *= np.where(labels == 1, convergence.INSIDE, 1.0)
    numbers, polygons = cut_polygons(points, tets)
    drawn = matplotlib.collections.PolyCollection(
        polygons, array=flux[numbers], cmap="viridis", edgecolors=(0.1, 0.1, 0.1, 0.5), linewidths=0.3)
    drawn.set_clim(0, 3)
    axes.add_collection(drawn)
    axes.add_patch(plt.Circle(convergence.centre()[[0, 2]], convergence.RADIUS, fill=False, color="white", lw=1.2))
    axes.set(xlim=(0, convergence.EDGE), ylim=(0, convergence.EDGE), aspect="equal")
    axes.set_axis_off()
    axes.set_title(f"{name}: {unknowns:,} unknowns,\nerrors {h1:.3f} (H1), {l2:.4f} (L2)", fontsize=9)
    return drawn


def main():
    figure, both = plt.subplots(1, 2, figsize=(8, 4.1), dpi=120)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        np.save("volume.npy", convergence.ball(convergence.EDGE))
        draw(both[0], "voxels, cut into tets", convergence.staircase(2))
        mesh = convergence.meshed(convergence.PROGRAM, "mesh", "volume.npy", "--size", "6")
        drawn = draw(both[1], "mwmesh --size 6", mesh)
    figure.colorbar(drawn, ax=both, label="flux", shrink=0.75, pad=0.02)
    figure.savefig(HERE / "flux.png", bbox_inches="tight")


if __name__ == "__main__":
    main()
