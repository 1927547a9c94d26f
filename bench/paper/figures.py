# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Figs 11 to 13 of any volumes: their data as tables, and plots of them."""

import studies
from render import Column, Table, count, percent
from studies import Study

ANGLE_MODES = [studies.DEFAULT, studies.PAPER, studies.CGAL]


def fig_11(runs):
    title = "Fig 11: dihedral angles of tets"
    return _angles(runs, "fig11", title, "dihedral_histogram", 180)


def fig_12(runs):
    title = "Fig 12: least angles of triangles where labels meet or the mesh ends"
    return _angles(runs, "fig12", title, "min_angle_histogram", 60)


def _angles(runs, name, title, key, largest):
    lines = []
    for volume in runs.values():
        for facts in (volume[mode] for mode in ANGLE_MODES):
            counts = facts.shape.get(key, [])
            width = largest / len(counts) if counts else 0
            for i, number in enumerate(counts):
                lines.append(
                    {
                        "volume": facts.volume,
                        "method": facts.mode,
                        "from degrees": i * width,
                        "to degrees": (i + 1) * width,
                        "share": 100 * number / sum(counts),
                    }
                )
    names = ("volume", "method", "from degrees", "to degrees")
    return Table(name, title, [*map(Column, names), Column("share", percent)], lines)


def fig_13(runs):
    lines = []
    for volume in runs.values():
        for mode, (pipeline, window) in studies.window_modes().items():
            facts = volume[mode]
            vertices = facts.run.get("output", {}).get("vertices")
            named = {"volume": facts.volume, "method": pipeline, "window": window}
            lines.append(named | {"vertices": vertices, "note": facts.failure})
    columns = [Column("volume"), Column("method"), Column("window"), Column("vertices", count)]
    return Table("fig13", "Fig 13: vertices by window size", [*columns, Column("note")], lines)


def plot(table, path):
    """One panel a volume, one line a method, as SVG: the same bytes each time."""
    import matplotlib  # only here: not every table needs it

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = table.name
    from matplotlib import pyplot

    volumes = list(dict.fromkeys(row["volume"] for row in table.rows))
    across = min(max(len(volumes), 1), 3)
    down = -(-max(len(volumes), 1) // across)
    size = (5 * across, 3.6 * down)
    figure, panels = pyplot.subplots(down, across, figsize=size, squeeze=False)
    for panel, volume in zip(panels.flat, volumes):
        _panel(panel, volume, [row for row in table.rows if row["volume"] == volume])
    figure.suptitle(table.title)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)


def _panel(panel, volume, lines):
    for method in dict.fromkeys(row["method"] for row in lines):
        mine = [row for row in lines if row["method"] == method]
        if "window" in mine[0]:
            _line(panel, method, [row for row in mine if row["vertices"] is not None])
        else:
            _steps(panel, method, mine)
    panel.set_ylim(0, None)
    panel.set_title(volume)
    panel.legend(fontsize="small")


def _line(panel, method, lines):
    windows, vertices = ([row[key] for row in lines] for key in ("window", "vertices"))
    panel.plot(windows, vertices, marker="o", label=method)
    panel.set(xlabel="window, voxels", ylabel="vertices")


def _steps(panel, method, lines):
    edges = [row["from degrees"] for row in lines] + [lines[-1]["to degrees"]]
    panel.stairs([row["share"] for row in lines], edges, label=method)
    panel.set(xlabel="degrees", ylabel="% of all")


FIGURES = {
    "fig11": Study(ANGLE_MODES, fig_11),
    "fig12": Study(ANGLE_MODES, fig_12),
    "fig13": Study(list(studies.window_modes()), fig_13),
}
