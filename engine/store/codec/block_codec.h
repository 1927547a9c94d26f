// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Blocks as bytes: what the store keeps in memory and on disk.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernels/core/index.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {

/// Names a block of a march.  Blocks are ordered by march, then z, y, x.
struct BlockKey {
  std::uint32_t march = 0;
  Index3 block;

  friend bool operator==(const BlockKey&, const BlockKey&) = default;
};

/// Returns the block's bytes.  All numbers are little-endian; "var" is a varint
/// (engine/store/codec/byte_codes.h).
///
///     offset  size  what
///     0       4     "MWB" and the version of this layout, 2
///     4       4     CRC-32 of everything from offset 8 on
///     8       8     length of the whole, this head included
///     16      -     march var, block x y z var
///                   labels var; each var, minus the one before (ascending)
///                   vertices var; least x, y, z of their positions, zigzag var
///       a vertex:   id var, minus the one before; x, y, z var, minus the least;
///                   5 bytes: ten codes of 4 bits, one for each number of the quadric (a, b, c),
///                   low bits first: 0..8 = how many high bytes of the double follow (the others
///                   are 0), 9 = equal to the first number; then those bytes, number by number
///                   tets var
///       a tet:      first row var, minus that of the tet before; each next row var, minus the one
///                   before, minus 1; place of the label among the labels var
///                   samples var; sample lists var (samples of one triangle and side)
///       a list:     three rows and the side, as for a tet; number of samples var; first sample
///                   zigzag var, minus the last of the list before; each next var, minus the one
///                   before
///
/// ENSURES: equal meshes give equal bytes; decode_block gives back the same mesh, every double
/// bit by bit.  REQUIRES: canonical.  Cost: linear; about as fast as copying is on start meshes.
[[nodiscard]] std::vector<std::byte> encode_block(const BlockKey& key, const BlockMesh& mesh);

/// ENSURES: a canonical mesh.
/// ERRORS: mw::Error(kInput) naming block and reason when the bytes are anything but the encoding
/// of a canonical mesh of this block; memory asked for is bounded by their number.
[[nodiscard]] BlockMesh decode_block(const BlockKey& key, std::span<const std::byte> bytes);

/// Returns the memory that the mesh's lists take.
[[nodiscard]] std::uint64_t memory_bytes(const BlockMesh& mesh);

/// How messages call a block: "block (3, 4, 5) of march 1".
[[nodiscard]] std::string name(const BlockKey& key);

}  // namespace mw::engine
