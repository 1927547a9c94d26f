// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The flow of blocks between windows: which window needs a block next, and which one left it.
#pragma once

#include <optional>
#include <vector>

#include "engine/store/run_layout.h"

namespace mw::engine {

/// The windows that cover a block visit it one after the other, so every version of it has exactly
/// one next user.  That is the next of these windows; after the last of them, the first window of
/// the next march over the block that it becomes a part of; after the last march, the output.  A
/// window may start when its inputs are there, which orders all windows as WindowOrder's edges do.
/// All members are pure functions of the layout, which outlives this.
class BlockRoute {
 public:
  explicit BlockRoute(const RunLayout& layout) : layout_(layout) {}

  /// Returns the next user, or nothing if it is the output.  REQUIRES: the window covers the block.
  [[nodiscard]] std::optional<WindowKey> next_user(const BlockVersion& version) const;

  /// Returns the versions that a window takes from other windows, blocks ascending.  A block that
  /// it is the first to see is made from voxels in the first march, from its parts in a later one.
  [[nodiscard]] std::vector<BlockVersion> inputs(const WindowKey& key) const;

  /// Returns what the last window over a block leaves; the output reads it for the last march.
  [[nodiscard]] BlockVersion last_version(const BlockKey& block) const;

 private:
  [[nodiscard]] std::optional<WindowKey> after(const BlockKey& block, std::uint64_t rank) const;
  [[nodiscard]] std::optional<WindowKey> before(const BlockKey& block, std::uint64_t rank) const;

  const RunLayout& layout_;
};

}  // namespace mw::engine
