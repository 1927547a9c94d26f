// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Who keeps what windows leave for later runs, as the store sees it.
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
  /// The bytes of all that the window left together; 0: it is nowhere, since the visit is made
  /// again where this version is needed.
  std::uint32_t size = 0;
  std::uint32_t sum = 0;  ///< of what is there
  std::uint32_t memory_kib = 0;
  std::uint8_t part = 0;  ///< which of the window's blocks it is
};

/// A block as a window left it.
struct LeftBlock {
  std::span<const std::byte> bytes;  ///< as encode_block() has them
  std::uint64_t memory_bytes = 0;
  Box3 voxels;  ///< that its vertices touch; empty where there are none
};

/// Thread safety: as BlockStore's members that call it.
class BlockKeeper {
 public:
  virtual ~BlockKeeper() = default;
  /// Writes down what a window left, in the order of its blocks.  Returns where it is; the store
  /// has to hold what is nowhere until no window of this run needs it.
  /// ERRORS: mw::Error(kResource) when the disk is full.
  [[nodiscard]] virtual std::vector<KeptPlace> keep(const WindowKey& window,
                                                    std::span<const LeftBlock> blocks) = 0;
  /// A block that a window of another process left, and that one of this process takes next.
  virtual void receive(const BlockKey& key, const LeftBlock& block) = 0;
  /// The bytes of a kept block, as encode_block() has them.
  /// ERRORS: DamagedWork when they are not those that were kept.
  [[nodiscard]] virtual std::vector<std::byte> read(const BlockKey& key,
                                                    const KeptPlace& place) const = 0;
  /// A file for blocks of this run that are nowhere and do not fit in memory.
  [[nodiscard]] virtual std::unique_ptr<WorkFile> open_spill() = 0;
};

}  // namespace mw::engine
