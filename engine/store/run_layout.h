// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// All marches of a run: numbers for their blocks and windows, which window needs a block next, and
// which one left it.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "engine/settings/settings.h"
#include "engine/store/codec/block_codec.h"
#include "engine/window/other_grid.h"
#include "engine/window/window_grid.h"
#include "engine/window/window_order.h"

namespace mw::engine {

/// A window of a run.
struct WindowKey {
  std::uint32_t march = 0;
  Index3 window;

  friend bool operator==(const WindowKey&, const WindowKey&) = default;
};

/// The version of a block that a window left.
struct BlockVersion {
  BlockKey block;
  WindowKey from;

  friend bool operator==(const BlockVersion&, const BlockVersion&) = default;
};

/// Windows that are finished, by number.  Thread safety: none.
class DoneWindows {
 public:
  explicit DoneWindows(std::uint64_t windows) : done_(windows, false) {}

  [[nodiscard]] bool contains(std::uint64_t window) const { return done_[window]; }
  void insert(std::uint64_t window) {
    if (!done_[window]) ++count_;
    done_[window] = true;
  }
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  std::vector<bool> done_;
  std::uint64_t count_ = 0;
};

/// Numbers ("slots") of all blocks and windows of a run, march by march, x fastest.
///
/// A block of a later march takes the place of blocks of the march before, its parts: of one, or,
/// where blocks have twice the edge, of up to 2 x 2 x 2.  Grids may begin at different blocks of a
/// volume that repeats itself.
class RunLayout {
 public:
  /// REQUIRES: at least one grid, each with blocks of the edge of the one before or twice that.
  explicit RunLayout(std::vector<WindowGrid> grids, Order order = Order::kRaster);

  [[nodiscard]] const WindowGrid& grid(std::uint32_t march) const { return grids_[march]; }
  [[nodiscard]] std::uint32_t marches() const { return static_cast<std::uint32_t>(grids_.size()); }
  /// Returns the grid of the last march as it begins at the volume's corner.
  [[nodiscard]] const WindowGrid& output_grid() const { return output_grid_; }
  [[nodiscard]] std::uint64_t slots() const { return first_slot_.back(); }
  [[nodiscard]] std::uint64_t windows() const { return first_window_.back(); }

  [[nodiscard]] std::uint64_t slot(const BlockKey& key) const;
  [[nodiscard]] BlockKey key(std::uint64_t slot) const;
  [[nodiscard]] std::uint64_t window(const WindowKey& key) const;
  [[nodiscard]] WindowKey window_key(std::uint64_t window) const;

  /// Returns the blocks that a window covers.
  [[nodiscard]] std::vector<BlockKey> blocks_of(const WindowKey& key) const;
  /// Returns the blocks of the march before that make up a block.  REQUIRES: key.march > 0.
  [[nodiscard]] std::vector<BlockKey> parts(const BlockKey& key) const;
  /// Returns the block of the next march that a block becomes a part of.
  /// REQUIRES: key.march + 1 < marches().
  [[nodiscard]] BlockKey whole(const BlockKey& key) const;
  /// Returns how many voxels places of a block are moved in a block of a later march, which it is a
  /// part of.
  [[nodiscard]] Index3 way(const BlockKey& from, const BlockKey& to) const {
    return grid(to.march).beyond(to.block) - grid(from.march).beyond(from.block);
  }
  /// Returns the content of a block as it is in a block of a later march, which it is a part of.
  [[nodiscard]] BlockMesh moved(BlockMesh content, const BlockKey& from, const BlockKey& to) const {
    return in_other_grid(std::move(content), {grid(from.march), from.block},
                         {grid(to.march), to.block});
  }

  /// The march's windows in their sequence.
  [[nodiscard]] WindowOrder order(std::uint32_t march) const { return {grids_[march], order_}; }
  /// Returns the box of the windows that cover a block in its march.
  [[nodiscard]] Box3 windows_over(const BlockKey& key) const;

  /// Returns a point on the run's time line: that of the first window that is not done and covers
  /// the block or what it becomes a part of, or of its turn in the output if there is none.
  [[nodiscard]] std::uint64_t next_use(const BlockKey& key, const DoneWindows& done) const;

 private:
  [[nodiscard]] std::optional<std::uint64_t> next_window(const BlockKey& key,
                                                         const DoneWindows& done) const;

  std::vector<WindowGrid> grids_;
  WindowGrid output_grid_;
  Order order_;
  std::vector<std::uint64_t> first_slot_;    ///< the first of each march, then the number of all
  std::vector<std::uint64_t> first_window_;  ///< the first of each march, then the number of all
};

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
