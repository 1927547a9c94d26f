// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a caller may say about a volume beyond its file.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "io/file/byte_order.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// A raw file has no header: shape (x, y, z), type and byte order come from the caller.
struct RawLayout {
  Index3 shape;
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
};

struct OpenOptions {
  std::optional<RawLayout> raw;                  ///< read as raw, whatever the content
  std::optional<std::array<double, 3>> spacing;  ///< instead of the file's, which is not looked at
  std::optional<std::array<double, 3>> origin;   ///< instead of the file's, which is not looked at
};

}  // namespace mw::io
