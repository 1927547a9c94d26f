# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Two meshes side by side, seen by one camera, into a .png; without a screen."""

import PIL.Image
import vtkmodules.vtkRenderingFreeType  # these two only register themselves
import vtkmodules.vtkRenderingOpenGL2
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPlane
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkThreshold
from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry
from vtkmodules.vtkFiltersGeneral import vtkTransformFilter
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkCamera,
    vtkDataSetMapper,
    vtkLight,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)
from vtkmodules.util.numpy_support import vtk_to_numpy

WIDTH, HEIGHT = 1000, 500  # pixels
OVERSAMPLING = 3  # pixels drawn along each axis for one written
CAPTION = 0.12  # of the height
WHITE, INK, EDGE = (1, 1, 1), (0.1, 0.1, 0.1), (0.13, 0.15, 0.18)
EDGE_WIDTH = 0.6  # pixels


def surface(path, label):
    """Around one label of a mesh."""
    chosen = vtkThreshold()
    chosen.SetInputData(_read(path))
    chosen.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "label")
    chosen.SetThresholdFunction(vtkThreshold.THRESHOLD_BETWEEN)
    chosen.SetLowerThreshold(label)
    chosen.SetUpperThreshold(label)
    return _outside(chosen)


def behind(path, origin, normal):
    """Of a mesh what is not in front of a plane, tets whole."""
    plane = vtkPlane()
    plane.SetOrigin(*origin)
    plane.SetNormal(*normal)
    half = vtkExtractGeometry()
    half.SetInputData(_read(path))
    half.SetImplicitFunction(plane)
    half.ExtractBoundaryCellsOn()
    return _outside(half)


def whole(path):
    """A whole mesh, from outside."""
    return _outside_of(_read(path))


def tiled(path, edge):
    """Eight copies of a mesh side by side, as one mesh: common nodes are one, so that faces between
    copies are inside and not seen."""
    cells = vtkAppendFilter()
    cells.MergePointsOn()
    for copy in range(8):
        moved = vtkTransform()
        moved.Translate(*(edge * (copy >> axis & 1) for axis in range(3)))
        one = vtkTransformFilter()
        one.SetTransform(moved)
        one.SetInputData(_read(path))
        one.Update()
        cells.AddInputData(one.GetOutput())
    cells.Update()
    return _outside_of(cells.GetOutput())


def draw(path, halves, colours, view, one_camera=True):
    """`halves`: two pairs of surfaces and a caption.  `colours`: by label.  `view`: from where to
    look, z being up, and how much to zoom; each half by itself unless there is one camera."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(WIDTH * OVERSAMPLING, HEIGHT * OVERSAMPLING)
    camera = None
    for side, (surfaces, caption) in enumerate(halves):
        left = side / 2
        words = _renderer(window, (left, 1 - CAPTION, left + 0.5, 1))
        words.AddViewProp(_text(caption))
        renderer = _renderer(window, (left, 0, left + 0.5, 1 - CAPTION))
        for one in surfaces:
            renderer.AddActor(_actor(one, colours))
        _light(renderer)
        if camera is None or not one_camera:
            camera = _camera(renderer, *view)
        renderer.SetActiveCamera(camera)
        renderer.ResetCameraClippingRange()
    window.Render()
    _write(window, path)


def _read(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def _outside_of(grid):
    triangles = vtkGeometryFilter()
    triangles.SetInputData(grid)
    triangles.Update()
    return triangles.GetOutput()


def _outside(cells):
    triangles = vtkGeometryFilter()
    triangles.SetInputConnection(cells.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()


def _renderer(window, viewport):
    renderer = vtkRenderer()
    renderer.SetViewport(*viewport)
    renderer.SetBackground(*WHITE)
    window.AddRenderer(renderer)
    return renderer


def _actor(triangles, colours):
    table = vtkLookupTable()
    table.SetNumberOfTableValues(max(colours) + 1)
    table.SetRange(0, max(colours))
    for label, colour in colours.items():
        red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (0, 2, 4))
        table.SetTableValue(label, red, green, blue, 1)
    mapper = vtkDataSetMapper()
    mapper.SetInputData(triangles)
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("label")
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.ForceOpaqueOn()
    look = actor.GetProperty()
    look.SetInterpolationToFlat()
    look.SetEdgeVisibility(True)
    look.SetEdgeColor(*EDGE)
    look.SetLineWidth(EDGE_WIDTH * OVERSAMPLING)
    look.SetAmbient(0.25)
    look.SetDiffuse(0.85)
    return actor


def _light(renderer):
    """From above, at the left, so that facets differ; a weak one from where we look."""
    renderer.RemoveAllLights()
    renderer.AutomaticLightCreationOff()
    for position, strength in (((-1, 1, 0.9), 0.8), ((0, 0, 1), 0.4)):
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*position)
        light.SetFocalPoint(0, 0, 0)
        light.SetIntensity(strength)
        renderer.AddLight(light)


def _camera(renderer, direction, zoom):
    camera = vtkCamera()
    camera.SetPosition(*direction)
    camera.SetFocalPoint(0, 0, 0)
    camera.SetViewUp(0, 0, 1)
    renderer.SetActiveCamera(camera)
    renderer.ResetCamera()
    camera.ParallelProjectionOn()
    camera.Zoom(zoom)
    return camera


def _text(caption):
    text = vtkTextActor()
    text.SetInput(caption)
    text.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    text.SetPosition(0.5, 0.45)
    look = text.GetTextProperty()
    look.SetFontFamilyToArial()
    look.SetFontSize(15 * OVERSAMPLING)
    look.SetColor(*INK)
    look.SetJustificationToCentered()
    look.SetVerticalJustificationToCentered()
    look.SetLineSpacing(1.15)
    return text


def _write(window, path):
    """With a palette: a third of the bytes."""
    grabbed = vtkWindowToImageFilter()
    grabbed.SetInput(window)
    grabbed.ReadFrontBufferOff()
    grabbed.Update()
    pixels = vtk_to_numpy(grabbed.GetOutput().GetPointData().GetScalars())
    rows = pixels.reshape(HEIGHT * OVERSAMPLING, WIDTH * OVERSAMPLING, 3)[::-1]
    image = PIL.Image.fromarray(rows).reduce(OVERSAMPLING)
    image.quantize(256, kmeans=2, dither=PIL.Image.Dither.NONE).save(path, optimize=True)
