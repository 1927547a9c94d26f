# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The filter "Mesh Labels": an image of labels (vtkImageData) to tets (vtkUnstructuredGrid).  ParaView
loads this file as a plugin; any other VTK program imports it and uses the class."""

import functools
import pathlib
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkOutputWindow
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkUnstructuredGrid
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

try:
    import mwmesh
except ImportError:  # ParaView's Python does not know the folder that this file was loaded from.
    sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
    import mwmesh

#: Arguments of mwmesh.mesh() with type, default and help; max_distance is the property MaxDistance.
#: 0 and "" are not handed on.
ARGUMENTS = {
    "preset": ("String", "default", "draft, default or fine"),
    "size": ("Double", 0, "edges of about this length; 0: any"),
    "max_distance": ("Double", 0, "voxels at most from interfaces of input to mesh; 0: the preset's"),
    "background": ("String", "", "the label that is left out, by number or name, or none; empty: 0 where names say so"),
    "labels": ("String", "", "the labels that are meshed, as in 1, 2, Liver; empty: all"),
    "names": ("String", "", "a file of the names of labels, as 'mwmesh mesh --names' takes it"),
    "sample": ("String", "", "arrays whose means the tets get as values, as in CT, PET"),
    "settings": ("String", "", "others by name, as in surface=voxel size=2=3,*=5"),
    "threads": ("Int", 0, "0: all cores"),
    "memory": ("String", "", "as in 8GiB, beside image and mesh; empty: half of what is free"),
}


def voxels(image, name="", kinds=(0, 1)):
    """Returns an array of the image as [x, y, z], uncopied; the affine of the voxels' centres; and
    whose array it is, of points (0) or cells (1).  Without a name it is that of the active scalars."""
    for kind in kinds:
        data = image.GetAttributes(kind)
        array = data.GetArray(name) if name else data.GetScalars()
        if array is not None:
            break
    else:
        raise mwmesh.UsageError(f"image: has no array {name or 'of scalars'}")
    extent = np.reshape(image.GetExtent(), (3, 2))
    counts = extent[:, 1] - extent[:, 0] + 1 - kind
    if not counts.all():
        raise mwmesh.UsageError("image: is flat, and has cells in no volume; take its points")
    if array.GetNumberOfComponents() != 1:
        raise mwmesh.UsageError(f"array {array.GetName()}: expected one number for each voxel")
    matrix = image.GetIndexToPhysicalMatrix()
    affine = np.array([[matrix.GetElement(i, k) for k in range(4)] for i in range(4)])
    affine[:3, 3] += affine[:3, :3] @ (extent[:, 0] + kind / 2)
    return vtk_to_numpy(array).reshape(counts, order="F"), affine, kind


class MeshLabels(VTKPythonAlgorithmBase):
    """Labels are the active scalars, of points before those of cells, unless an array is chosen."""

    def __init__(self):
        super().__init__(nInputPorts=1, inputType="vtkImageData",
                         nOutputPorts=1, outputType="vtkUnstructuredGrid")
        self._array = ("", (0, 1))
        self._values = {}

    def SetInputArrayToProcess(self, _index, _port, _connection, association, name):
        """Takes labels from an array of points (association 0) or of cells (1)."""
        self._array = (name, (association,))
        self.Modified()

    def _set(self, name, value):
        if self._values.get(name) != value:
            self._values[name] = value
            self.Modified()

    def RequestUpdateExtent(self, _request, inputs, _outputs):
        """Asks for the whole image also where processes share the work; the first meshes it."""
        image = inputs[0].GetInformationObject(0)
        image.Set(Pipeline.UPDATE_PIECE_NUMBER(), 0)
        image.Set(Pipeline.UPDATE_NUMBER_OF_PIECES(), 1)
        return 1

    def RequestData(self, _request, inputs, outputs):
        if outputs.GetInformationObject(0).Get(Pipeline.UPDATE_PIECE_NUMBER()):
            return 1
        try:
            mesh = self._mesh(vtkImageData.GetData(inputs[0]))
            vtkUnstructuredGrid.GetData(outputs).ShallowCopy(mesh.to_vtk())
        except (mwmesh.Error, OSError) as error:
            self._tell(f"ERROR: Mesh Labels: {error}\n")
        return 1  # After 0 each request, such as one to draw, would try again.

    def _tell(self, error):
        """Reports an error as VTK's own filters do."""
        if self.HasObserver("ErrorEvent"):
            self.InvokeEvent("ErrorEvent", error)
        else:
            vtkOutputWindow.GetInstance().DisplayErrorText(error)

    def _mesh(self, image):
        given = {name: value for name, value in self._values.items() if value}
        given |= dict(part.partition("=")[::2] for part in given.pop("settings", "").split())
        for name in given.keys() & {"labels", "sample"}:
            given[name] = [part.strip() for part in given[name].split(",")]
        labels, affine, kind = voxels(image, *self._array)
        with tempfile.TemporaryDirectory() as folder:
            files = {name: f"{folder}/{i}.npy" for i, name in enumerate(given.pop("sample", ()))}
            for name, file in files.items():
                np.save(file, voxels(image, name, (kind,))[0].T)
            return mwmesh.mesh(labels, affine=affine, sample=files, progress=self._progress, **given)

    def _progress(self, done, total, _seconds_left):
        self.UpdateProgress(done / total)
        if self.GetAbortExecute():
            raise mwmesh.CancelledError("was aborted")


def _property(argument):
    return argument.title().replace("_", "")


for _name in ARGUMENTS:
    setattr(MeshLabels, f"Set{_property(_name)}", functools.partialmethod(MeshLabels._set, _name))


def _xml():
    """Returns the properties for ParaView's panels."""
    presets = "".join(f'<String value="{name}"/>' for name in mwmesh.settings()["preset"][2])
    domains = {"preset": f'<StringListDomain name="list">{presets}</StringListDomain>',
               "names": '<FileListDomain name="files"/>'}
    return """
      <InputProperty name="Input" command="SetInputConnection">
        <DataTypeDomain name="type"><DataType value="vtkImageData"/></DataTypeDomain>
        <InputArrayDomain name="any_array" number_of_components="1"/>
      </InputProperty>
      <StringVectorProperty name="Array" command="SetInputArrayToProcess" number_of_elements="5"
          element_types="0 0 0 0 2" default_values="0">
        <ArrayListDomain name="arrays" attribute_type="Scalars">
          <RequiredProperties><Property name="Input" function="Input"/></RequiredProperties>
        </ArrayListDomain>
        <Documentation>the labels, of points or of cells</Documentation>
      </StringVectorProperty>""" + "".join(f"""
      <{kind}VectorProperty name="{_property(name)}" command="Set{_property(name)}"
          number_of_elements="1" default_values="{default}">
        {domains.get(name, "")}<Documentation>{text}</Documentation>
      </{kind}VectorProperty>""" for name, (kind, default, text) in ARGUMENTS.items())


try:
    from paraview.util.vtkAlgorithm import smproperty, smproxy
except ImportError:
    pass  # Another VTK program has the class as it is.
else:
    smproperty.xml(_xml())(MeshLabels)
    smproxy.filter(label="Mesh Labels")(MeshLabels)
