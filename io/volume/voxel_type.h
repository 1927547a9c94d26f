// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxel types from names and sizes.
#pragma once

#include <optional>
#include <string_view>

#include "io/volume/label_volume.h"

namespace mw::io {

/// "u8" .. "i64", "f32", "f64" as name() gives them.
[[nodiscard]] std::optional<VoxelType> parse_voxel_type(std::string_view text);

/// REQUIRES: bytes is 1, 2, 4 or 8.
[[nodiscard]] VoxelType integer_type(int bytes, bool is_signed);

/// REQUIRES: bytes is 4 or 8.
[[nodiscard]] VoxelType float_type(int bytes);

}  // namespace mw::io
