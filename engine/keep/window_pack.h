// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The blocks that a window leaves, packed together as they are kept.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "io/codec/codec.h"

namespace mw::engine {

/// Packs kept blocks (kept_block.h) of one window.  Values of one kind stand together, in columns,
/// since Zstandard packs these by a fifth better than blocks as they are.
///
///     CRC-32 of everything that follows, 4 bytes
///     for each column: bytes var
///     frames of Zstandard, which together have the columns behind one another
///
/// A column has the values of one kind of all blocks in their order: see Column in window_pack.cpp.
/// REQUIRES: bytes of to_kept().  Cost: linear.  Memory: twice the blocks.
[[nodiscard]] std::vector<std::byte> pack_blocks(std::span<const std::vector<std::byte>> blocks,
                                                 io::ZstdPacker& packer);

/// Returns the kept bytes of one of the packed blocks.  Memory: that of all blocks.
/// ERRORS: BadBytes (byte_codes.h), mw::Error(kInput) when these bytes were not packed so.
[[nodiscard]] std::vector<std::byte> unpack_block(std::span<const std::byte> packed,
                                                  std::size_t index);

}  // namespace mw::engine
