# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Effective properties of a cell that repeats itself, from what CalculiX has printed."""
import os

from ._errors import InputError

#: CalculiX prints xx, yy, zz, xy, xz, yz.
_VOIGT = (0, 1, 2, 5, 4, 3)
#: The integration points of C3D10 are those of the rule of four points.
_NEAR, _FAR = 0.58541019662496845446, 0.13819660112501051518


def homogenise(job):
    """Returns the effective tensor of a job that ``--deck periodic`` or ``--deck conduction`` wrote.

    job: the ``.inp`` file, which CalculiX has solved (``ccx cell`` for ``cell.inp``), so that
    ``cell.dat`` lies beside it.  Returns the stiffness, 6 x 6, in the order 11, 22, 33, 23, 13, 12
    with shears as angles (2 e12), in the unit of the moduli in the job; or the conductivity, 3 x 3.
    A column is the average of the stress (or of the flux, with its sign turned) over the cell at a
    unit load; what was left out of the mesh counts as empty.  Axes are those of the coordinates.

    Raises InputError where a file is missing or is not of such a job."""
    import numpy as np

    job = os.fspath(job)
    cell, weights = _weights(job, np)
    steps = _printed(os.path.splitext(job)[0] + ".dat", len(weights), weights.shape[1], np)
    of_strains = steps.shape[-1] == 6
    if len(steps) != (6 if of_strains else 3):
        raise InputError(f"{job}: CalculiX has printed {len(steps)} steps of a job that has "
                         f"{6 if of_strains else 3}; look at what it says")
    volume = abs(np.linalg.det(cell))
    means = np.einsum("ep,sepc->cs", weights, steps) / volume
    return means[list(_VOIGT)] if of_strains else -means


def _weights(job, np):
    """Returns the edges of the cell, and the volume that each integration point stands for."""
    nodes, elements, cell, rows = [], [], None, None
    with _opened(job) as file:
        for line in file:
            if line.startswith("** CELL"):
                cell = np.array(line.split()[2:], float).reshape(4, 3)[1:]
            if line.startswith("*"):
                card = line.upper().replace(" ", "")
                rows = (nodes if card.startswith("*NODE\n") else
                        elements if card.startswith("*ELEMENT,TYPE=C3D") else None)
            elif rows is not None:
                rows.append(line)
    if cell is None or not nodes or not elements:
        raise InputError(f"{job}: is not a job of mesh or convert with --deck periodic or conduction")
    places = np.array([line.split(",") for line in nodes], float)[:, 1:]
    corners = np.array([line.split(",") for line in elements], int)
    corners = corners[corners[:, 0].argsort(), 1:] - 1
    return cell, _point_volumes(places[corners], np)


def _point_volumes(places, np):
    """Returns the volumes of the integration points: 1 of a tet of four nodes, 4 of one of ten."""
    if places.shape[1] == 4:
        edges = places[:, 1:] - places[:, :1]
        return np.abs(np.linalg.det(edges))[:, None] / 6
    volumes = []
    for point in range(4):
        share = np.full(4, _FAR)
        share[point] = _NEAR
        volumes.append(np.abs(np.linalg.det(_jacobian(places, share, np))) / 24)
    return np.stack(volumes, 1)


def _jacobian(places, share, np):
    """The derivatives of places by three barycentric coordinates, at one point of all tets."""
    by_share = np.zeros((10, 4))
    for i in range(4):
        by_share[i, i] = 4 * share[i] - 1
    for row, (i, k) in enumerate(((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)), 4):
        by_share[row, i], by_share[row, k] = 4 * share[k], 4 * share[i]
    along = by_share[:, 1:] - by_share[:, :1]
    return np.einsum("nk,enx->ekx", along, places)


def _printed(name, elements, points, np):
    """Returns what was printed, by step, element, integration point and component."""
    steps = []
    with _opened(name) as file:
        for line in file:
            words = line.split()
            if words and words[0] in ("stresses", "heat"):
                steps.append([])
            elif steps and len(words) in (5, 8) and words[0].isdigit():
                steps[-1].append(words)
    if not steps or any(len(step) != elements * points for step in steps):
        raise InputError(f"{name}: has not a line for each of {elements * points} integration points "
                         "in each step; run CalculiX on the job again")
    table = np.array(steps, float)
    table = table[np.arange(len(table))[:, None], np.lexsort((table[..., 1], table[..., 0]))]
    return table[..., 2:].reshape(len(table), elements, points, -1)


def _opened(name):
    try:
        return open(name, encoding="utf-8")
    except OSError as error:
        raise InputError(f"{name}: cannot open: {error.strerror}; run CalculiX on the job first"
                         ) from error
