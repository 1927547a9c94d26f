#!/usr/bin/python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""How the error of a solution falls as meshes get finer, beside a staircase and CGAL's meshes.

Usage: bench/convergence.py [--voxels N] [SIZE...]     default: 48 and 8 6 5 4 3 2, voxels
A ball of radius 14 N/48 and conductivity 10 lies in a box of N^3 voxels of conductivity 1, in a field along
z.  The solution is known; the boundary has its values.  Linear elements solve for it on the default mesh, on
meshes of `--size SIZE`, quadratic ones on the same meshes with `--element tet10` and `tet10-curved`, linear ones on six tets a cell of a staircase that is sampled at SIZE, and, if
MW_PEER (default: build/release/cgal_mesh, see bench/README.md) is there, on CGAL's meshes with cells and facets of
SIZE.  The table has the relative errors of the gradient (H1) and of the value (L2), in the norm that conductivity
weighs.  For "H1" and "L2" each tet is compared with the solution of its own label, carried on across the interface: this
is what theory tells of elements whose interface is nearly in place.  For "H1 by place" it is compared with what is true
at each place, so that the layer between interface and ball, where the gradient is that of the wrong side, counts as well.
apt-get install python3-numpy python3-scipy python3-meshio
"""
import argparse
import itertools
import os
import pathlib
import subprocess
import sys
import tempfile

import meshio
import numpy as np
import scipy.sparse
import scipy.sparse.linalg

RELEASE = pathlib.Path(__file__).resolve().parent.parent / "build" / "release"
PROGRAM = os.environ.get("MW_PROGRAM", RELEASE / "mwmesh")
PEER = pathlib.Path(os.environ.get("MW_PEER", RELEASE / "cgal_mesh"))
EDGE, RADIUS, INSIDE = 48, 14.0, 10.0


def centre():
    return np.full(3, EDGE / 2) + (0.2, -0.1, 0.3)  # on no symmetry of the voxels


def solution(p, inside=None):
    """Values and gradients at points [..., 3], and the conductivity there.  inside [...] tells where the solution of the
    ball is meant; without it, that is in the ball."""
    x = p - centre()
    r2 = np.maximum((x**2).sum(-1), 1e-12)
    dipole = (INSIDE - 1) / (INSIDE + 2) * RADIUS**3
    value = x[..., 2] * (1 - dipole / r2**1.5)
    gradient = 3 * dipole * x * (x[..., 2] / r2**2.5)[..., None]
    gradient[..., 2] += 1 - dipole / r2**1.5
    inside = r2 < RADIUS**2 if inside is None else inside
    value[inside] = x[inside, 2] * 3 / (INSIDE + 2)
    gradient[inside] = (0, 0, 3 / (INSIDE + 2))
    return value, gradient, np.where(inside, INSIDE, 1.0)


def rule():
    """Barycentric points and weights of Keast's rule of degree 4."""
    near, far = (1 - np.sqrt(5 / 14)) / 4, (1 + np.sqrt(5 / 14)) / 4
    points, weights = [[0.25] * 4], [-148 / 1875]
    for i in range(4):
        points.append([11 / 14 if k == i else 1 / 14 for k in range(4)])
        weights.append(343 / 7500)
    for pair in itertools.combinations(range(4), 2):
        points.append([far if k in pair else near for k in range(4)])
        weights.append(56 / 375)
    return np.array(points), np.array(weights)


def faces_of(tets):
    """The faces of all tets, each with its three or six nodes, in the order of shapes(); the rows of those that are
    there once, and of the two of those that are there twice."""
    sides = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]
    corners = np.sort(np.concatenate([tets[:, side] for side in sides]), 1)
    if tets.shape[1] == 10:
        middle = {frozenset(edge): 4 + e for e, edge in enumerate(EDGES)}
        sides = [[a, b, c, middle[frozenset((a, b))], middle[frozenset((b, c))], middle[frozenset((c, a))]]
                 for a, b, c in sides]
    faces = np.concatenate([tets[:, side] for side in sides])
    order = np.lexsort(corners.T)
    same = (corners[order][1:] == corners[order][:-1]).all(1)
    alone = ~(np.append(same, False) | np.append(False, same))
    return faces, order[alone], (order[:-1][same], order[1:][same])


