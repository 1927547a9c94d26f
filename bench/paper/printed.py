# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The numbers that the paper prints, by its tables.  G and M are taken as 1024 M and MiB."""

DELAUNAY = "paper: Delaunay refinement"
MAD = "paper: MAD"
WINDOWS = "paper: Marching Windows"

# Table 1: voxels along x, y, z.
SHAPE = {
    "Spine": (545, 171, 171),
    "Teeth": (305, 237, 227),
    "Chest": (512, 512, 438),
    "Kidney": (512, 512, 611),
    "Mito": (2048, 2048, 1000),
}

# Table 2: data set, method, vertices, their share of the input's in %, memory in MiB, seconds.
# Mito: 122.13 G is for the merge, the windows took about 1 G.
TABLE_2 = [
    ("Spine", DELAUNAY, 7813, 0.05, 90, 21),
    ("Spine", MAD, 61884, 0.39, 44.99 * 1024, 1.87 * 3600),
    ("Spine", WINDOWS, 69546, 0.44, 0.23 * 1024, 0.88 * 3600),
    ("Teeth", DELAUNAY, 10559, 0.06, 99, 27),
    ("Teeth", MAD, 76589, 0.47, 46.39 * 1024, 1.93 * 3600),
    ("Teeth", WINDOWS, 68892, 0.42, 0.42 * 1024, 0.93 * 3600),
    ("Chest", DELAUNAY, 165663, 0.01, 952, 158),
    ("Chest", WINDOWS, 485664, 0.42, 1.18 * 1024, 6.7 * 3600),
    ("Kidney", DELAUNAY, 3120, 0.002, 679, 33),
    ("Kidney", WINDOWS, 646151, 0.40, 1.20 * 1024, 8.95 * 3600),
    ("Mito", WINDOWS, 2291769, 0.05, 122.13 * 1024, 306.37 * 3600),
]

# Table 3: data set, with CODT or not, radius ratio least and mean, slivers in %.
TABLE_3 = [
    ("Spine", False, 3.24e-6, 0.49, 11.25),
    ("Spine", True, 2.04e-6, 0.58, 4.75),
    ("Teeth", False, 1.56e-6, 0.49, 11.28),
    ("Teeth", True, 2.30e-6, 0.58, 4.83),
    ("Chest", False, 1.51e-6, 0.48, 11.55),
    ("Chest", True, 1.54e-6, 0.57, 5.18),
    ("Kidney", False, 1.46e-6, 0.49, 11.32),
    ("Kidney", True, 2.28e-6, 0.58, 4.90),
    ("Mito", True, 2.32e-8, 0.57, 3.97),
]

# Table 4 (Teeth): target edge variance, vertices, share in %, radius ratio least and mean,
# slivers in %.
TABLE_4 = [
    (3, 160204, 0.98, 1.62e-5, 0.69, 1.12),
    (5, 101441, 0.62, 6.91e-6, 0.65, 2.12),
    (10, 68892, 0.42, 2.30e-6, 0.58, 4.83),
]

# Table 5 (Teeth): window edge, seconds of I/O, of processing, and their total as printed.
TABLE_5 = [
    (100, 72, 3730, 3792),
    (80, 79, 3574, 3653),
    (60, 103, 3437, 3540),
    (40, 156, 3259, 3415),
    (20, 2815, 3015, 5830),
]

# Table 6: data set, method, largest Hausdorff distance, change of the number of components.
TABLE_6 = [
    ("Spine", DELAUNAY, 13.29, 1),
    ("Spine", MAD, 12.23, 0),
    ("Spine", WINDOWS, 6.51, 0),
    ("Teeth", DELAUNAY, 12.62, -10),
    ("Teeth", MAD, 11.58, 0),
    ("Teeth", WINDOWS, 5.11, 0),
    ("Chest", DELAUNAY, 74.02, -55),
    ("Chest", WINDOWS, 18.83, 0),
    ("Kidney", DELAUNAY, 26.68, -19),
    ("Kidney", WINDOWS, 5.55, 0),
    ("Mito", WINDOWS, 36.15, 0),
]
