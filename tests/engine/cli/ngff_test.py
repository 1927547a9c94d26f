#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Multiscale images of OME-NGFF: levels, places, units, labels, and what a store holds."""
import json
import os
import pathlib
import shutil
import unittest

from stores import Stores, numpy, save_v2, write
from zarr_test import Array


class Images(Stores):
    """The first label of an array tells which level it is of: 10, 11, .."""

    @staticmethod
    def axes(names, kind="space", unit="nanometer"):
        return [{"name": name, "type": kind, **({"unit": unit} if unit else {})} for name in names]

    @staticmethod
    def level(path, scale, moved=None):
        transforms = [{"type": "scale", "scale": scale}]
        transforms += [{"type": "translation", "translation": moved}] if moved else []
        return {"path": path, "coordinateTransformations": transforms}

    def image(self, *levels, axes=None, **others):
        return {"axes": axes or self.axes("zyx"), "datasets": list(levels), **others}

    @staticmethod
    def save_array(path, version, mark, shape=(2, 3, 4)):
        labels = numpy.full(shape, mark, "u1")
        if version == 2:
            save_v2(path, labels, shape, overwrite=True)
        else:
            Array(labels, list(shape)).save(path)

    def save(self, folder, image, version=2):
        if version == 3:
            ome = {"version": "0.5", "multiscales": [image]}
            write(f"{folder}/zarr.json", {"zarr_format": 3, "node_type": "group",
                                          "attributes": {"ome": ome}})
        else:
            write(f"{folder}/.zgroup", {"zarr_format": 2})
            write(f"{folder}/.zattrs", {"multiscales": [{"version": "0.4", **image}]})
        for i, level in enumerate(image["datasets"]):
            self.save_array(f"{folder}/{level['path']}", version, 10 + i)

    def mark(self, path, *arguments):
        return self.facts(path, *arguments)["labels"]["max"]

    def test_levels_and_their_scales(self):
        image = self.image(self.level("s0", [30, 4, 5]), self.level("deep/s1", [60, 8, 10]))
        for version in (2, 3):
            name = f"v{version}"
            self.save(name, image, version)
            self.expect(self.facts(name), spacing=[5, 4, 30], origin=[0, 0, 0], unit="nm")
            self.assertEqual(self.mark(name), 10)
            self.expect(self.facts(name, "--scale", 1), spacing=[10, 8, 60])
            self.assertEqual(self.mark(name, "--scale", 1), 11)
            self.refuse(["--scale", "2 scales", "0 (the finest) to 1"], name, "--scale", 2, code=2)

    def test_translations_place_centres(self):
        """A pyramid of means: the first voxel of level 1 is the mean of two, so its centre moves
        by half."""
        whole = [{"type": "scale", "scale": [1, 1, 10]},
                 {"type": "translation", "translation": [100, 200, 300]}]
        coarse = self.level("1", [4, 8, 12], [1, 2, 3])
        self.save("a", self.image(self.level("0", [2, 4, 6]), coarse,
                                  coordinateTransformations=whole))
        corner, array = [300 - 30, 200 - 2, 100 - 1], {"lo": [0, 0, 0], "hi": [4, 3, 2]}
        boxes = {"crop": {"lo": [5, 50, 50], "hi": [9, 53, 52]}, "array": array}
        self.expect(self.facts("a"), spacing=[60, 4, 2], origin=corner, boxes=boxes)
        coarse = self.facts("a", "--scale", 1)
        self.expect(coarse, spacing=[120, 8, 4], origin=corner)
        self.assertNotIn("boxes", coarse)  # 25.25 voxels from 0, which is no number of a voxel
        self.expect(self.facts("a", "--spacing", "1,2,3", "--origin", "7,8,9"), spacing=[1, 2, 3],
                    origin=[7, 8, 9], boxes=boxes)

    def test_axes_by_name_and_by_type(self):
        for axes, spacing, shape in (
                (self.axes("xyz", unit=""), [1, 2, 3], [2, 3, 4]),
                (self.axes("zyx"), [3, 2, 1], [4, 3, 2]),
                (self.axes(["depth", "h", "w"], unit=""), [3, 2, 1], [4, 3, 2]),
                (["z", "y", "x"], [3, 2, 1], [4, 3, 2])):
            self.save("a", self.image(self.level("0", [1, 2, 3]), axes=axes))
            self.expect(self.facts("a"), spacing=spacing, shape=shape)

    def test_five_axes_two_axes_and_no_transformations(self):
        axes = [*self.axes("t", "time", "second"), *self.axes("c", "channel", ""),
                *self.axes("zyx", unit="micrometer")]
        self.save("a", self.image(self.level("0", [1, 1, 3, 2, 0.5]), axes=axes))
        self.save_array("a/0", 2, 5, (1, 1, 2, 3, 4))
        self.expect(self.facts("a"), shape=[4, 3, 2], spacing=[0.5, 2, 3], unit="um")
        write("a/.zattrs", {"multiscales": [{"version": "0.2", "datasets": [{"path": "0"}]}]})
        self.expect(self.facts("a"), spacing=[1, 1, 1])
        self.save("b", self.image(self.level("0", [2, 0.5]), axes=axes[3:]))
        self.save_array("b/0", 2, 5, (3, 4))
        self.expect(self.facts("b"), shape=[4, 3, 1], spacing=[0.5, 2, 1])

    def test_levels_opened_as_arrays_keep_their_place(self):
        for version in (2, 3):
            name = f"v{version}"
            self.save(name, self.image(self.level("0", [2, 4, 6]), self.level("1", [4, 8, 12])),
                      version)
            for call in ([f"{name}/1"], [f"{name}/1/"], [name, "--dataset", "1"]):
                self.expect(self.facts(*call), spacing=[12, 8, 4])
                self.assertEqual(self.mark(*call), 11)
            self.refuse(["--scale 1", "without levels"], name, "--dataset", "1", "--scale", "1",
                        code=2)

    def test_labels_of_an_image(self):
        image = self.image(self.level("0", [1, 1, 1]))
        for version in (2, 3):
            name = f"v{version}"
            self.save(name, image, version)
            self.save(f"{name}/labels/cells", image, version)
            shutil.rmtree(f"{name}/labels/cells/0")
            self.save_array(f"{name}/labels/cells/0", 2, 99)
            if version == 2:
                write(f"{name}/labels/.zgroup", {})
                write(f"{name}/labels/.zattrs", {"labels": ["cells"]})
            else:
                ome = {"ome": {"version": "0.5", "labels": ["cells"]}}
                write(f"{name}/labels/zarr.json", {"zarr_format": 3, "node_type": "group",
                                                   "attributes": ome})
            self.assertEqual(self.mark(name), 10)
            for dataset in ("labels/cells", "/labels//cells/", "labels"):  # the only one there
                self.assertEqual(self.mark(name, "--dataset", dataset), 99)
            self.assertEqual(self.mark(f"{name}/labels/cells"), 99)
            self.refuse(["--dataset labels/nuclei", "labels/cells"], name, "--dataset",
                        "labels/nuclei", code=2)
            self.refuse_what_is_no_image_of_labels(name, image, version)

    def refuse_what_is_no_image_of_labels(self, name, image, version):
        """Its labels are named then: floats are not what is meant, nor are several channels."""
        path = pathlib.Path(name, "0", ".zarray" if version == 2 else "zarr.json")
        array = json.loads(path.read_text(encoding="utf-8"))
        write(path, {**array, **({"dtype": "<f4"} if version == 2 else {"data_type": "float32"})})
        self.refuse(["f32", "--dataset labels/cells"], name)
        axes = [*self.axes("c", "channel", ""), *image["axes"]]
        self.save(name, {**image, "axes": axes}, version)
        shutil.rmtree(f"{name}/0")
        self.save_array(f"{name}/0", version, 1, (2, 2, 3, 4))
        self.refuse(["'c'", "2 entries", "--dataset labels/cells"], name)

    def test_wrong_metadata_are_named(self):
        one = self.level("0", [1, 1, 1])
        self.save("a", self.image(one))

        def refuse(image, *words):
            write("a/.zattrs", {"multiscales": [image]})
            self.refuse([*words, ".zattrs"], "a")

        def with_transform(*transforms):
            return self.image({"path": "0", "coordinateTransformations": transforms})

        refuse(self.image(self.level("0", [1, 0, 1])), "scale (y)", "spacing 0")
        refuse(self.image(self.level("0", [1, 1])), "coordinateTransformations", "2 numbers")
        refuse(self.image(self.level("0", [1, 1, 1], [1, 1])), "translation", "2 numbers")
        refuse(with_transform({"type": "affine"}), "coordinateTransformations[0].type", "affine")
        refuse(with_transform({"type": "scale", "path": "s"}), "path")
        refuse(self.image(self.level("0", [1, "a", 1])), "scale", '"a"')
        refuse(self.image(), "datasets")
        refuse({"axes": self.axes("zyx")}, "datasets", "missing")
        refuse(self.image(one, version="0.6"), "version", "0.6")
        refuse(self.image(one, axes=self.axes("zy")), "axes", "2 axes", "3")
        refuse(self.image(self.level("1", [1, 1, 1])), "datasets[0].path", "'1'")
        for path in ("../0", "."):
            refuse(self.image(self.level(path, [1, 1, 1])), "datasets[0].path")
        mixed = [*self.axes("z", unit="micrometer"), *self.axes("yx")]
        refuse(self.image(one, axes=mixed), "units", "'nm'", "'um'", "--spacing")
        self.expect(self.facts("a", "--spacing", "1,2,3"), unit=None)

    def test_stores_of_several_arrays(self):
        write("a/.zgroup", {})
        self.refuse("no array", "a")
        write("a/volumes/.zgroup", {})
        self.save_array("a/volumes/ids", 2, 1)
        write("a/chunks/0/0", "no group")
        self.assertEqual(self.mark("a"), 1)
        self.save_array("a/more", 3, 2)
        self.refuse(["more, volumes/ids", "--dataset"], "a")
        for dataset, mark in (("volumes/ids", 1), ("more", 2), ("volumes", 1)):
            self.assertEqual(self.mark("a", "--dataset", dataset), mark)
        for wrong in ("less", "../a/more", "more/.."):
            words = ["--dataset " + wrong, "more, volumes/ids"]
            self.refuse(words, "a", "--dataset", wrong, code=2)
        os.makedirs("b.zarr")
        self.refuse(["b.zarr", ".zarray"], "b.zarr")


if __name__ == "__main__":
    unittest.main()
