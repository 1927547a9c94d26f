// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The label of voxels whose chunk is not there.
#pragma once

#include <optional>
#include <string_view>

#include "io/json/json.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// From `fill_value` of either version: null is 0; true and false are 1 and 0; numbers are exact up
/// to 64 bits; floats may be "NaN", "Infinity", "-Infinity" or the hexadecimal of their bits.
/// ENSURES: empty for a float that is no whole number: an error only when such a voxel is read.
/// ERRORS: mw::Error(kInput) naming file and field for what the type cannot hold.
[[nodiscard]] std::optional<RawLabel> parse_fill_value(const Json& value, VoxelType type,
                                                       std::string_view file);

}  // namespace mw::io
