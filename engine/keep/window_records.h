// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facts about visits: what went in, what came out, and where that is.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/store/block_keeper.h"
#include "engine/store/codec/byte_codes.h"
#include "engine/store/table/extent_allocator.h"
#include "io/codec/content_digest.h"

namespace mw::engine {

/// A version of a block by its content.
struct KeptVersion {
  io::ContentDigest digest;              ///< digest of its kept bytes; none: there is no version
  std::array<std::int32_t, 6> voxels{};  ///< the box that its vertices touch, lo and hi

  [[nodiscard]] Box3 box() const {
    return {{voxels[0], voxels[1], voxels[2]}, {voxels[3], voxels[4], voxels[5]}};
  }
};

/// What a visit is a function of.
struct VisitInput {
  io::ContentDigest blocks;  ///< its stored blocks, the window, and what is settled for the run
  io::ContentDigest bricks;  ///< LabelDigests::of_bricks()
  io::ContentDigest labels;  ///< LabelDigests::exact()
};

struct KeptBlock {
  KeptVersion version;
  bool is_kept = false;  ///< it is in the extent
  std::uint32_t memory_kib = 0;
};

/// A visit: a fact that stays true whatever happens to the volume.
struct WindowRecord {
  std::uint64_t window = 0;
  std::uint32_t run = 0;    ///< the run that made the visit, see KeptFacts
  bool is_dropped = false;  ///< the bytes of the blocks were given up for want of space
  VisitInput input;
  Extent extent;                  ///< the blocks that are kept, packed together (window_pack.h)
  std::vector<KeptBlock> blocks;  ///< in the order of the window's blocks
};

[[nodiscard]] ByteWriter encode(const WindowRecord& record);
/// ERRORS: BadBytes.
[[nodiscard]] WindowRecord decode_window_record(std::span<const std::byte> bytes);

}  // namespace mw::engine
