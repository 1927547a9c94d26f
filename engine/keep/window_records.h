// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facts about visits: what went in, what came out, where that is, and which bytes go first when a
// folder has to become smaller.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/store/block_keeper.h"
#include "engine/store/codec/byte_codes.h"
#include "engine/store/run_layout.h"
#include "engine/store/table/segment_file.h"
#include "io/codec/hasher.h"

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

/// A window whose bytes are kept.
struct KeptBytes {
  std::uint64_t window = 0;
  std::uint32_t run = 0;    ///< the run that visited it
  std::uint64_t bytes = 0;  ///< what it takes of the file
};

/// True if the output reads a block as this window leaves it; such bytes are never given up, since
/// every later run reads them.
[[nodiscard]] bool leaves_final_block(const RunLayout& layout, const WindowKey& key);

/// Returns those that may be given up, in the order in which they go: windows of the earliest runs
/// first, among these the farthest from the box that the last run visited, then the last window.
[[nodiscard]] std::vector<KeptBytes> drop_order(const RunLayout& layout,
                                                std::vector<KeptBytes> kept,
                                                std::uint32_t last_run);

}  // namespace mw::engine
