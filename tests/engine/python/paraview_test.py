# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The filter of mwmesh.paraview_plugin, in a VTK program, and as ParaView's plugin where this is run by
pvpython (tests/paraview.sh).  VTK's own geometry of the image is the oracle."""

import inspect
import pathlib
import sys
import tempfile
import unittest

try:
    import numpy as np
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import VTK_STRING
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
try:
    from paraview import servermanager, simple
except ImportError:
    servermanager = simple = None

import mwmesh
from mwmesh import paraview_plugin

GRAINS = mwmesh.synth("voronoi", (20, 16, 12), labels=5, seed=1)
#: A turn about an axis that is none of the image's, and one with a mirror.
TURN = np.array([[2, -1, 2], [2, 2, -1], [-1, 2, 2]]) / 3
MIRROR = TURN @ np.diag([1, 1, -1])


def image_of(labels, are_cells, spacing=(1, 1, 1), origin=(0, 0, 0), direction=None, first=(0, 0, 0)):
    """Returns an image with labels [z, y, x] as its active scalars."""
    image = vtkImageData()
    last = np.add(first, labels.shape[::-1]) - (not are_cells)
    image.SetExtent(np.column_stack([first, last]).ravel().tolist())
    image.SetSpacing(spacing)
    image.SetOrigin(origin)
    if direction is not None:
        image.SetDirectionMatrix(direction.ravel().tolist())
    add(image, are_cells, "labels", labels)
    image.GetAttributes(int(are_cells)).SetActiveScalars("labels")
    return image


def add(image, are_cells, name, values):
    array = numpy_to_vtk(values.reshape(-1, *values.shape[3:]), deep=True)
    array.SetName(name)
    image.GetAttributes(int(are_cells)).AddArray(array)


def written(image, folder):
    """Returns the name of a file of the image in the folder."""
    writer = vtkXMLImageDataWriter()
    writer.SetFileName(f"{folder}/grains.vti")
    writer.SetDataModeToAscii()  # ParaView 5.11 and the expat of Debian 12 misread large appended data.
    writer.SetInputData(image)
    writer.Write()
    return writer.GetFileName()


def column(grid, name):
    return vtk_to_numpy(grid.GetCellData().GetArray(name))


def points_of(grid):
    return vtk_to_numpy(grid.GetPoints().GetData())


def tets_of(grid):
    return vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)


def volumes(grid):
    quality = vtkMeshQuality()
    quality.SetInputData(grid)
    quality.SetTetQualityMeasureToVolume()
    quality.Update()
    return vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality"))


def indices(image, points):
    """Returns the places of points as VTK counts them in the image's points."""
    out = np.empty((len(points), 3))
    for point, index in zip(points.tolist(), out):
        image.TransformPhysicalPointToContinuousIndex(point, index)
    return out


class Run:
    """A filter on an image, and what it tells."""

    def __init__(self, image, **properties):
        self.errors, self.progress = [], []
        self.filter = paraview_plugin.MeshLabels()
        self.filter.SetInputDataObject(image)

        def keep(_filter, _event, text):
            self.errors.append(text)
        keep.CallDataType = VTK_STRING
        self.filter.AddObserver("ErrorEvent", keep)
        self.filter.AddObserver("ProgressEvent",
                                lambda made, _: self.progress.append(made.GetProgress()))
        self.set(**properties)

    def set(self, **properties):
        for name, value in properties.items():
            getattr(self.filter, f"Set{name}")(value)

    def grid(self):
        self.filter.Update()
        return self.filter.GetOutputDataObject(0)


