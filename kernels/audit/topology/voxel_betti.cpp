// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts, cells and pinches of a volume: one sweep over the places where a run of voxels begins or
// ends.
#include <algorithm>
#include <array>

#include "kernels/audit/topology/parts_union.h"
#include "kernels/audit/topology/voxel_runs.h"

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

/// Whether a label is pinched at a lattice vertex, and at its edges towards +y and +z, as above.
struct PinchedCells {
  std::array<bool, 256> corner{};
  std::array<bool, 256> along_y{};
  std::array<bool, 256> along_z{};
};

/// Returns whether voxels around a vertex are several sets that share no face.
constexpr bool falls_apart(unsigned mask) {
  unsigned sets = 0;
  while (mask != 0) {
    unsigned set = mask & (~mask + 1);
    for (int steps = 0; steps < 7; ++steps) {
      set |= ((set & 0x55U) << 1 | (set & 0xaaU) >> 1 | (set & 0x33U) << 2 | (set & 0xccU) >> 2 |
              (set & 0x0fU) << 4 | (set & 0xf0U) >> 4) &
             mask;
    }
    mask &= ~set;
    ++sets;
  }
  return sets > 1;
}

constexpr PinchedCells find_pinched_cells() {
  constexpr unsigned kPlusY = 0b11001100, kPlusZ = 0b11110000;
  PinchedCells table;
  for (unsigned mask = 0; mask < 256; ++mask) {
    const auto is_pinched = [mask](unsigned star) {
      return falls_apart(mask & star) && falls_apart(star & ~mask);
    };
    table.corner[mask] = falls_apart(mask) || falls_apart(0xffU & ~mask);
    table.along_y[mask] = is_pinched(kPlusY);
    table.along_z[mask] = is_pinched(kPlusZ);
  }
  return table;
}

constexpr PinchedCells kPinched = find_pinched_cells();

/// Walks one row of runs and tells the parts on both sides of a position.
class RowCursor {
 public:
  RowCursor(RunRow row, std::uint32_t exterior, std::uint32_t length)
      : row_(row), exterior_(exterior), length_(length), after_(exterior) {}

  /// The next position where the part changes; kNone past the row's end, or outside the box.
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

/// Collects the part graph, the Euler sums and pinches.  Where none of the four rows around a line
/// of vertices changes, cells come in pairs (c, c x edge) of opposite sign with the same labels,
/// nothing touches that did not touch at the last change, and a label is pinched all along the line
/// or nowhere: only changes need a look.
class VoxelSweep {
 public:
  /// owned is a box of vertices, relative to the first voxel of the runs.
  VoxelSweep(const VoxelRuns& runs, const Box3& owned, std::size_t label_count)
      : runs_(runs), owned_(owned), euler_(label_count + 1), pinches_(label_count + 1) {}

  /// Returns the pinches by class, that of the exterior being the last.
  [[nodiscard]] const std::vector<VoxelPinches>& pinches() const { return pinches_; }

  PartsPiece run() {
    for (std::int64_t z = owned_.lo.z; z < owned_.hi.z; ++z) {
      for (std::int64_t y = owned_.lo.y; y < owned_.hi.y; ++y) sweep_line(y, z);
    }
    const std::span<const Label> part_class = runs_.part_class();
    return {{part_class.begin(), part_class.end()},
            graph_.take_face_pairs(),
            graph_.take_vertex_pairs(),
            euler_.cells()};
  }

 private:
  /// Visits the vertices (.., y, z); those that are not owned only move the cursors.
  void sweep_line(std::int64_t y, std::int64_t z) {
    const auto cursor = [&](std::int64_t dy, std::int64_t dz) {
      return RowCursor(runs_.row(y + dy, z + dz), runs_.exterior_part(),
                       static_cast<std::uint32_t>(runs_.shape().x));
    };
    std::array<RowCursor, 4> rows{cursor(-1, -1), cursor(0, -1), cursor(-1, 0), cursor(0, 0)};
    std::uint32_t last = 0;
    while (true) {
      std::uint32_t x = RowCursor::kNone;
      for (const RowCursor& row : rows) x = std::min(x, row.next());
      if (x == RowCursor::kNone) return;
      look_along(rows, last, x);
      last = x;
      std::array<std::uint32_t, 8> around{};
      for (std::size_t r = 0; r < 4; ++r) {
        rows[r].move_to(x);
        around[2 * r] = rows[r].before();
        around[2 * r + 1] = rows[r].after();
      }
      if (x >= owned_.lo.x && x < owned_.hi.x) look_at(around);
    }
  }