def on_boundary(tets, count):
    """Which points are on the outside of the mesh: CGAL rounds the box, and has the solution's values there, too."""
    faces, alone, _ = faces_of(tets)
    out = np.zeros(count, bool)
    out[faces[alone]] = True
    return out


EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))  # where nodes 4 to 9 are


def shapes(at, nodes):
    """Values [nodes] of the functions of four or ten nodes at a barycentric point, and their derivatives [nodes, 3]
    towards corners 1 to 3."""
    if nodes == 4:
        values, slopes = at, np.eye(4)
    else:
        values = np.array([*(at * (2 * at - 1)), *(4 * at[a] * at[b] for a, b in EDGES)])
        slopes = np.zeros((10, 4))
        slopes[range(4), range(4)] = 4 * at - 1
        for e, (a, b) in enumerate(EDGES):
            slopes[4 + e, a], slopes[4 + e, b] = 4 * at[b], 4 * at[a]
    return values, slopes[:, 1:] - slopes[:, :1]


def at_points(points, tets):
    """For each point of the rule: shares of the volume [tets], values, gradients [tets, nodes, 3] of the functions."""
    for at, weight in zip(*rule()):
        values, slopes = shapes(at, tets.shape[1])
        jacobians = np.einsum("tnk,nd->tdk", points[tets], slopes)
        yield weight * np.abs(np.linalg.det(jacobians)) / 6, values, np.einsum(
            "tkd,nd->tnk", np.linalg.inv(jacobians), slopes)


def solved(points, tets, labels):
    """Number of unknowns, relative errors (H1, H1 by place, L2), values at points; elements have the mesh's own nodes,
    four or ten."""
    conductivity = np.where(labels == 1, INSIDE, 1.0)
    stiffness = sum(np.einsum("t,tik,tjk->tij", conductivity * share, gradients, gradients)
                    for share, _, gradients in at_points(points, tets))
    nodes = tets.shape[1]
    rows, columns = np.repeat(tets, nodes, 1).ravel(), np.tile(tets, nodes).ravel()
    matrix = scipy.sparse.csr_matrix((stiffness.ravel(), (rows, columns)), (len(points),) * 2)
    used = np.zeros(len(points), bool)
    used[tets] = True
    outer = on_boundary(tets, len(points))
    free = np.flatnonzero(used & ~outer)
    u = solution(points)[0]
    right = -matrix[free][:, outer] @ u[outer]
    u[free] = scipy.sparse.linalg.spsolve(matrix[free][:, free].tocsc(), right)

    sums = np.zeros(4)
    for share, values, gradients in at_points(points, tets):
        value, gradient, k = solution(np.einsum("n,tnk->tk", values, points[tets]), labels == 1)
        got = np.einsum("tnk,tn->tk", gradients, u[tets])
        share = share * k
        sums += [(share * ((got - gradient)**2).sum(1)).sum(), (share * (gradient**2).sum(1)).sum(),
                 (share * (u[tets] @ values - value)**2).sum(), (share * value**2).sum()]
    layer = squared_in_layer(points, tets, labels)
    return len(free), np.sqrt(sums[0] / sums[1]), np.sqrt((sums[0] + layer) / sums[1]), np.sqrt(sums[2] / sums[3]), u


def squared_in_layer(points, tets, labels):
    """What the layer between interface and ball adds to the squared error, to first order in its thickness: there the
    gradient is that of the wrong side, which differs by its jump across the ball."""
    faces, _, (first, second) = faces_of(tets)
    faces = faces[first[labels[first % len(labels)] != labels[second % len(labels)]]]
    halves = np.arange(1, 16, 2) / 16  # middles of an 8 by 8 grid, of which a triangle is one half
    total = 0.0
    for a, b in itertools.product(halves, halves):
        if a + b > 1 + 1e-9:
            continue
        weight = 0.5 if a + b > 1 - 1e-9 else 1.0
        values, slopes = shapes(np.array([1 - a - b, a, b, 0.0]), tets.shape[1])
        nodes = [0, 1, 2] if tets.shape[1] == 4 else [0, 1, 2, 4, 5, 6]
        at = np.einsum("n,tnk->tk", values[nodes], points[faces])
        along = np.einsum("nd,tnk->tdk", slopes[nodes][:, :2], points[faces])
        area = np.linalg.norm(np.cross(along[:, 0], along[:, 1]), axis=1) / 64 * weight
        away = at - centre()
        beside = np.linalg.norm(away, axis=1) - RADIUS
        jump = 3 * (INSIDE - 1) / (INSIDE + 2) * away[:, 2] / RADIUS
        total += (area * np.abs(beside) * np.where(beside < 0, INSIDE, 1.0) * jump**2).sum()
    return total


