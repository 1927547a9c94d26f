// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks LZ4 in the two framings that volumes come in, by liblz4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "io/codec/damage.h"

namespace mw::io {

/// numcodecs' framing (Zarr): the unpacked size in 4 bytes, least significant first, and one block.
/// name: what errors call the bytes.  Memory: at most `most` bytes.  Thread safety: any.
/// ERRORS: mw::Error(kInput) for damage, truncation and more than `most` bytes.
[[nodiscard]] std::vector<std::byte> unpack_lz4(std::span<const std::byte> packed, std::size_t max,
                                                std::string_view name);

/// The framing of lz4-java's LZ4BlockOutputStream (N5): blocks with magic, sizes and a checksum.
[[nodiscard]] std::vector<std::byte> unpack_lz4_java(std::span<const std::byte> packed,
                                                     std::size_t max, std::string_view name);

/// Appends the `size` bytes of one bare block to out.  Nothing is allocated before the claim is
/// possible.  ERRORS: as above.
void append_lz4_block(std::vector<std::byte>& out, std::span<const std::byte> block,
                      std::size_t size, const PackedName& name);

}  // namespace mw::io
