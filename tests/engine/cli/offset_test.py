# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Boxes of stores whose first voxel is not 0 count as the data set does, in all that takes or prints one."""
import json
import os
import unittest

try:
    import numpy as np
except ImportError:
    raise SystemExit(77)
from program import enter_folder, refused, run, start

OFFSET, SPACING = np.array([26, -30, 14]), np.array([8, 8, 40])
LO, HI = np.array([4, 6, 2]), np.array([20, 22, 18])  # in the array


def write_file(path, content):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(content if isinstance(content, bytes) else json.dumps(content).encode())


def text_of(lo, hi):
    return ",".join(str(v) for v in (*lo, *hi))


def precomputed(labels):
    scale = {"key": "k", "size": labels.shape, "resolution": SPACING.tolist(), "encoding": "raw",
             "chunk_sizes": [labels.shape], "voxel_offset": OFFSET.tolist()}
    write_file("precomputed/info", {"type": "segmentation", "num_channels": 1, "scales": [scale],
                                    "data_type": "uint16"})
    name = "_".join(f"{o}-{o + n}" for o, n in zip(OFFSET, labels.shape))
    write_file(f"precomputed/k/{name}", labels.tobytes(order="F"))


def n5(labels):
    write_file("a.n5/attributes.json", {
        "dimensions": labels.shape, "blockSize": labels.shape, "dataType": "uint16",
        "compression": {"type": "raw"}, "resolution": SPACING.tolist(), "units": ["nm"] * 3,
        "offset": (OFFSET * SPACING).tolist()})
    head = np.array([0, 3], ">u2").tobytes() + np.array(labels.shape, ">u4").tobytes()
    write_file("a.n5/0/0/0", head + labels.astype(">u2").tobytes(order="F"))


def ngff(labels):
    steps = [{"type": "scale", "scale": SPACING[::-1].tolist()},
             {"type": "translation", "translation": (OFFSET * SPACING)[::-1].tolist()}]
    axes = [{"name": n, "type": "space", "unit": "nanometer"} for n in "zyx"]
    write_file("a.zarr/.zgroup", {"zarr_format": 2})
    write_file("a.zarr/.zattrs", {"multiscales": [{"version": "0.4", "axes": axes, "datasets": [
        {"path": "0", "coordinateTransformations": steps}]}]})
    write_file("a.zarr/0/.zarray", {
        "zarr_format": 2, "shape": labels.shape[::-1], "chunks": labels.shape[::-1], "dtype": "<u2",
        "compressor": None, "fill_value": 0, "order": "C", "filters": None})
    write_file("a.zarr/0/0.0.0", labels.T.tobytes(order="C"))


STORES = {"precomputed": precomputed, "a.n5": n5, "a.zarr": ngff}


