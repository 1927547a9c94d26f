// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where blocks rest between the visits of windows (Sec 4.2).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/window/window_grid.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {

/// Returns the most that any of the windows to come may take; asked only where one does not fit.
using MostBytes = std::function<std::uint64_t()>;

/// Holds the blocks that the windows of one march have written.  The store knows nothing of what a
/// window does.
///
/// Thread safety: windows that share no block may take and commit at the same time; load(),
/// is_done() and the others may be called at any time for blocks that no such window holds.
/// ERRORS (all members): mw::Error(kResource) when memory or disk do not suffice; kInput when what
/// was stored comes back damaged.
class BlockStore {
 public:
  virtual ~BlockStore() = default;

  /// Sets memory aside for a window in flight, until it commits; blocks are spilled to make room.
  /// ENSURES: false when that does not suffice before other windows have committed.
  /// ERRORS: mw::Error(kResource) when there are no others, with the budget that has room for this
  /// window, and for most() if that is given.
  [[nodiscard]] virtual bool admit(Index3 window, std::uint64_t bytes, const MostBytes& most) = 0;
  [[nodiscard]] bool admit(Index3 window, std::uint64_t bytes) {
    return admit(window, bytes, nullptr);
  }
  /// Returns the blocks of a window, in the order of grid.blocks_of(window), as the last window
  /// that committed them or the march before left them.  A block that none has left is empty; it is
  /// made from voxels.
  [[nodiscard]] virtual std::vector<std::optional<BlockMesh>> take(Index3 window) = 0;
  /// Makes all of a window's results visible at once, and the window done.
  /// Memory for them comes out of what admit() set aside; the rest of that is given back.
  /// REQUIRES: canonical blocks, one for each block of the window, in the order of take().
  virtual void commit(Index3 window, std::vector<BlockMesh> blocks) = 0;

  /// Returns a block as it is at present; it stays in the store.  REQUIRES: it was committed, or
  /// the march before left it.
  [[nodiscard]] virtual BlockMesh load(Index3 block) const = 0;

  /// True if the window was committed, by this run or by the one that it goes on from; the set of
  /// these windows is closed under predecessors.
  [[nodiscard]] virtual bool is_done(Index3 window) const = 0;
  /// Returns the memory that take() of this window will need for its result.
  [[nodiscard]] virtual std::uint64_t taken_bytes(Index3 window) const = 0;
  /// Returns the memory that load() of this block will need for its result.
  [[nodiscard]] virtual std::uint64_t loaded_bytes(Index3 block) const = 0;
};

}  // namespace mw::engine
