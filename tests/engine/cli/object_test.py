# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""One object out of a store of 4,096^3 voxels, at the cost of the object."""
import json
import os
import re
import unittest

try:
    import numpy as np
except ImportError:
    raise SystemExit(77)
from program import enter_folder, refused, run
from remote_server import Server

SIDE, CHUNK, FACTORS = 4096, 64, (1, 4, 16, 64)
MARGIN = 4
NEURON, OTHER, DUST = 720575940621039145, 77, 5


def write_chunks(path_of, points, labels, write):
    """Calls write(path, array) for each chunk that has a point; the rest is absent."""
    owners = points // CHUNK
    for chunk in np.unique(owners, axis=0):
        mine = (owners == chunk).all(axis=1)
        voxels = np.zeros((CHUNK,) * 3, np.uint64)
        voxels[tuple((points[mine] - chunk * CHUNK).T)] = labels[mine]
        write(path_of(chunk), voxels)


def coarser(points, labels, factor):
    """Voxels of a scale: those that an eighth of is of one label, so that thin parts are lost."""
    rows = np.column_stack([points // factor, labels.astype(np.int64)])
    rows, counts = np.unique(rows, axis=0, return_counts=True)
    rows = rows[8 * counts >= factor ** 3]
    return rows[:, :3], rows[:, 3].astype(np.uint64)


def write_file(path, content):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(content)


def precomputed(folder, points, labels):
    scales = [{"key": str(f), "size": [SIDE // f] * 3, "resolution": [8 * f] * 3,
               "chunk_sizes": [[CHUNK] * 3], "encoding": "raw", "voxel_offset": [0, 0, 0]}
              for f in FACTORS]
    write_file(f"{folder}/info", json.dumps(
        {"@type": "neuroglancer_multiscale_volume", "type": "segmentation", "num_channels": 1,
         "data_type": "uint64", "scales": scales}).encode())
    for f in FACTORS:
        def path_of(chunk):
            spans = [f"{i * CHUNK}-{(i + 1) * CHUNK}" for i in chunk[::-1]]
            return f"{folder}/{f}/" + "_".join(spans)
        write_chunks(path_of, *coarser(points, labels, f),
                     lambda path, voxels: write_file(path, voxels.tobytes()))


def zarr(folder, points, labels):
    datasets = [{"path": str(f), "coordinateTransformations": [
        {"type": "scale", "scale": [float(f)] * 3}]} for f in FACTORS]
    axes = [{"name": n, "type": "space", "unit": "nanometer"} for n in "zyx"]
    write_file(f"{folder}/.zgroup", b'{"zarr_format": 2}')
    write_file(f"{folder}/.zattrs", json.dumps({"multiscales": [
        {"version": "0.4", "axes": axes, "datasets": datasets}]}).encode())
    for f in FACTORS:
        write_file(f"{folder}/{f}/.zarray", json.dumps(
            {"zarr_format": 2, "shape": [SIDE // f] * 3, "chunks": [CHUNK] * 3, "dtype": "<u8",
             "compressor": None, "fill_value": 0, "order": "C", "filters": None}).encode())
        write_chunks(lambda chunk: f"{folder}/{f}/" + ".".join(map(str, chunk)),
                     *coarser(points, labels, f),
                     lambda path, voxels: write_file(path, voxels.tobytes()))


def ball(centre, radius):
    grid = np.stack(np.meshgrid(*[np.arange(-radius, radius + 1)] * 3, indexing="ij"), -1)
    inside = (grid ** 2).sum(-1) <= radius ** 2
    return grid[inside] + np.asarray(centre)


def snake(start, seed):
    """A cell body, and a thin process of some 300 voxels through several chunks."""
    random = np.random.default_rng(seed)
    at, parts = np.asarray(start, float), [ball(start, 20)]
    way = random.normal(size=3)
    for _ in range(150):
        way = way / np.linalg.norm(way) + 0.1 * random.normal(size=3)
        at = at + 2 * way / np.linalg.norm(way)
        parts.append(ball(np.rint(at).astype(int), 3))
    return np.unique(np.concatenate(parts), axis=0)


def box_of(points):
    lo, hi = points.min(0) - MARGIN, points.max(0) + 1 + MARGIN
    return ",".join(str(v) for v in (*lo[::-1], *hi[::-1]))


class OneObject(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        cls.objects = {NEURON: snake((2000, 1500, 1000), 1), OTHER: ball((2900, 100, 3300), 25),
                       DUST: ball((2960, 190, 3330), 24)}
        points = np.concatenate(list(cls.objects.values()))
        labels = np.concatenate([np.full(len(p), label, np.uint64)
                                 for label, p in cls.objects.items()])
        precomputed("stores/precomputed", points, labels)
        zarr("stores/zarr", points, labels)

    def mesh(self, volume, output, *more):
        run("mesh", volume, "-o", output, "--force", "--certify", "off", *more)
        return run("digest", output)

    def test_is_what_a_crop_by_hand_gives(self):
        for kind in ("precomputed", "zarr"):
            for label in (NEURON, OTHER):
                with self.subTest(kind=kind, label=label):
                    store, crop = f"stores/{kind}", box_of(self.objects[label])
                    by_hand = self.mesh(store, "hand.vtkhdf", "--crop", crop, "--labels", label)
                    found = self.mesh(store, "found.vtkhdf", "--object", str(label))
                    self.assertEqual(found, by_hand)

    def test_asks_a_server_for_the_chunks_around_it_alone(self):
        owners = {tuple(c) for c in np.unique(self.objects[NEURON] // CHUNK, axis=0)}
        near = {tuple(np.add(c, d)) for c in owners for d in np.ndindex(5, 5, 5)}
        near = {tuple(int(v) - 2 for v in c) for c in near}
        from_file = self.mesh("stores/precomputed", "file.vtkhdf", "--object", str(NEURON))
        with Server("stores") as server:
            address = f"{server.address}/precomputed"
            self.assertEqual(self.mesh(address, "far.vtkhdf", "--object", str(NEURON)), from_file)
            asked = {path for path, _ in server.requests}
        fine = [re.fullmatch(r"/precomputed/1/(\d+)-\d+_(\d+)-\d+_(\d+)-\d+", p) for p in asked]
        chunks = {tuple(int(v) // CHUNK for v in m.groups()[::-1]) for m in fine if m}
        self.assertGreaterEqual(chunks, owners)
        self.assertLessEqual(chunks, near)
        self.assertLess(len(chunks), 100)
        self.assertLess(len(asked), 500)  # of 262,144 chunks

    def test_takes_several_and_verifies(self):
        both = f"{OTHER},{DUST}"
        run("mesh", "stores/zarr", "-o", "m.vtkhdf", "--force", "--object", both)
        self.assertIn("all checks hold", run("verify", "stores/zarr", "m.vtkhdf", "--object", both))
        info = run("info", "m.vtkhdf")
        for label in (OTHER, DUST):
            self.assertRegex(info, rf"(?m)^ *{label} ")
        self.assertNotRegex(info, r"(?m)^ *0 ")

    def test_has_the_label_that_it_was_merged_into(self):
        merge = ("--merge", f"{OTHER},{DUST}=7")
        run("mesh", "stores/zarr", "-o", "m.vtkhdf", "--force", "--object", f"{OTHER},{DUST}", *merge)
        self.assertRegex(run("info", "m.vtkhdf"), r"(?m)^ *7 ")
        self.assertIn("all checks hold", run("verify", "stores/zarr", "m.vtkhdf", "--object",
                                             f"{OTHER},{DUST}", *merge))

    def test_refuses_what_is_not_there(self):
        for more, code, words in ((("12", "--crop", "0,0,0,512,512,512"), 3, "no voxel has 12"),
                                  (("0",), 2, "label 0"),
                                  ((OTHER, "--crop", "0,0,0,64,64,64"), 3, "no voxel has 77"),
                                  ((OTHER, "--from", "kept", "--changed", "0,0,0,9,9,9"), 2,
                                   "--changed")):
            refused([words], "mesh", "stores/precomputed", "-o", "x.vtkhdf", "--object", *more, code=code)
            self.assertFalse(os.path.exists("x.vtkhdf"))


if __name__ == "__main__":
    unittest.main()
