// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Junctions of a volume: one look at every lattice vertex and the cells towards +x, +y, +z.
#include <algorithm>
#include <array>

#include "kernels/audit/topology/junction_counter.h"

namespace mw::audit {
namespace {

/// At most eight labels, ascending and distinct.
class FewLabels {
 public:
  void add(Label label) {
    std::size_t at = 0;
    while (at < count_ && labels_[at] < label) ++at;
    if (at < count_ && labels_[at] == label) return;
    for (std::size_t i = count_++; i > at; --i) labels_[i] = labels_[i - 1];
    labels_[at] = label;
  }
  [[nodiscard]] std::span<const Label> all() const { return std::span(labels_).first(count_); }

 private:
  std::array<Label, 8> labels_{};
  std::size_t count_ = 0;
};

/// The lattice vertices that a tile owns, and one more row of vertices on each side.
class TileLattice {
 public:
  explicit TileLattice(const VoxelTile& tile)
      : tile_(tile),
        all_{{0, 0, 0}, tile.shape + Index3{1, 1, 1}},
        box_(intersection({tile.owned.lo - Index3{1, 1, 1}, tile.owned.hi + Index3{1, 1, 1}},
                          all_)) {}

  [[nodiscard]] const Box3& box() const { return box_; }
  [[nodiscard]] bool owns(Index3 v) const { return tile_.owned.contains(v); }
  [[nodiscard]] std::uint64_t row(Index3 v) const {
    return static_cast<std::uint64_t>(box_.offset(v));
  }

  [[nodiscard]] JunctionVertices vertices() const {
    JunctionVertices out;
    for (Index3 v = box_.lo; v.z < box_.hi.z; ++v.z) {
      for (v.y = box_.lo.y; v.y < box_.hi.y; ++v.y) {
        for (v.x = box_.lo.x; v.x < box_.hi.x; ++v.x) {
          out.owned.push_back(owns(v));
          out.shared.push_back(!owns(v) || is_on_lower_side(v));
          out.ids.push_back(static_cast<std::uint64_t>(all_.offset(v)));
        }
      }
    }
    return out;
  }

 private:
  /// True where edges that other tiles own end.
  [[nodiscard]] bool is_on_lower_side(Index3 v) const {
    const Index3 lo = tile_.owned.lo;
    return (lo.x > 0 && v.x == lo.x) || (lo.y > 0 && v.y == lo.y) || (lo.z > 0 && v.z == lo.z);
  }

  const VoxelTile& tile_;
  Box3 all_;
  Box3 box_;
};

/// Visits cells by their smallest vertices.
class LatticeSweep {
 public:
  LatticeSweep(const VoxelTile& tile, std::size_t label_count)
      : tile_(tile),
        exterior_(static_cast<Label>(label_count)),
        lattice_(tile),
        sweep_(lattice_.vertices()) {}

  JunctionsPiece run() {
    const Box3 box = intersection(lattice_.box(), {{0, 0, 0}, tile_.owned.hi});
    for (Index3 v = box.lo; v.z < box.hi.z; ++v.z) {
      for (v.y = box.lo.y; v.y < box.hi.y; ++v.y) {
        for (v.x = box.lo.x; v.x < box.hi.x; ++v.x) look_at(v);
      }
    }
    return sweep_.take();
  }

 private:
  static constexpr std::array<unsigned, 3> kUpper{0b10101010, 0b11001100, 0b11110000};

  /// Callers ask for voxels that are not loaded too, but these count only where the exterior is.
  [[nodiscard]] Label label_at(Index3 v) const {
    if (!tile_.loaded.contains(v)) return exterior_;
    return tile_.voxels.labels[static_cast<std::size_t>(tile_.loaded.offset(v))];
  }
  [[nodiscard]] std::uint64_t stride(unsigned axis) const {
    const Index3 s = lattice_.box().shape();
    return static_cast<std::uint64_t>(axis == 0 ? 1 : axis == 1 ? s.x : s.x * s.y);
  }

  void look_at(Index3 v) {
    for (int i = 0; i < 8; ++i) {
      around_[static_cast<std::size_t>(i)] =
          label_at({v.x - 1 + (i & 1), v.y - 1 + (i >> 1 & 1), v.z - 1 + (i >> 2)});
    }
    if (std::count(around_.begin(), around_.end(), around_[0]) == 8) return;
    const std::uint64_t here = lattice_.row(v);
    if (lattice_.owns(v)) add_vertex_and_edges(here);
    // A face all of whose vertices come before the tile's is none of its own.
    const Index3 lo = tile_.owned.lo;
    const std::array<bool, 3> is_before{v.x < lo.x, v.y < lo.y, v.z < lo.z};
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (!is_before[axis]) add_face(axis, here);
    }
  }

  void add_vertex_and_edges(std::uint64_t here) {
    sweep_.add_vertex(labels_in(0xff).all(), here);
    for (unsigned axis = 0; axis < 3; ++axis) {
      sweep_.add_edge(labels_in(kUpper[axis]).all(), here, here + stride(axis));
    }
  }

  /// Adds the face across an axis.
  void add_face(unsigned axis, std::uint64_t here) {
    const unsigned u = (axis + 1) % 3, w = (axis + 2) % 3;
    const FewLabels face = labels_in(kUpper[u] & kUpper[w]);
    const std::uint64_t a = here + stride(u), b = here + stride(w);
    sweep_.add_face(face.all(), std::array{here, a, a + stride(w), b});
  }

  /// Labels of the voxels around the vertex that `mask` names.
  [[nodiscard]] FewLabels labels_in(unsigned mask) const {
    FewLabels out;
    for (std::size_t i = 0; i < 8; ++i) {
      if ((mask >> i & 1U) != 0) out.add(around_[i]);
    }
    return out;
  }

  const VoxelTile& tile_;
  Label exterior_;
  TileLattice lattice_;
  JunctionSweep sweep_;
  std::array<Label, 8> around_{};
};

}  // namespace

JunctionsPiece voxel_junctions(const VoxelTile& tile, std::size_t label_count) {
  return LatticeSweep(tile, label_count).run();
}

}  // namespace mw::audit