class Filter(unittest.TestCase):

    def assert_equals(self, grid, mesh):
        self.assertTrue(np.array_equal(points_of(grid), mesh.points))
        self.assertTrue(np.array_equal(tets_of(grid), mesh.tets))
        self.assertTrue(np.array_equal(column(grid, "label"), mesh.labels))

    def test_plain_images(self):
        for are_cells, origin in ((True, 0), (False, -0.5)):
            run = Run(image_of(GRAINS, are_cells))
            self.assert_equals(run.grid(), mwmesh.mesh(GRAINS, origin=origin))
            self.assertEqual(run.errors, [])

    def test_place(self):
        for are_cells in (True, False):
            for direction in (None, TURN, MIRROR):
                with self.subTest(are_cells=are_cells, direction=direction):
                    self.check_place(image_of(GRAINS, are_cells, (1, 1.5, 2), (50, -6, 7),
                                              direction, first=(3, -4, 5)), are_cells)

    def check_place(self, image, are_cells):
        grid = Run(image).grid()
        inner = 0 if are_cells else 0.5
        extent = np.reshape(image.GetExtent(), (3, 2))
        places = indices(image, points_of(grid))
        self.assertLess(np.abs(places.min(axis=0) - (extent[:, 0] - inner)).max(), 1e-9)
        self.assertLess(np.abs(places.max(axis=0) - (extent[:, 1] + inner)).max(), 1e-9)
        middles = indices(image, points_of(grid)[tets_of(grid)].mean(axis=1))
        x, y, z = np.floor(middles - extent[:, 0] + inner).astype(int).T
        sizes, labels = volumes(grid), column(grid, "label")
        self.assertGreater(sizes.min(), 0)
        self.assertAlmostEqual(sizes.sum(), GRAINS.size * 3)
        right = sizes[GRAINS[z, y, x] == labels].sum() / sizes.sum()
        self.assertGreater(right, 0.9)

    def test_chosen_array(self):
        image = image_of(GRAINS, False)
        other = np.where(GRAINS == GRAINS[0, 0, 0], 7, 9)
        add(image, False, "other", other)
        run = Run(image)
        run.filter.SetInputArrayToProcess(0, 0, 0, 0, "other")
        self.assert_equals(run.grid(), mwmesh.mesh(other, origin=-0.5))
        run.filter.SetInputArrayToProcess(0, 0, 0, 1, "other")
        self.assertEqual(run.grid().GetNumberOfCells(), 0)
        self.assertRegex(run.errors.pop(), "image: has no array other")

    def test_properties(self):
        a, b = np.unique(GRAINS)[:2].tolist()
        with tempfile.TemporaryDirectory() as folder:
            names = pathlib.Path(folder, "names.csv")
            names.write_text(f"{a},Liver\n{b},Left lung\n")
            image = image_of(GRAINS, True)
            values = np.arange(GRAINS.size, dtype=float).reshape(GRAINS.shape)
            add(image, True, "hu", values)
            np.save(f"{folder}/hu.npy", values)
            run = Run(image, Names=str(names), Labels=f"{b}, Liver", MaxDistance=1, Size=4.5,
                      Preset="fine", Sample="hu", Settings="surface=voxel gradation=1", Threads=1,
                      Memory="2GiB")
            mesh = mwmesh.mesh(GRAINS, labels=[a, b], max_distance=1, size=4.5, preset="fine",
                               sample={"hu": f"{folder}/hu.npy"}, surface="voxel", gradation=1)
            grid = run.grid()
            self.assertEqual(run.errors, [])
            self.assert_equals(grid, mesh)
            self.assertTrue(np.array_equal(column(grid, "hu"), mesh.values["hu"]))
            texts, ids = (grid.GetFieldData().GetAbstractArray(f"label_{k}") for k in ("name", "id"))
            self.assertEqual({ids.GetValue(i): texts.GetValue(i) for i in range(2)},
                             {a: "Liver", b: "Left lung"})
            run.set(Labels="", Background="Left lung")
            self.assertEqual(set(column(run.grid(), "label")), set(GRAINS.ravel()) - {b})

    def test_errors_are_told_and_mended(self):
        run = Run(image_of(GRAINS, True), Size=-3)
        for change, error in (({}, "size: .*'-3'"), ({"Size": 0, "Labels": "x"}, "labels: .*'x'"),
                              ({"Labels": "", "Settings": "colour=red"}, "colour: no such"),
                              ({"Settings": "", "Sample": "hu"}, "image: has no array hu"),
                              ({"Sample": "", "Memory": "much"}, "memory: .*'much'")):
            run.set(**change)
            self.assertEqual(run.grid().GetNumberOfCells(), 0)
            text, = run.errors
            self.assertRegex(text, f"^ERROR: Mesh Labels: {error}")
            run.errors.clear()
        run.set(Memory="")
        self.assert_equals(run.grid(), mwmesh.mesh(GRAINS))
        flat = Run(image_of(GRAINS[:0], True))
        self.assertEqual(flat.grid().GetNumberOfCells(), 0)
        self.assertRegex(flat.errors.pop(), "image: is flat")
        colours = image_of(GRAINS, True)
        add(colours, True, "many", np.zeros((*GRAINS.shape, 3)))
        many = Run(colours)
        many.filter.SetInputArrayToProcess(0, 0, 0, 1, "many")
        self.assertEqual(many.grid().GetNumberOfCells(), 0)
        self.assertRegex(many.errors.pop(), "array many: expected one number")

    def test_progress_and_abort(self):
        big = mwmesh.synth("voronoi", (40, 40, 40), labels=9, seed=1)
        run = Run(image_of(big, True), Settings="window=8")
        self.assertGreater(run.grid().GetNumberOfCells(), 0)
        self.assertEqual(run.progress, sorted(run.progress))
        self.assertTrue(any(0 < share < 1 for share in run.progress), run.progress)
        self.assertEqual(run.progress[-1], 1)
        run.filter.AddObserver("ProgressEvent", lambda made, _: made.SetAbortExecute(1))
        run.filter.Modified()
        self.assertEqual(run.grid().GetNumberOfCells(), 0)
        self.assertRegex(run.errors.pop(), "was aborted")

    def test_pieces(self):
        run = Run(None)
        with tempfile.TemporaryDirectory() as folder:
            reader = vtkXMLImageDataReader()
            reader.SetFileName(written(image_of(GRAINS, True), folder))
            run.filter.SetInputConnection(reader.GetOutputPort())
            self.check_pieces(run)

    def check_pieces(self, run):
        run.filter.UpdatePiece(1, 2, 0)
        self.assertEqual(run.filter.GetOutputDataObject(0).GetNumberOfCells(), 0)
        run.filter.UpdatePiece(0, 2, 0)
        self.assert_equals(run.filter.GetOutputDataObject(0), mwmesh.mesh(GRAINS))
        self.assertEqual(run.errors, [])