def ball(edge):
    """Labels of edge^3 cells that fill the box."""
    middles = (np.arange(edge) + 0.5) * EDGE / edge
    z, y, x = np.meshgrid(middles, middles, middles, indexing="ij")
    return (((np.stack([x, y, z], -1) - centre())**2).sum(-1) < RADIUS**2).astype(np.uint8)


def staircase(size):
    edge = round(EDGE / size)
    index = np.arange((edge + 1)**3).reshape((edge + 1,) * 3)
    z, y, x = np.meshgrid(*[np.linspace(0, EDGE, edge + 1)] * 3, indexing="ij")
    points = np.stack([x, y, z], -1).reshape(-1, 3)
    tets = []
    for axes in itertools.permutations(range(3)):
        at, corner = np.zeros(3, int), []
        for step in (None, *axes):
            if step is not None:
                at[step] += 1
            corner.append(index[at[0]:at[0] + edge, at[1]:at[1] + edge, at[2]:at[2] + edge].ravel())
        tets.append(np.stack(corner, 1))
    return points, np.concatenate(tets), np.tile(ball(edge).ravel(), 6)


def read(path):
    mesh = meshio.read(path)
    labels = mesh.cell_data["label" if "label" in mesh.cell_data else "medit:ref"]
    kept = [(block.data, data) for block, data in zip(mesh.cells, labels) if block.type.startswith("tetra")]
    return mesh.points, np.concatenate([tets for tets, _ in kept]), np.concatenate([data for _, data in kept])


def meshed(program, *options, out="mesh.mesh"):
    """The mesh that a program makes of volume.npy."""
    settings = {name: value for name, value in os.environ.items() if not name.startswith("MW_")}
    subprocess.run([program, *options, "-o", out], check=True, stdout=subprocess.DEVNULL, env=settings)
    return read(out)


def row(name, mesh):
    unknowns, h1, by_place, l2, _ = solved(*mesh)
    print(f"| {name} | {unknowns:,} | {h1:.4f} | {by_place:.4f} | {l2:.5f} |", flush=True)


def main():
    global EDGE, RADIUS
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--voxels", type=int, default=EDGE)
    parser.add_argument("sizes", nargs="*", type=float, default=[8, 6, 5, 4, 3, 2])
    options = parser.parse_args()
    EDGE, RADIUS, sizes = options.voxels, RADIUS * options.voxels / EDGE, options.sizes
    print("| mesh | unknowns | H1 | H1 by place | L2 |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        np.save("volume.npy", ball(EDGE))
        mesh = (PROGRAM, "mesh", "volume.npy", "--force")
        row("default", meshed(*mesh))
        for size in sizes:
            row(f"`--size {size:g}`", meshed(*mesh, "--size", f"{size:g}"))
        for element in ("tet10", "tet10-curved"):
            row(f"default, {element}", meshed(*mesh, "--element", element, out="mesh.vtu"))
            for size in sizes:
                row(f"`--size {size:g}`, {element}",
                    meshed(*mesh, "--size", f"{size:g}", "--element", element, out="mesh.vtu"))
        if PEER.exists():
            row("CGAL, default", meshed(PEER, "volume.npy"))
            for size in sizes:
                row(f"CGAL, {size:g}", meshed(PEER, "volume.npy", "--facet-size", f"{size:g}",
                                              "--cell-size", f"{size:g}"))
        for size in sizes:
            row(f"staircase, {EDGE / round(EDGE / size):.3g}", staircase(size))


if __name__ == "__main__":
    main()
