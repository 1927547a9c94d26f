# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""What tables say of a run, by column: its sizes, cost, quality, and what verify found."""

from render import Column, change, count, fixed, percent, short

VOLUME = Column("volume")
METHOD = Column("method")
NOTE = Column("note")
SIZE = [Column("vertices", count), Column("share of voxel corners", percent)]
COST = [
    Column("peak MiB", count),
    Column("seconds", fixed(1)),
    Column("CPU seconds", fixed(1)),
    Column("voxels/s", count),
]
QUALITY = [Column("RR min", short), Column("RR mean", fixed(3)), Column("slivers", percent)]
TOPOLOGY = [
    Column("labels lost", count),
    Column("labels changed", count),
    Column("components", count),
    Column("change of components", change),
]
DISTANCE = [Column("distance max", fixed(2)), Column("distance mean", fixed(3))]


def head(facts):
    return {"volume": facts.volume, "method": facts.mode, "note": facts.failure}


def voxels(facts):
    return {"voxels": facts.run.get("input", {}).get("voxels")}


def size(facts):
    if facts.failure:
        return {}
    output = facts.run["output"]
    return {
        "vertices": output["vertices"],
        "share of voxel corners": 100 * output["vertex_fraction"],
        "tets": output["tets"],
    }


def cost(facts):
    if facts.failure:
        return {}
    spent = facts.run["performance"]
    return {
        "peak MiB": spent["peak_rss_bytes"] / 2**20,
        "seconds": spent["wall_s"],
        "CPU seconds": spent["cpu_s"],
        "voxels/s": spent["voxels_per_s"],
    }


def quality(facts):
    """From the mesher's report, or of any tool's mesh from verify."""
    found = facts.run.get("quality") or facts.check.get("quality")
    if not found:
        return {}
    return {
        "RR min": found["radius_ratio_min"],
        "RR mean": found["radius_ratio_mean"],
        "slivers": 100 * found["sliver_fraction"],
        "dihedral min": found["dihedral_min_deg"],
    }


def topology(facts, components_of_volume):
    """components_of_volume is None when nobody knows."""
    if facts.failure:
        return {}
    changed = facts.check["topology"]["labels_changed"]
    found = facts.shape["components"]
    known = components_of_volume is not None
    return {
        "labels lost": facts.check["labels"] - facts.shape["labels"],
        "labels changed": changed,
        "components": found,
        "change of components": found - components_of_volume if known else None,
    }


def components_of_volume(runs):
    """Components of all labels in the voxels, from a mesh that verify found to have the topology
    of the voxels in every label."""
    for facts in runs:
        if facts.check.get("topology", {}).get("labels_changed") == 0:
            return facts.shape["components"]
    return None


def distance(facts):
    """Both ways, in voxels, over the labels that have a boundary in volume and mesh: the largest,
    and the mean over labels and ways."""
    rows = (facts.check.get("distance") or {}).get("per_label", [])
    both = [row for row in rows if None not in (row["input_to_mesh_max"], row["mesh_to_input_max"])]
    if not both:
        return {}
    sides = ("input_to_mesh", "mesh_to_input")
    means = [row[f"{side}_mean"] for row in both for side in sides]
    return {
        "distance max": max(row[f"{side}_max"] for row in both for side in sides),
        "distance mean": sum(means) / len(means),
    }


def failing(facts):
    names = [check["name"] for check in facts.check.get("checks", []) if not check["passed"]]
    return {"verify fails": ", ".join(names)}


def stages(facts):
    """Sec 6.2's two kinds of time: labels, blocks and mesh in and out of windows and files; and
    the windows' own work."""
    if facts.failure:
        return {}
    took = facts.run["performance"]["stages"]
    engine = facts.run["engine"]
    return {
        "I/O s": sum(took[f"{key}_s"] for key in ("labels", "prepare", "exchange", "output")),
        "process s": sum(took[f"{key}_s"] for key in ("start", "simplify", "optimise")),
        "total s": facts.run["performance"]["wall_s"],
        "windows": engine["windows"],
        "MiB to disk": engine["bytes_written"] / 2**20,
    }
