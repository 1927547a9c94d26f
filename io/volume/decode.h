// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxels of any integer type and byte order from bytes and to bytes.
#pragma once

#include <cstddef>
#include <span>

#include "io/file/byte_order.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// Decodes `count` voxels that lie one after the other at `bytes` to out[0], out[stride], ...;
/// signed types are sign-extended.
void decode_voxels(const std::byte* bytes, std::size_t count, VoxelType type, ByteOrder order,
                   RawLabel* out, std::size_t stride);

/// Encodes labels, least significant byte first.  REQUIRES: out.size() == size of the voxels.
/// ENSURES: returns the index of the first label that the type cannot hold (nothing is written
/// from there on), or labels.size().
[[nodiscard]] std::size_t encode_voxels(std::span<const RawLabel> labels, VoxelType type,
                                        std::span<std::byte> out);

}  // namespace mw::io