class Offsets(unittest.TestCase):
    def setUp(self):
        enter_folder(self)
        self.labels = np.zeros((24, 24, 20), np.uint16)
        x, y, z = np.indices(self.labels.shape)
        self.labels[:] = 1 + x // 8 + 3 * (y // 8) + 9 * (z // 10)
        self.save()

    def save(self):
        np.save("part.npy", self.labels[tuple(map(slice, LO, HI))].T)
        for write in STORES.values():
            write(self.labels)

    def info(self, *arguments):
        return json.loads(run("info", *arguments, "--json"))

    def test_crop_is_the_box_that_a_viewer_shows(self):
        crop = text_of(LO + OFFSET, HI + OFFSET)
        for store in STORES:
            with self.subTest(store):
                centre = store == "a.zarr"  # whose voxel 0 has its centre at 0, not its corner
                origin = (LO + OFFSET - (0.5 if centre else 0)) * SPACING
                run("mesh", "part.npy", "-o", "part.mesh", "--force", "--spacing", "8,8,40",
                    "--origin", ",".join(map(str, origin)))
                done = start("mesh", store, "-o", "crop.mesh", "--force", "--crop", crop)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(f"counts voxels, {text_of(LO, HI)} in its array", done.stdout)
                self.assertEqual(run("digest", "crop.mesh"), run("digest", "part.mesh"))
                run("verify", store, "crop.mesh", "--crop", crop)

    def test_errors_and_info_have_both_boxes(self):
        shape = np.array(self.labels.shape)
        for store in STORES:
            with self.subTest(store):
                words = [f"{text_of(OFFSET, OFFSET + shape)} as the data set counts",
                         f"{text_of(shape * 0, shape)} in its array"]
                refused(words, "mesh", store, "-o", "a.vtu", "--crop", "0,0,0,8,8,8", code=2)
                self.assertEqual(self.info(store)["boxes"], {
                    "crop": {"lo": OFFSET.tolist(), "hi": (OFFSET + shape).tolist()},
                    "array": {"lo": [0, 0, 0], "hi": shape.tolist()}})
                part = self.info(store, "--crop", text_of(LO + OFFSET, HI + OFFSET))
                self.assertEqual(part["boxes"], {
                    "crop": {"lo": (LO + OFFSET).tolist(), "hi": (HI + OFFSET).tolist()},
                    "array": {"lo": LO.tolist(), "hi": HI.tolist()}})

    def test_boxes_of_labels_are_ones_to_crop(self):
        for store in STORES:
            for crop in ((), ("--crop", text_of(LO + OFFSET, HI + OFFSET))):
                with self.subTest(store, crop=crop):
                    row = self.info(store, *crop)["labels"]["per_label"][4]
                    alone = self.info(store, "--crop", text_of(row["lo"], row["hi"]))["labels"]
                    self.assertEqual([alone["count"], alone["min"]], [1, row["label"]])
                    self.assertEqual(alone["per_label"][0]["voxels"], row["voxels"])

    def test_object_is_within_the_crop(self):
        for store in STORES:
            with self.subTest(store):
                facts = self.info(store, "--object", "5", "--crop", text_of(LO + OFFSET, HI + OFFSET))
                (row,) = [row for row in facts["labels"]["per_label"] if row["label"] == 5]
                where = np.argwhere(self.labels == 5)
                where = where[((where >= LO) & (where < HI)).all(1)]
                self.assertEqual(row["lo"], (where.min(0) + OFFSET).tolist())
                self.assertEqual(row["hi"], (where.max(0) + 1 + OFFSET).tolist())
                self.assertEqual(row["voxels"], len(where))

    def test_changed_boxes_and_deltas(self):
        edit = tuple(map(slice, (9, 9, 4), (12, 13, 7)))
        box = text_of(np.array([9, 9, 4]) + OFFSET, np.array([12, 13, 7]) + OFFSET)
        settings = ("--order", "colour", "--certify", "off", "--force")
        for crop in ((), ("--crop", text_of(LO + OFFSET, HI + OFFSET))):
            for store in STORES:
                with self.subTest(store, crop=crop):
                    mesh = ("mesh", store, "-o", "a.mesh", *settings, *crop)
                    run(*mesh, "--keep", f"k{len(crop)}{store}")
                    before = run("digest", "a.mesh")
                    self.labels[edit] += 1
                    self.save()
                    run(*mesh, "--from", f"k{len(crop)}{store}", "--changed", box, "--delta", "d.json")
                    updated = run("digest", "a.mesh")
                    run(*mesh)
                    self.assertEqual(updated, run("digest", "a.mesh"))
                    self.assertNotEqual(updated, before)
                    with open("d.json", encoding="utf-8") as delta:
                        found = json.load(delta)["box"]
                    self.assertEqual(text_of(found["from"], found["to"]), box)
                    self.labels[edit] -= 1
                    self.save()
        run("mesh", "precomputed", "-o", "a.mesh", *settings, "--keep", "k")
        refused(["outside"], "mesh", "precomputed", "-o", "a.mesh", *settings, "--from", "k", "--changed",
                "0,0,0,2,2,2", code=2)

    def test_a_volume_that_begins_at_0_says_nothing(self):
        self.assertNotIn("boxes", self.info("part.npy"))
        done = start("mesh", "part.npy", "-o", "a.mesh", "--crop", "0,0,0,8,8,8")
        self.assertNotIn("counts voxels", done.stdout)


if __name__ == "__main__":
    unittest.main()
