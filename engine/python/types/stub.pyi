# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# The types of the package's functions and classes, from which stub.py makes mwmesh/__init__.pyi: it
# puts arguments in the place of a line `# options: USE`.
import os
from collections.abc import Callable, Iterable, Mapping, Sequence, Set
from typing import Any, Literal, NamedTuple, Protocol, TypeAlias, overload

import numpy as np
import numpy.typing as npt

__version__: str
__all__ = [
    "CancelledError", "CheckFailedError", "Error", "InputError", "InternalError", "Materials",
    "Mesh", "MissingPackageError", "Picture", "ResourceError", "Surface", "UsageError", "Verdict", "as_volume", "homogenise", "mesh",
    "mesh_to_file", "Session", "read", "settings", "synth",
]

_Path: TypeAlias = str | os.PathLike[str]
_Three: TypeAlias = Sequence[float] | npt.NDArray[Any]
_Box: TypeAlias = tuple[Sequence[int], Sequence[int]]
_Specks: TypeAlias = int | tuple[int, int]
_Progress: TypeAlias = bool | Callable[[int, int, float | None], object]
_Axes: TypeAlias = Literal["zyx", "xyz"]
#: A label by its number or by its name.
_Label: TypeAlias = int | str
_Pairs: TypeAlias = Literal["*"] | Sequence[tuple[_Label, _Label]] | Set[tuple[_Label, _Label]]
_Names: TypeAlias = Mapping[int, str] | Sequence[str | None] | _Path
#: None stands for "none"; a dictionary has sizes by label.
_Setting: TypeAlias = str | float | bool | Mapping[Any, float] | None

class _RegionArray(Protocol):
    """An array that is read box by box: h5py, Zarr, dask."""

    @property
    def shape(self) -> tuple[int, ...]: ...
    @property
    def dtype(self) -> Any: ...
    def __getitem__(self, key: Any, /) -> Any: ...

class _Image(Protocol):
    """A nibabel image."""

    @property
    def dataobj(self) -> Any: ...
    @property
    def affine(self) -> Any: ...
    @property
    def header(self) -> Any: ...

class _Volume:
    """A volume that as_volume() made."""

    @property
    def shape(self) -> list[int]: ...
    @property
    def labels_are_signed(self) -> bool: ...

_Source: TypeAlias = _Path | _RegionArray | _Image | _Volume | npt.NDArray[Any]

class Error(Exception):
    option: str

class InternalError(Error): ...
class UsageError(Error, ValueError): ...
class InputError(Error, ValueError): ...
class ResourceError(Error): ...
class CheckFailedError(Error): ...
class CancelledError(Error): ...
class MissingPackageError(Error, ImportError): ...

class Surface(NamedTuple):
    points: npt.NDArray[np.float64]
    triangles: npt.NDArray[np.int64]

class Materials(NamedTuple):
    numbers: npt.NDArray[np.int32]
    begins: npt.NDArray[np.float64]
    ends: npt.NDArray[np.float64]
    means: npt.NDArray[np.float64]
    tets: npt.NDArray[np.int64]
    volumes: npt.NDArray[np.float64]

class Verdict:
    passed: bool
    checks: list[tuple[str, bool, str]]
    report: dict[str, Any]
    def __init__(self, text: str) -> None: ...
    def __bool__(self) -> bool: ...

class Mesh:
    report: dict[str, Any] | None
    def __init__(
        self,
        points: npt.ArrayLike,
        tets: npt.ArrayLike,
        labels: npt.ArrayLike,
        names: _Names | None = None,
    ) -> None: ...
    @property
    def points(self) -> npt.NDArray[np.float64]: ...
    @property
    def tets(self) -> npt.NDArray[np.int64]: ...
    @property
    def values(self) -> dict[str, npt.NDArray[np.float64]]: ...
    @property
    def labels(self) -> npt.NDArray[np.int64] | npt.NDArray[np.uint64]: ...
    @property
    def wedges(self) -> npt.NDArray[np.int64]: ...
    @property
    def wedge_labels(self) -> npt.NDArray[np.int64] | npt.NDArray[np.uint64]: ...
    @property
    def names(self) -> dict[int, str]: ...
    @property
    def masks(self) -> dict[str, list[int]]: ...
    @property
    def digest(self) -> str: ...
    def label_list(self) -> npt.NDArray[np.int64] | npt.NDArray[np.uint64]: ...
    def materials(
        self, name: str, count: int, bounds: tuple[float, float] | None = None
    ) -> Materials: ...
    def tet_volumes(self) -> npt.NDArray[np.float64]: ...
    def volumes(self) -> dict[int, float]: ...
    def facets(self, a: _Label, b: _Label) -> npt.NDArray[np.int64]: ...
    def surface(self, label: _Label, closed: bool = True) -> Surface: ...
    def contacts(self) -> dict[tuple[int, int], float]: ...
    def save(
        self,
        path: _Path,
        *,
        values: bool = True,
        # options: write
    ) -> None: ...
    def verify(
        self,
        volume: _Source,
        *,
        # options: verify
        **place: Any,
    ) -> Verdict: ...
    def plot(self, labels: _Label | Iterable[_Label] | None = None, **arguments: Any) -> Any: ...
    def picture(self, width: int = 1200, height: int = 900) -> Picture: ...
    def to_meshio(self) -> Any: ...
    def to_vtk(self) -> Any: ...
    def to_pyvista(self) -> Any: ...

def as_volume(
    source: _Source,
    *,
    spacing: float | _Three | None = None,
    origin: float | _Three | None = None,
    affine: npt.ArrayLike | None = None,
    frame: str | None = None,
    unit: str | None = None,
    axes: _Axes | None = None,
    names: _Names | None = None,
    # options: open
) -> _Volume: ...
def mesh(
    volume: _Source,
    *,
    progress: _Progress | None = None,
    spacing: float | _Three | None = ...,
    origin: float | _Three | None = ...,
    affine: npt.ArrayLike | None = ...,
    frame: str | None = ...,
    unit: str | None = ...,
    axes: _Axes | None = ...,
    names: _Names | None = ...,
    # options: open
    # options: mesh
    **settings: _Setting,
) -> Mesh: ...
class Picture(bytes): ...

class Session:
    def __init__(self, array: _Source, *, keep: _Path | None = ...,
                 from_kept: bool = ..., **settings: Any) -> None: ...
    @property
    def array(self) -> npt.NDArray[Any]: ...
    @property
    def mesh(self) -> Mesh: ...
    @overload
    def update(self, array: npt.NDArray[Any], /) -> tuple[Mesh, dict[str, Any]]: ...
    @overload
    def update(self, box: _Box, values: int | npt.NDArray[Any], /) -> tuple[
        Mesh, dict[str, Any]]: ...

def mesh_to_file(
    volume: _Source,
    path: _Path,
    *,
    # options: write
    progress: _Progress | None = None,
    **arguments: Any,
) -> dict[str, Any] | None: ...
def read(path: _Path) -> Mesh: ...
def homogenise(job: _Path) -> npt.NDArray[np.float64]: ...
def synth(
    kind: Literal["voronoi", "tubes", "spheres", "noise", "checkerboard"],
    shape: Sequence[int],
    labels: int = 2,
    seed: int = 0,
) -> npt.NDArray[np.uint64]: ...
def settings() -> dict[str, tuple[str, str, list[str]]]: ...
