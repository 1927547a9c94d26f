#!/usr/bin/python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The default, the draft and CGAL in one run: a row for each program and volume.

CGAL has a row with its defaults, and one with about as many vertices as our default and its mesh improved until nothing gets
better, which is the mesh that one would compare ours with.

Usage: bench/peers/compare.py VOLUME...
Each mesh is made on one thread, and then judged by `mwmesh verify`: labels whose topology is not that of
the voxels, the share of interface edges that bend by more than 60 degrees, and how far volumes of labels
of 1,000 voxels and more are off, at most and on average.  The last column is the error of a solution on
a conducting ball (bench/convergence.py), by unknowns.
MW_PROGRAM and MW_PEER are the programs (default: mwmesh and cgal_mesh in build/release; see bench/README.md).
apt-get install python3-numpy python3-scipy python3-meshio
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import convergence  # noqa: E402

MESH = ("mesh", "--threads", "1", "--certify", "off", "--force")
PROGRAMS = {
    "default": (convergence.PROGRAM, *MESH),
    "draft": (convergence.PROGRAM, *MESH, "--preset", "draft"),
    "CGAL": (convergence.PEER,),
}


def run(*command):
    settings = {name: value for name, value in os.environ.items() if not name.startswith("MW_")}
    return subprocess.run(command, stdout=subprocess.DEVNULL, env=settings).returncode


def vertices(report="run.json"):
    return json.loads(pathlib.Path(report).read_text())["output"]["vertices"]


def of_size(scale):
    """Options of CGAL's default criteria with lengths times `scale`."""
    return ("--facet-size", f"{6 * scale:.4f}", "--facet-distance", f"{scale:.4f}", "--cell-size", f"{8 * scale:.4f}")


def alike(volume, wanted):
    """Returns CGAL's options for a mesh of `wanted` vertices: the nearest of six tries, or the first that is a twentieth off."""
    scale, found = 1.0, []
    for _ in range(6):
        if run(*PROGRAMS["CGAL"], volume, "-o", "mesh.mesh", "--report", "run.json", "--improve", "none", *of_size(scale)) != 0:
            sys.exit(f"CGAL has no mesh of {volume}")
        found.append((abs(vertices() / wanted - 1), scale))
        if found[-1][0] < 0.05:
            break
        scale *= (vertices() / wanted) ** 0.4
    return ("--improve", "full", *of_size(min(found)[1]))


def row(volume, name, command):
    """Prints a row.  Returns the number of vertices."""
    if run(*command, volume, "-o", "mesh.mesh", "--report", "run.json") != 0:
        sys.exit(f"{name} has no mesh of {volume}")
    run(convergence.PROGRAM, "verify", volume, "mesh.mesh", "--report", "check.json")
    made, found = (json.loads(pathlib.Path(name).read_text()) for name in ("run.json", "check.json"))
    seconds, tets = made["performance"]["cpu_s"], made["output"]["tets"]
    volumes = found["volume"]
    cells = (pathlib.Path(volume).name, name, f"{seconds:.1f}", f"{made['performance']['peak_rss_bytes'] / 2**20:.0f}",
             f"{made['output']['vertices']:,}", f"{tets / seconds:,.0f}",
             f"{found['topology']['labels_changed']} of {found['labels']}", f"{100 * found['shape']['sharp_share']:.1f} %",
             f"{100 * volumes['volume_error_max_abs']:.1f} / {100 * volumes['volume_error_mean_abs']:.2f} %",
             f"{found['quality']['radius_ratio_min']:.2f} / {found['quality']['radius_ratio_mean']:.3f}")
    print("| " + " | ".join(cells) + " |", flush=True)
    return made["output"]["vertices"]


def main():
    volumes = [str(pathlib.Path(name).resolve()) for name in sys.argv[1:]]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        print("| volume | program | CPU s | MiB | vertices | tets a second and core | labels changed | sharp "
              "| volumes off, most / mean | radius ratio, least / mean |\n|---|---|---|---|---|---|---|---|---|---|")
        for volume in volumes:
            sizes = {name: row(volume, name, command) for name, command in PROGRAMS.items()}
            row(volume, "CGAL, as many, improved", (*PROGRAMS["CGAL"], *alike(volume, sizes["default"])))
        print("\n| conducting ball | unknowns | H1 | H1 by place | L2 |\n|---|---|---|---|---|")
        np.save("volume.npy", convergence.ball(convergence.EDGE))
        for name, command in PROGRAMS.items():
            convergence.row(name, convergence.meshed(*command, "volume.npy"))


if __name__ == "__main__":
    main()
