// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The text header of an INRIMAGE-4 file.
#pragma once

#include <string_view>

#include "io/file/byte_order.h"
#include "io/volume/file_space.h"

namespace mw::io {

/// Largest header looked for, bytes.
inline constexpr std::size_t kMaxInrHeaderBytes = 1 << 16;

struct InrHeader {
  VoxelType type = VoxelType::kU8;
  ByteOrder order = ByteOrder::kLittle;
  Index3 shape;
  std::size_t bytes = 0;  ///< a multiple of 256
  FileSpace space;
};

/// REQUIRES: head is the beginning of the file, kMaxInrHeaderBytes or as much as there is.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] InrHeader parse_inr_header(std::string_view head, std::string_view file);

}  // namespace mw::io
