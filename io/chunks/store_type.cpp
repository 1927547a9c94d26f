// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxel types from their names in stores.
#include "io/chunks/store_type.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace mw::io {

std::optional<VoxelType> parse_store_type(std::string_view text) {
  constexpr std::array<std::string_view, 10> kNames{"uint8",   "uint16", "uint32", "uint64",
                                                    "int8",    "int16",  "int32",  "int64",
                                                    "float32", "float64"};
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = std::find(kNames.begin(), kNames.end(), small);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<VoxelType>(found - kNames.begin());
}

}  // namespace mw::io
