#!/usr/bin/python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The figure of the idea in README.md: a window on its way over a slice of voxels (a schema, no run).

Usage: bench/pictures/idea.py
Writes bench/pictures/idea.png.  apt-get install python3-numpy python3-matplotlib
"""

import pathlib

import matplotlib

matplotlib.use("Agg")
from matplotlib import patches, pyplot
import numpy

HERE = pathlib.Path(__file__).resolve().parent
BLOCK = 4  # voxels on the edge of a block, in this schema
WIDTH, HEIGHT = 7 * BLOCK, 3 * BLOCK
WINDOW = (2 * BLOCK, BLOCK, 2 * BLOCK)  # first corner and edge
COLOURS = ("#f2d7a0", "#a9cbe6", "#c5dfb8")
WINDOW_COLOUR, NEXT_COLOUR = "#c0392b", "#d98880"


def wave(x):
    """Height of the interface above the first material."""
    return HEIGHT / 2 + 1.6 * numpy.sin(x / 3.1)


def label(x, y):
    """0, 1 or 2: two curved interfaces that meet."""
    return numpy.where(y < wave(x), 0, numpy.where(x + 0.6 * y < 20, 1, 2))


def points(seed=4):
    """Few vertices where the window was, all corners of voxels where it was not."""
    chosen = numpy.random.default_rng(seed)
    met = WINDOW[0] + BLOCK  # the window has covered the slice up to here
    out = [(x, wave(x)) for x in numpy.arange(0, met, 2)]
    for x in range(WIDTH + 1):
        for y in range(HEIGHT + 1):
            if x >= met or is_kept(x, y, chosen.random()):
                out.append((x, y))
    return numpy.array(out, float)


def is_kept(x, y, chance):
    """Of the corners where the window was: some on the box, some well inside a material."""
    if x == 0 or y in (0, HEIGHT):
        return (x + y) % BLOCK == 0
    return abs(y - wave(x)) > 1.5 and chance < 0.12


def is_fixed(mesh, index):
    """Some triangle of the vertex reaches out of the window."""
    x0, y0, edge = WINDOW
    corners = mesh.triangles[(mesh.triangles == index).any(axis=1)].ravel()
    x, y = mesh.x[corners], mesh.y[corners]
    return bool((x < x0).any() or (x > x0 + edge).any() or (y < y0).any() or (y > y0 + edge).any())


def draw_mesh(axes, mesh):
    centre = mesh.x[mesh.triangles].mean(axis=1), mesh.y[mesh.triangles].mean(axis=1)
    axes.tripcolor(mesh, facecolors=label(*centre).astype(float), edgecolors="#777777",
                   linewidth=0.5, cmap=matplotlib.colors.ListedColormap(COLOURS))


def draw_vertices(axes, mesh):
    x0, y0, edge = WINDOW
    for index, (x, y) in enumerate(zip(mesh.x, mesh.y)):
        if x0 <= x <= x0 + edge and y0 <= y <= y0 + edge:
            colour = "white" if is_fixed(mesh, index) else "black"
            axes.plot(x, y, "o", markersize=4.5, color=colour, markeredgecolor="black", zorder=5)


def draw_windows(axes):
    x0, y0, edge = WINDOW
    for x in range(0, WIDTH + 1, BLOCK):
        axes.plot((x, x), (0, HEIGHT), ":", color="#555555", linewidth=0.9)
    for y in range(0, HEIGHT + 1, BLOCK):
        axes.plot((0, WIDTH), (y, y), ":", color="#555555", linewidth=0.9)
    axes.add_patch(patches.Rectangle((x0 + BLOCK, y0), edge, edge, fill=False, linestyle="--",
                                     edgecolor=NEXT_COLOUR, linewidth=2, zorder=4))
    axes.add_patch(patches.Rectangle((x0, y0), edge, edge, fill=False, edgecolor=WINDOW_COLOUR,
                                     linewidth=3, zorder=4))


def write(axes):
    x0, y0, edge = WINDOW
    top, below = HEIGHT + 0.5, -0.5
    for x, text in ((x0 / 2, "meshed before: few tets"), (WIDTH - x0 / 2, "not yet met: voxels")):
        axes.text(x, top, text, ha="center", va="bottom")
    axes.text(x0 + edge / 2, top, "the window", color=WINDOW_COLOUR, ha="center", va="bottom")
    axes.annotate("", (x0 + BLOCK, y0 - 0.5), (x0, y0 - 0.5),
                  arrowprops={"arrowstyle": "->", "color": WINDOW_COLOUR, "linewidth": 2})
    axes.text(x0 + BLOCK / 2, y0 - 0.7, "half-step", color=WINDOW_COLOUR, ha="center", va="top",
              bbox={"facecolor": "white", "edgecolor": "none", "pad": 1})
    axes.text(0, below, "dotted: blocks, which are stored     $\\bullet$ free: may move or vanish     "
              "$\\circ$ fixed: has a tet outside the window", va="top", fontsize=9)


def main():
    corners = points()
    mesh = matplotlib.tri.Triangulation(corners[:, 0], corners[:, 1])
    figure, axes = pyplot.subplots(figsize=(8.4, 4.1), dpi=110)
    draw_mesh(axes, mesh)
    draw_windows(axes)
    draw_vertices(axes, mesh)
    write(axes)
    axes.set_aspect("equal")
    axes.axis("off")
    figure.savefig(HERE / "idea.png", bbox_inches="tight", metadata={"Software": None})


if __name__ == "__main__":
    main()
