// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which axes of an HDF5 array are x, y and z, and where the volume lies, by the conventions of the
// tools that write them.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "io/volume/file_space.h"
#include "io/volume/hdf5/description.h"

namespace mw::io {

/// For x, y and z the axis of the array; empty: the array has one slice there.
using Hdf5Axes = std::array<std::optional<std::size_t>, 3>;

/// By ilastik's axistags when there are some, else [z, y, x], or [y, x] as one slice.  Of arrays of
/// more axes those of one element are left out, the first ones first; in DREAM.3D, where the
/// components of a voxel are last, the last ones first.
/// ERRORS: mw::Error(kInput) naming `file` and the data set when three do not remain, and for tags
/// that do not fit the array.
[[nodiscard]] Hdf5Axes find_axes(const Hdf5Description& description, std::string_view file);

/// CREMI's `resolution` and `offset` (z, y, x; nm), Fiji's and ilastik's `element_size_um` (z, y,
/// x; um), the geometry of DREAM.3D (x, y, z); all place the first corner.  What is not three
/// numbers is not looked at; without any of them voxels have edges of 1. shape: (x, y, z). ERRORS:
/// mw::Error(kInput) when a geometry has another shape than the array.
[[nodiscard]] FileSpace hdf5_space(const Hdf5Description& description, const Index3& shape,
                                   std::string_view file);

}  // namespace mw::io
