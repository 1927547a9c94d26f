// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// From the packed bytes of a Zarr chunk to its voxels.
#pragma once

#include <string_view>

#include "io/chunks/chunk.h"
#include "io/volume/zarr/axis_map.h"
#include "io/volume/zarr/zarr_array.h"

namespace mw::io {

/// Unpacks a chunk.  name: what errors call it.
/// ENSURES: the bytes are as many as the chunk's voxels need.
/// ERRORS: mw::Error(kInput) naming `name` when it is damaged.
[[nodiscard]] Chunk unpack_chunk(const ZarrArray& array, const AxisMap& axes,
                                 std::vector<std::byte> packed, std::string_view name);

/// The bytes in front of the CRC-32C that ends them.
/// ERRORS: mw::Error(kInput) naming `name` when it is another.
void strip_crc32c(std::vector<std::byte>& bytes, std::string_view name);

/// The most that a packed chunk may have.
[[nodiscard]] std::uint64_t max_packed(const ZarrArray& array);
/// The most that reading and unpacking a chunk takes beside its voxels that are in the volume: axes
/// of one entry may have chunks of more.
[[nodiscard]] std::uint64_t unpack_scratch(const ZarrArray& array, const AxisMap& axes);

}  // namespace mw::io