  /// Takes the edges along x between two vertices, and the vertices between these.
  void look_along(const std::array<RowCursor, 4>& rows, std::uint32_t from, std::uint32_t to) {
    std::array<Label, 4> labels{};
    for (std::size_t r = 0; r < 4; ++r) labels[r] = runs_.part_class()[rows[r].after()];
    const auto owned = [&](std::int64_t first) {
      return std::max<std::int64_t>(
          std::min<std::int64_t>(to, owned_.hi.x) - std::max<std::int64_t>(first, owned_.lo.x), 0);
    };
    const auto look = [&](Label across, Label other, Label beside, Label beside_too) {
      if (across != other || across == beside || across == beside_too) return;
      pinches_[across].edges[0] += static_cast<std::uint64_t>(owned(from));
      pinches_[across].corners += static_cast<std::uint64_t>(owned(std::int64_t{from} + 1));
    };
    look(labels[0], labels[3], labels[1], labels[2]);
    look(labels[1], labels[2], labels[0], labels[3]);
  }

  /// Takes one vertex, by the parts of its eight voxels.
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
      if (!kPinched.corner[mask]) continue;
      VoxelPinches& pinches = pinches_[label];
      ++pinches.corners;
      pinches.edges[1] += kPinched.along_y[mask] ? 1U : 0U;
      pinches.edges[2] += kPinched.along_z[mask] ? 1U : 0U;
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
  Box3 owned_;
  PartGraph graph_;
  EulerSums euler_;
  std::vector<VoxelPinches> pinches_;
};

/// Lists the voxels of a row (y, z, from the first voxel loaded) that other tiles load too: those
/// of the tile's outer layers, except at the volume's sides.
class SharedRow {
 public:
  SharedRow(const VoxelTile& tile, const VoxelRuns& runs)
      : runs_(runs), lo_(tile.loaded.lo), shape_(tile.loaded.shape()), volume_{{}, tile.shape} {
    const Index3 before = tile.owned.lo - tile.loaded.lo;
    const Index3 behind = tile.shape - tile.loaded.hi;
    shared_ = {
        {{before.x > 0, behind.x > 0}, {before.y > 0, behind.y > 0}, {before.z > 0, behind.z > 0}}};
  }

  void add(std::int64_t y, std::int64_t z, std::vector<SharedRun>& out) const {
    const RunRow row = runs_.row(y, z);
    const bool all = is_outer(1, y, shape_.y) || is_outer(2, z, shape_.z);
    const auto first = static_cast<std::uint64_t>(volume_.offset(lo_ + Index3{0, y, z}));
    const auto length = static_cast<std::uint32_t>(shape_.x);
    for (std::size_t i = 0; all && i < row.starts.size(); ++i) {
      const std::uint32_t end = i + 1 < row.starts.size() ? row.starts[i + 1] : length;
      out.push_back({first + row.starts[i], end - row.starts[i], row.parts[i]});
    }
    if (all) return;
    if (shared_[0][0]) out.push_back({first, 1, row.parts.front()});
    if (shared_[0][1]) out.push_back({first + length - 1, 1, row.parts.back()});
  }

 private:
  [[nodiscard]] bool is_outer(std::size_t axis, std::int64_t at, std::int64_t length) const {
    return (shared_[axis][0] && at == 0) || (shared_[axis][1] && at + 1 == length);
  }

  const VoxelRuns& runs_;
  Index3 lo_;
  Index3 shape_;
  Box3 volume_;
  std::array<std::array<bool, 2>, 3> shared_{};
};

}  // namespace

VoxelParts voxel_parts(const VoxelTile& tile, std::size_t label_count) {
  const VoxelRuns runs(tile.voxels, label_count);
  const Box3 owned{tile.owned.lo - tile.loaded.lo, tile.owned.hi - tile.loaded.lo};
  VoxelSweep sweep(runs, owned, label_count);
  VoxelParts out{sweep.run(), {}, sweep.pinches()};
  out.pinches.resize(label_count);  // a box is pinched nowhere, from outside
  const SharedRow shared(tile, runs);
  for (std::int64_t z = 0; z < runs.shape().z; ++z) {
    for (std::int64_t y = 0; y < runs.shape().y; ++y) shared.add(y, z, out.shared);
  }
  return out;
}

}  // namespace mw::audit