@unittest.skipUnless(simple, "no ParaView")
class Plugin(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        if not hasattr(inspect, "getargspec"):  # What loads plugins in ParaView 5.11 asks for it.
            inspect.getargspec = inspect.getfullargspec
        simple.LoadPlugin(paraview_plugin.__file__, remote=False, ns=vars(simple))
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        image = image_of(GRAINS, True, (1, 1.5, 2), (50, -6, 7))
        add(image, True, "other", np.where(GRAINS == GRAINS[0, 0, 0], 7, 9))
        cls.reader = simple.XMLImageDataReader(FileName=[written(image, cls.folder.name)])

    def test_filter(self):
        made = simple.MeshLabels(Input=self.reader, Array=["CELLS", "labels"])
        self.assertEqual((made.Preset, made.Size, made.MaxDistance, made.Threads, made.Background),
                         ("default", 0, 0, 0, ""))
        self.assertEqual(made.GetProperty("Preset").Available, ["draft", "default", "fine"])
        for properties, settings in (({}, {}), ({"Preset": "fine", "Size": 4.5, "Labels": "1,2"},
                                                {"preset": "fine", "size": 4.5, "labels": [1, 2]})):
            for name, value in properties.items():
                setattr(made, name, value)
            grid = servermanager.Fetch(made)
            mesh = mwmesh.mesh(GRAINS, spacing=(1, 1.5, 2), origin=(50, -6, 7), **settings)
            self.assertTrue(np.array_equal(points_of(grid), mesh.points))
            self.assertTrue(np.array_equal(column(grid, "label"), mesh.labels))
        other = simple.MeshLabels(Input=self.reader, Array=["CELLS", "other"])
        self.assertEqual(set(column(servermanager.Fetch(other), "label")), {7, 9})

    def test_picture(self):
        cut = simple.Clip(Input=simple.MeshLabels(Input=self.reader, Array=["CELLS", "labels"]),
                          ClipType="Plane")
        cut.ClipType.Origin, cut.ClipType.Normal = [60, 6, 19], [0, 0, 1]
        view = simple.CreateRenderView(ViewSize=[800, 600], OrientationAxesVisibility=0)
        self.addCleanup(simple.Delete, view)
        shown = simple.Show(cut, view, Representation="Surface", Ambient=1, Diffuse=0)
        simple.ColorBy(shown, ("CELLS", "label"))
        view.CameraPosition, view.CameraFocalPoint = [150, 100, 150], [60, 6, 19]
        simple.ResetCamera(view)
        picture = sys.argv[1] if len(sys.argv) > 1 else f"{self.folder.name}/picture.png"
        simple.SaveScreenshot(picture, view)
        reader = simple.PNGSeriesReader(FileNames=[picture])
        pixels = vtk_to_numpy(servermanager.Fetch(reader).GetPointData().GetScalars())
        colours, counts = np.unique(pixels[:, :3], axis=0, return_counts=True)
        seen = np.unique(GRAINS[:6])  # What is on this side of the plane, and the background.
        self.assertEqual((counts > 1000).sum(), len(seen) + 1, colours[counts > 1000])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
