// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The interface by which the store keeps what windows leave for later runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/store/journal/work_file.h"
#include "engine/store/run_layout.h"

namespace mw::engine {

/// Where a kept version of a block is.
struct KeptPlace {
  std::uint64_t offset = 0;
  /// The size in bytes of all that the window left together.  It is 0 for a version that is not
  /// kept, because the visit is made again where this version is needed.
  std::uint32_t size = 0;
  std::uint32_t sum = 0;  ///< checksum of the block's kept bytes
  std::uint32_t memory_kib = 0;
  std::uint8_t part = 0;  ///< which of the window's kept blocks it is
};

/// A block as a window left it.
struct LeftBlock {
  std::span<const std::byte> bytes;  ///< made by encode_block()
  std::uint64_t memory_bytes = 0;
  Box3 voxels;  ///< the voxels that its vertices touch; empty without vertices
};

/// Thread safety: that of the members of BlockStore that call it.
class BlockKeeper {
 public:
  virtual ~BlockKeeper() = default;
  /// Writes the blocks that a window left, and returns the place of each, in the same order.  The
  /// store must hold versions that are not kept (size 0) until no window of this run needs them.
  /// ERRORS: mw::Error(kResource) when the disk is full.
  [[nodiscard]] virtual std::vector<KeptPlace> keep(const WindowKey& window,
                                                    std::span<const LeftBlock> blocks) = 0;
  /// Notes a block that a window of another process left and that one of this process takes next.
  virtual void receive(const BlockKey& key, const LeftBlock& block) = 0;
  /// Returns the bytes of a kept block, as encode_block() made them.
  /// ERRORS: DamagedWork when they are not those that were kept.
  [[nodiscard]] virtual std::vector<std::byte> read(const BlockKey& key,
                                                    const KeptPlace& place) const = 0;
  /// Opens a file for blocks of this run that are not kept and do not fit in memory.
  [[nodiscard]] virtual std::unique_ptr<WorkFile> open_spill() = 0;
};

}  // namespace mw::engine
