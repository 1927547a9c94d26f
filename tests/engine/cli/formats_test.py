#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Every input format gives the mesh of the same voxels in .npy, in the same place, byte for byte.

The files come from writers that share nothing with the readers: nibabel, h5py, zarr, tifffile and
vtk where they are installed, and bytes laid out by hand after the specifications.
"""
import gzip
import json
import os
import sys
import unittest
import warnings
import zlib

from program import RESIDENT_MEMORY_IS_OURS, enter_folder, run

try:
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
from stores import save_v2

SPACING = numpy.array([1.25, 1.0, 1.5])  # x, y, z
CORNER = numpy.array([-20.5, 7.25, 100.0])
CENTRE = CORNER + SPACING / 2
PLACE = [
    "--spacing", ",".join(map(str, SPACING)), "--origin=" + ",".join(map(str, CORNER))
]


def needs(module):
    """The module, or a skipped test."""
    try:
        return __import__(module)
    except ImportError as missing:
        raise unittest.SkipTest(str(missing)) from None


def triple(values):
    return " ".join(repr(float(v)) for v in values)


class Formats(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        random = numpy.random.default_rng(7)
        z, y, x = numpy.indices((21, 18, 26))
        labels = ((x - 9) ** 2 + (y - 8) ** 2 + (z - 10) ** 2 < 50).astype(numpy.uint16) * 3
        labels[(x > 15) & (y + z > 20)] = 40000
        labels[random.random(labels.shape) < 0.01] = 17
        cls.labels = labels
        numpy.save("array.npy", labels)
        run("mesh", "array.npy", *PLACE, "-o", "array.vtkhdf")
        cls.digest = run("digest", "array.vtkhdf")

    def check(self, path, *arguments):
        run("mesh", path, *arguments, "-o", "out.vtkhdf")
        self.assertEqual(run("digest", "out.vtkhdf"), self.digest, path)

    def test_npy_orders_and_types(self):
        for name, array in {
            "fortran": numpy.asfortranarray(self.labels),
            "big": self.labels.astype(">u4"),
            "wide": self.labels.astype("i8"),
            "floats": self.labels.astype("f4"),
            "doubles": self.labels.astype(">f8"),
        }.items():
            numpy.save(name + ".npy", array)
            self.check(name + ".npy", *PLACE)

    def test_nifti(self):
        nibabel = needs("nibabel")
        affine = numpy.diag([*SPACING, 1.0])
        affine[:3, 3] = CENTRE
        image = nibabel.Nifti1Image(self.labels.transpose(2, 1, 0), affine)
        for name in ("a.nii", "a.nii.gz"):
            nibabel.save(image, name)
            self.check(name)
            told = json.loads(run("info", name, "--json"))["affine_of_centres"]
            numpy.testing.assert_allclose(told, nibabel.load(name).affine, atol=1e-6)
        nibabel.save(nibabel.Nifti2Image(self.labels.transpose(2, 1, 0)[..., None], affine), "b.nii")
        self.check("b.nii")

    def nrrd_header(self, encoding):
        directions = " ".join(
            "(" + ",".join(repr(float(v)) for v in row) + ")" for row in numpy.diag(SPACING)
        )
        return (
            "NRRD0004\ntype: unsigned short\ndimension: 3\nspace: left-posterior-superior\n"
            f"sizes: 26 18 21\nspace directions: {directions}\nkinds: domain domain domain\n"
            f"endian: little\nencoding: {encoding}\n"
            "space origin: (" + ",".join(repr(float(v)) for v in CENTRE) + ")\n"
        ).encode()

    def test_nrrd(self):
        data = self.labels.astype("<u2").tobytes()
        with open("a.nrrd", "wb") as file:
            file.write(self.nrrd_header("raw") + b"\n" + data)
        self.check("a.nrrd")
        with open("b.nrrd", "wb") as file:
            file.write(self.nrrd_header("gzip") + b"\n" + gzip.compress(data))
        self.check("b.nrrd")

    def test_frames_of_one_image(self):
        """LPS turned to RAS is the same image as RAS."""
        data = self.labels.astype("<u2").tobytes()
        turned = self.nrrd_header("raw").decode()
        turned = turned.replace("left-posterior-superior", "right-anterior-superior")
        turned = turned.replace("(1.25,0.0,0.0) (0.0,1.0,0.0)", "(-1.25,0.0,0.0) (0.0,-1.0,0.0)")
        x, y, z = CENTRE
        turned = turned.replace(f"({x},{y},{z})", f"({-x},{-y},{z})")
        with open("ras.nrrd", "wb") as file:
            file.write(turned.encode() + b"\n" + data)
        self.check("ras.nrrd", "--frame", "lps")

    def metaimage_header(self, extra):
        return (
            "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
            "TransformMatrix = 1 0 0 0 1 0 0 0 1\n"
            f"Offset = {triple(CENTRE)}\nCenterOfRotation = 0 0 0\nElementSpacing = {triple(SPACING)}\n"
            f"DimSize = 26 18 21\n{extra}ElementType = MET_USHORT\n"
        )

    def test_metaimage(self):
        data = self.labels.astype("<u2").tobytes()
        with open("a.mha", "wb") as file:
            file.write((self.metaimage_header("") + "ElementDataFile = LOCAL\n").encode() + data)
        self.check("a.mha")
        packed = zlib.compress(data)
        extra = f"CompressedData = True\nCompressedDataSize = {len(packed)}\n"
        with open("b.zraw", "wb") as file:
            file.write(packed)
        with open("b.mhd", "w") as file:
            file.write(self.metaimage_header(extra) + "ElementDataFile = b.zraw\n")
        self.check("b.mhd")

    def test_metaimage_by_vtk(self):
        vtk = needs("vtk")
        writer = vtk.vtkMetaImageWriter()
        writer.SetInputData(self.vtk_points(self.labels))
        for compressed in (False, True):
            writer.SetCompression(compressed)
            writer.SetFileName("v.mha")
            writer.Write()
            self.check("v.mha")
            writer.SetFileName("v.mhd")
            writer.SetRAWFileName("v.zraw" if compressed else "v.raw")
            writer.Write()
            self.check("v.mhd")

    def test_metaimage_of_slices(self):
        os.makedirs("raws")
        for z, page in enumerate(self.labels):
            page.astype(">u2").tofile(f"raws/p{z:02}.raw")
        big = self.metaimage_header("").replace("OrderMSB = False", "OrderMSB = True")
        names = "".join(f"raws/p{z:02}.raw\n" for z in range(21))
        for value in ("LIST\n" + names, "raws/p%02d.raw 0 20 1\n"):
            with open("l.mhd", "w") as file:
                file.write(big + "ElementDataFile = " + value)
            self.check("l.mhd")

    def test_hdf5(self):
        h5py = needs("h5py")
        with h5py.File("plain.h5", "w") as file:
            file.create_dataset("seg", data=self.labels, chunks=(8, 7, 9), compression="gzip",
                                shuffle=True)
            file.create_dataset("raw", data=numpy.zeros((5, 5), "f4"))
        self.check("plain.h5", *PLACE)
        self.check("plain.h5", "--dataset", "seg", *PLACE)
        for libver in ("earliest", "latest"):
            with h5py.File("lzf.h5", "w", libver=libver) as file:
                file.create_dataset("seg", data=self.labels.astype(">i8"), chunks=(8, 7, 9),
                                    compression="lzf", fletcher32=True, maxshape=(None, 18, None))
            self.check("lzf.h5", *PLACE)
        with h5py.File("cremi.h5", "w") as file:
            data = file.create_dataset("volumes/labels/neuron_ids", data=self.labels.astype("u8"))
            data.attrs["resolution"] = SPACING[::-1]
            data.attrs["offset"] = CORNER[::-1]
        self.check("cremi.h5")
        with h5py.File("grains.dream3d", "w") as file:
            image = file.create_group("DataContainers/ImageDataContainer")
            image.create_dataset("CellData/FeatureIds", data=self.labels.astype("i4")[..., None])
            geometry = image.create_group("_SIMPL_GEOMETRY")
            geometry.create_dataset("DIMENSIONS", data=numpy.array([26, 18, 21], "i8"))
            geometry.create_dataset("SPACING", data=SPACING.astype("f4"))
            geometry.create_dataset("ORIGIN", data=CORNER.astype("f4"))
        self.check("grains.dream3d")

    @unittest.skipUnless(RESIDENT_MEMORY_IS_OURS, "resident memory is a sanitizer's")
    def test_chunks_are_in_the_memory_budget(self):
        zarr = needs("zarr")
        z, y, x = numpy.indices((96, 128, 128))
        labels = (x // 20 + 7 * (y // 18) + 50 * (z // 22)).astype("u8") << 40
        numpy.save("cells.npy", labels)
        array = zarr.open("cells.zarr", mode="w", shape=labels.shape, chunks=(32, 64, 64), dtype="u8")
        array[:] = labels
        budget = 64 << 20
        for volume in ("cells.npy", "cells.zarr"):
            run("mesh", volume, "-o", volume + ".vtkhdf", "--memory", "64MiB", "--report", "r.json")
            with open("r.json") as file:
                self.assertLess(json.load(file)["performance"]["peak_rss_bytes"], budget)
        self.assertEqual(run("digest", "cells.npy.vtkhdf"), run("digest", "cells.zarr.vtkhdf"))

    def test_zarr_v2(self):
        packers = needs("zarr") and needs("numcodecs")
        blosc = [packers.Blosc(cname=name, shuffle=shuffle) for name, shuffle in (
            ("lz4", 1), ("lz4hc", 1), ("zstd", 2), ("zlib", 0), ("blosclz", -1), ("snappy", 1))]
        for number, packer in enumerate((
                None, packers.Zlib(), packers.GZip(), packers.Zstd(), packers.LZ4(), packers.BZ2(),
                packers.LZMA(), *blosc)):
            name, separator = f"v2{number}.zarr", "./"[number % 2]
            save_v2(name, self.labels.astype("<u8"), (8, 10, 6), order="CF"[number // 2 % 2],
                    dimension_separator=separator, compressor=packer,
                    fill_value=0 if number % 3 else None, write_empty_chunks=number % 5 == 0)
            self.check(name, *PLACE)

    def test_ome_ngff(self):
        group = needs("zarr").open_group("ome.zarr", mode="w", zarr_version=2)
        for name, labels in (("0", self.labels), ("1", self.labels[::2, ::2, ::2])):
            save_v2(f"ome.zarr/{name}", labels[None].astype("u2"), (1, 8, 8, 8),
                    dimension_separator="/", compressor=needs("numcodecs").Blosc())
        def level(path, factor):
            scale = SPACING[::-1] * factor
            shift = CENTRE[::-1] + SPACING[::-1] * (factor - 1) / 2
            return {"path": path, "coordinateTransformations": [
                {"type": "scale", "scale": [1.0, *scale]},
                {"type": "translation", "translation": [0.0, *shift]}]}
        group.attrs["multiscales"] = [{
            "version": "0.4",
            "axes": [{"name": "c", "type": "channel"}] + [
                {"name": n, "type": "space", "unit": "micrometer"} for n in "zyx"],
            "datasets": [level("0", 1), level("1", 2)]}]
        self.check("ome.zarr")
        self.check("ome.zarr", "--scale", "0")

    def test_zarr_v3(self):
        """Chunks after the specification, transposed and gzipped."""
        os.makedirs("v3.zarr")
        chunk = (8, 10, 6)
        with open("v3.zarr/zarr.json", "w") as file:
            json.dump({
                "zarr_format": 3, "node_type": "array", "shape": list(self.labels.shape),
                "data_type": "uint16", "fill_value": 0, "attributes": {},
                "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": list(chunk)}},
                "chunk_key_encoding": {"name": "default", "configuration": {"separator": "/"}},
                "codecs": [
                    {"name": "transpose", "configuration": {"order": [2, 1, 0]}},
                    {"name": "bytes", "configuration": {"endian": "big"}},
                    {"name": "gzip", "configuration": {"level": 5}}]}, file)
        for index in numpy.ndindex(3, 2, 5):
            part = numpy.zeros(chunk, ">u2")
            lo = [i * n for i, n in zip(index, chunk)]
            held = self.labels[tuple(slice(l, l + n) for l, n in zip(lo, chunk))]
            if not held.any():
                continue  # a chunk of fill values need not be there
            part[tuple(slice(0, n) for n in held.shape)] = held
            path = "v3.zarr/c/" + "/".join(map(str, index))
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "wb") as file:
                file.write(gzip.compress(part.transpose(2, 1, 0).tobytes()))
        self.check("v3.zarr", *PLACE)

    def test_n5(self):
        zarr, packers = needs("zarr"), needs("numcodecs")
        if not hasattr(zarr, "N5Store"):
            self.skipTest("zarr 3 writes no N5")
        for packer in (None, packers.GZip(), packers.Zlib(), packers.BZ2(), packers.LZMA(preset=1),
                       packers.LZ4(), packers.Zstd(), packers.Blosc(cname="zstd")):
            name = f"{type(packer).__name__}.n5"
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # not all programs know blosc
                array = zarr.create(self.labels.shape, chunks=(8, 10, 6), dtype="u4",
                                    store=zarr.N5Store(name), path="seg", compressor=packer)
            array[:] = self.labels
            array.attrs["resolution"] = list(SPACING)
            array.attrs["offset"] = list(CORNER)
            self.check(name)

    def test_precomputed(self):
        os.makedirs("pre/full")
        voxels = self.labels.transpose(2, 1, 0).astype("<u8")
        size, chunk = voxels.shape, (8, 8, 8)
        offset = [4, -3, 10]
        resolution = [5.0, 2.0, 4.0]
        with open("pre/info", "w") as file:
            json.dump({"type": "segmentation", "data_type": "uint64", "num_channels": 1, "scales": [{
                "key": "full", "size": list(size), "resolution": resolution,
                "voxel_offset": offset, "chunk_sizes": [list(chunk)], "encoding": "raw"}]}, file)
        for index in numpy.ndindex(*[-(-n // c) for n, c in zip(size, chunk)]):
            lo = [i * c for i, c in zip(index, chunk)]
            hi = [min(l + c, n) for l, c, n in zip(lo, chunk, size)]
            name = "_".join(f"{l + o}-{h + o}" for l, h, o in zip(lo, hi, offset))
            part = voxels[tuple(slice(l, h) for l, h in zip(lo, hi))]
            with open("pre/full/" + name, "wb") as file:
                file.write(part.tobytes(order="F"))
        corner = ",".join(str(o * r) for o, r in zip(offset, resolution))
        run("mesh", "array.npy", "--spacing", "5,2,4", "--origin=" + corner, "-o", "nm.vtkhdf")
        run("mesh", "pre", "-o", "out.vtkhdf")
        self.assertEqual(run("digest", "out.vtkhdf"), run("digest", "nm.vtkhdf"))

    def test_tiff(self):
        tifffile = needs("tifffile")
        tifffile.imwrite("a.tif", self.labels, photometric="minisblack")
        self.check("a.tif", *PLACE)
        tifffile.imwrite("b.tif", self.labels.astype("u4"), photometric="minisblack",
                         bigtiff=True, tile=(16, 16), compression="zlib")
        self.check("b.tif", *PLACE)
        os.makedirs("slices")
        for z, page in enumerate(self.labels):
            tifffile.imwrite(f"slices/s{z}.tif", page)
        self.check("slices", *PLACE)

    def test_tiff_layouts(self):
        tifffile = needs("tifffile")
        for options in (
            {"byteorder": ">"},
            {"byteorder": ">", "bigtiff": True, "compression": "zlib", "predictor": True},
            {"compression": "lzma", "rowsperstrip": 5},
            {"tile": (32, 16), "compression": "zlib", "predictor": True},
        ):
            tifffile.imwrite("l.tif", self.labels, photometric="minisblack", **options)
            self.check("l.tif", *PLACE)
        tifffile.imwrite("f.tif", self.labels.astype("f4"), photometric="minisblack",
                         compression="zlib")
        self.check("f.tif", *PLACE)

    def test_tiff_sizes(self):
        """ImageJ's and OME's size of a voxel."""
        tifffile = needs("tifffile")
        origin = PLACE[2]
        for truncate in (False, True):
            tifffile.imwrite("j.tif", self.labels, imagej=True, resolution=tuple(1 / SPACING[:2]),
                             truncate=truncate,
                             metadata={"axes": "ZYX", "spacing": SPACING[2], "unit": "um"})
            self.check("j.tif", origin)
        sizes = {f"PhysicalSize{n}": s for n, s in zip("XYZ", SPACING)}
        tifffile.imwrite("o.ome.tif", self.labels, photometric="minisblack",
                         metadata={"axes": "ZYX", **sizes})
        self.check("o.ome.tif", origin)

    def test_pictures_by_vtk(self):
        vtk = needs("vtk")
        writer = vtk.vtkTIFFWriter()
        writer.SetInputData(self.vtk_points(self.labels))
        writer.SetFileName("v.tif")
        for packing in ("NoCompression", "PackBits", "Deflate"):
            getattr(writer, "SetCompressionTo" + packing)()
            writer.Write()
            self.check("v.tif", *PLACE)
        os.makedirs("pngs")
        writer = vtk.vtkPNGWriter()
        # Into pictures of one slice it writes the last row first.
        writer.SetInputData(self.vtk_points(self.labels[:, ::-1]))
        writer.SetFilePattern("pngs/s%d.png")
        writer.Write()
        self.assertEqual(len(os.listdir("pngs")), len(self.labels))
        self.check("pngs", *PLACE)

    def vtk_points(self, labels):
        """An image whose points are the centres of the voxels."""
        vtk = needs("vtk")
        from vtk.util import numpy_support
        image = vtk.vtkImageData()
        image.SetDimensions(*labels.shape[::-1])
        image.SetSpacing(*SPACING)
        image.SetOrigin(*CENTRE)
        array = numpy_support.numpy_to_vtk(numpy.ascontiguousarray(labels).ravel(), deep=True)
        array.SetName("label")
        image.GetPointData().SetScalars(array)
        return image

    def test_raw(self):
        self.labels.astype(">u4").tofile("a.raw")
        self.check("a.raw", "--shape", "26,18,21", "--dtype", "u32be", *PLACE)

    def test_part_of_a_volume(self):
        big = numpy.zeros((25, 24, 30), numpy.uint16)
        big[3:24, 2:20, 1:27] = self.labels
        numpy.save("big.npy", big)
        lo = CORNER - SPACING * [1, 2, 3]
        self.check("big.npy", "--crop", "1,2,3,27,20,24", *PLACE)
        nibabel = needs("nibabel")
        affine = numpy.diag([*SPACING, 1.0])
        affine[:3, 3] = lo + SPACING / 2
        nibabel.save(nibabel.Nifti1Image(big.transpose(2, 1, 0), affine), "big.nii")
        self.check("big.nii", "--crop", "1,2,3,27,20,24")


if __name__ == "__main__":
    unittest.main()
