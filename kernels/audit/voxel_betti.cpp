// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Betti numbers of a volume: one sweep over the places where a run of voxels begins or ends.
#include <algorithm>
#include <array>

#include "kernels/audit/part_graph.h"
#include "kernels/audit/voxel_runs.h"

namespace mw::audit {
namespace {

/// Signed counts of the cells that a lattice vertex owns (itself, three edges, three faces and the
/// voxel towards +x, +y, +z), for a label with the given voxels among the eight around the vertex
/// (bit dx + 2 dy + 4 dz).
struct OwnedCells {
  std::array<std::int8_t, 256> closed{};  ///< some voxel at the cell has the label
  std::array<std::int8_t, 256> only{};    ///< all of them have
};

constexpr OwnedCells count_owned_cells() {
  // A cell that extends along an axis sees only the voxels on the upper side of that axis.
  constexpr std::array<unsigned, 3> kUpper{0b10101010, 0b11001100, 0b11110000};
  OwnedCells table;
  for (unsigned axes = 0; axes < 8; ++axes) {
    unsigned star = 0xff;
    int sign = 1;
    for (unsigned axis = 0; axis < 3; ++axis) {
      if ((axes >> axis & 1U) == 0) continue;
      star &= kUpper[axis];
      sign = -sign;
    }
    for (unsigned mask = 0; mask < 256; ++mask) {
      if ((mask & star) != 0)
        table.closed[mask] = static_cast<std::int8_t>(table.closed[mask] + sign);
      if ((mask & star) == star)
        table.only[mask] = static_cast<std::int8_t>(table.only[mask] + sign);
    }
  }
  return table;
}

constexpr OwnedCells kOwned = count_owned_cells();

/// Walks one row of runs and tells the parts on both sides of a position.
class RowCursor {
 public:
  RowCursor(RunRow row, std::uint32_t exterior, std::uint32_t length)
      : row_(row), exterior_(exterior), length_(length), after_(exterior) {}

  /// Next position where the part changes; past the row's end, or outside the box, none.
  [[nodiscard]] std::uint32_t next() const {
    if (next_run_ < row_.starts.size()) return row_.starts[next_run_];
    return next_run_ == row_.starts.size() && next_run_ > 0 ? length_ : kNone;
  }
  void move_to(std::uint32_t x) {
    before_ = after_;
    if (next() != x) return;
    after_ = next_run_ < row_.starts.size() ? row_.parts[next_run_] : exterior_;
    ++next_run_;
  }
  [[nodiscard]] std::uint32_t before() const { return before_; }
  [[nodiscard]] std::uint32_t after() const { return after_; }

  static constexpr std::uint32_t kNone = 0xffffffffU;

 private:
  RunRow row_;
  std::uint32_t exterior_;
  std::uint32_t length_;
  std::uint32_t before_ = 0;
  std::uint32_t after_;
  std::size_t next_run_ = 0;
};

/// Collects the part graph and the Euler sums.  Where none of the four rows around a line of
/// vertices changes, cells come in pairs (c, c x edge) of opposite sign with the same labels, and
/// nothing touches that did not touch at the last change: only changes need a look.
class VoxelSweep {
 public:
  VoxelSweep(const VoxelRuns& runs, std::size_t label_count)
      : runs_(runs), euler_(label_count + 1), exterior_(label_count) {}

  std::vector<RegionBetti> run() {
    for (std::int64_t z = 0; z <= runs_.shape().z; ++z) {
      for (std::int64_t y = 0; y <= runs_.shape().y; ++y) sweep_line(y, z);
    }
    // The exterior is an open ball, hence one 3-cell; its closure adds the box's surface, chi 2.
    euler_.closed[exterior_] = 1;
    euler_.only[exterior_] = -1;
    return betti_of_parts(runs_.part_class(), graph_, euler_);
  }

 private:
  /// Vertices (0 .. nx, y, z).
  void sweep_line(std::int64_t y, std::int64_t z) {
    const auto cursor = [&](std::int64_t dy, std::int64_t dz) {
      return RowCursor(runs_.row(y + dy, z + dz), runs_.exterior_part(),
                       static_cast<std::uint32_t>(runs_.shape().x));
    };
    std::array<RowCursor, 4> rows{cursor(-1, -1), cursor(0, -1), cursor(-1, 0), cursor(0, 0)};
    while (true) {
      std::uint32_t x = RowCursor::kNone;
      for (const RowCursor& row : rows) x = std::min(x, row.next());
      if (x == RowCursor::kNone) return;
      std::array<std::uint32_t, 8> around{};
      for (std::size_t r = 0; r < 4; ++r) {
        rows[r].move_to(x);
        around[2 * r] = rows[r].before();
        around[2 * r + 1] = rows[r].after();
      }
      look_at(around);
    }
  }

  /// One vertex with the parts of its eight voxels.
  void look_at(const std::array<std::uint32_t, 8>& around) {
    std::array<std::uint32_t, 8> parts{};
    std::array<std::uint8_t, 8> masks{};
    const std::size_t count = sort_distinct(around, parts, masks);
    graph_.add_vertex(std::span(parts).first(count), runs_.part_class());
    graph_.add_face(around[6], around[7]);
    graph_.add_face(around[5], around[7]);
    graph_.add_face(around[3], around[7]);
    for (std::size_t i = 0; i < count;) {
      const Label label = runs_.part_class()[parts[i]];
      unsigned mask = 0;
      for (; i < count && runs_.part_class()[parts[i]] == label; ++i) mask |= masks[i];
      euler_.closed[label] += kOwned.closed[mask];
      euler_.only[label] += kOwned.only[mask];
    }
  }

  static std::size_t sort_distinct(const std::array<std::uint32_t, 8>& around,
                                   std::array<std::uint32_t, 8>& parts,
                                   std::array<std::uint8_t, 8>& masks) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      std::size_t at = 0;
      while (at < count && parts[at] < around[i]) ++at;
      if (at == count || parts[at] != around[i]) {
        for (std::size_t k = count++; k > at; --k) {
          parts[k] = parts[k - 1];
          masks[k] = masks[k - 1];
        }
        parts[at] = around[i];
        masks[at] = 0;
      }
      masks[at] = static_cast<std::uint8_t>(masks[at] | 1U << i);
    }
    return count;
  }

  const VoxelRuns& runs_;
  PartGraph graph_;
  EulerSums euler_;
  std::size_t exterior_;
};

}  // namespace

std::vector<RegionBetti> voxel_betti(const VoxelLabels& volume, std::size_t label_count) {
  const VoxelRuns runs(volume, label_count);
  return VoxelSweep(runs, label_count).run();
}

}  // namespace mw::audit
