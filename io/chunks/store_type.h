// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxel types as N5 and Neuroglancer name them.
#pragma once

#include <optional>
#include <string_view>

#include "io/volume/label_volume.h"

namespace mw::io {

/// "uint8" .. "uint64", "int8" .. "int64", "float32", "float64", in small or capital letters.
[[nodiscard]] std::optional<VoxelType> parse_store_type(std::string_view text);

}  // namespace mw::io
