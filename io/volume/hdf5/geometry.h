// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where the volume of an HDF5 data set lies, by the conventions of the tools that write them.
#pragma once

#include <string_view>

#include "io/volume/file_space.h"
#include "io/volume/hdf5/description.h"

namespace mw::io {

/// CREMI's `resolution` and `offset` (z, y, x; nm), Fiji's and ilastik's `element_size_um` (z, y,
/// x; um), the geometry of DREAM.3D (x, y, z); all place the first corner.  What is not three
/// numbers is not looked at; without any of them voxels have edges of 1. shape: (x, y, z). ERRORS:
/// mw::Error(kInput) when a geometry has another shape than the array.
[[nodiscard]] FileSpace hdf5_space(const Hdf5Description& description, const Index3& shape,
                                   std::string_view file);

}  // namespace mw::io
