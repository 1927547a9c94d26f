// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which axes of an HDF5 array are x, y and z.
#pragma once

#include <array>
#include <optional>
#include <string_view>

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

}  // namespace mw::io
