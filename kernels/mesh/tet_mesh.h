// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// TetMesh: the one mutable mesh, that of a window.  Each vertex holds its star as link triangles.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/core/assert.h"
#include "kernels/core/label.h"
#include "kernels/core/lattice.h"
#include "kernels/mesh/block_mesh.h"
#include "kernels/quadric/quadric.h"

namespace mw {

/// The labels of a mesh in ascending order have the bits 0 to 63, and then 0 again.  So the bits
/// follow from the order of these labels alone: a label that is elsewhere in the volume, and shifts
/// the numbers of the others, changes nothing here.
/// Memory: at most 64 bytes a label.
class LabelBits {
 public:
  LabelBits() : LabelBits(std::vector<Label>{}) {}
  /// REQUIRES: ascending, each label once, without sides.
  explicit LabelBits(const std::vector<Label>& labels)
      : slots_(std::bit_ceil(std::max<std::size_t>(4 * labels.size(), 4))),
        shift_(static_cast<unsigned>(32 - std::countr_zero(slots_.size()))) {
    unsigned next = 0;
    for (const Label label : labels) {
      std::size_t at = slot(label);
      while (slots_[at].bit != kFree) at = (at + 1) & (slots_.size() - 1);
      slots_[at] = {label, static_cast<std::uint8_t>(next++ % 64)};
    }
  }

  /// The label's bit, whatever side it is on; 0 for a label that is not one of these.
  [[nodiscard]] std::uint64_t of(Label sided) const {
    const Label label = without_side(sided);
    for (std::size_t at = slot(label);; at = (at + 1) & (slots_.size() - 1)) {
      if (slots_[at].bit == kFree) return 0;
      if (slots_[at].label == label) return std::uint64_t{1} << slots_[at].bit;
    }
  }

 private:
  static constexpr std::uint8_t kFree = 0xff;
  struct Slot {
    Label label = 0;
    std::uint8_t bit = kFree;
  };

  [[nodiscard]] std::size_t slot(Label label) const { return label * 0x9E3779B1U >> shift_; }

  std::vector<Slot> slots_;  ///< a hash table with linear probing, for look-ups only
  unsigned shift_;
};

/// A set of vertices that is emptied at once.
class VertexMarks {
 public:
  explicit VertexMarks(std::size_t vertices) : marks_(vertices, 0) {}

  void clear() { ++epoch_; }
  /// Adds v; true when it was not yet in the set.
  bool insert(std::uint32_t v) {
    const bool is_new = marks_[v] != epoch_;
    marks_[v] = epoch_;
    return is_new;
  }

 private:
  std::vector<std::uint32_t> marks_;
  std::uint32_t epoch_ = 1;
};

/// Row of a vertex in its window; ascending with the global id.
using LocalVertex = std::uint32_t;

/// A tetrahedron seen from one of its vertices v: (v, a, b, c) is positively oriented.
struct LinkTriangle {
  LocalVertex a = 0;
  LocalVertex b = 0;
  LocalVertex c = 0;
  Label label = 0;

  friend auto operator<=>(const LinkTriangle&, const LinkTriangle&) = default;

  [[nodiscard]] bool has(LocalVertex v) const { return a == v || b == v || c == v; }
};

/// A positively oriented tetrahedron.
struct LocalTet {
  std::array<LocalVertex, 4> vertices{};
  Label label = 0;
};

/// Bits of the box planes that a vertex lies on: 1, 2 for low and high x; 4, 8 for y; 16, 32 for z.
using BoxPlanes = std::uint8_t;

/// Axes (bit 0 = x) along which a vertex on these planes cannot move.
[[nodiscard]] constexpr unsigned fixed_axes(BoxPlanes planes) {
  return ((planes & 3U) != 0 ? 1U : 0U) | ((planes & 12U) != 0 ? 2U : 0U) |
         ((planes & 48U) != 0 ? 4U : 0U);
}

/// The mesh of a window.
///
/// The exterior is present as virtual tetrahedra of label kExterior between each triangle on the
/// volume's box, unless the plane is an inner one, and the vertex infinity(), so that the star of a
/// free vertex is always a closed sphere and the topology test needs no special case
/// (kernels/topology/README.md, "The sphere").
///
/// A vertex is free when its star is complete, that is, when its loaded link is a sphere: with n
/// link vertices and F link triangles, 2 n = F + 4 (Euler; no proper subset of a triangulated
/// sphere satisfies it).  Only free vertices may move or vanish (Sec 4.1; kernels/README.md, "Free
/// and fixed vertices").
///
/// Inner planes of the box are those that the mesh goes on beyond, because the volume repeats
/// itself.  No tet crosses one.  Tets beyond bear a side (side_beyond()).
class TetMesh {
 public:
  /// Local vertices are the rows of `vertices`.
  /// REQUIRES: vertices ascending by id; tets by rows, in a canonical order, all within
  /// kMaxTetExtent and not flat; box = far corner of the volume in lattice units.
  TetMesh(std::span<const BlockVertex> vertices, std::span<const BlockTet> tets, Point box,
          BoxPlanes inner = 0);

  [[nodiscard]] LocalVertex vertex_count() const {
    return static_cast<LocalVertex>(points_.size());
  }
  [[nodiscard]] LocalVertex infinity() const { return vertex_count(); }

  [[nodiscard]] BlockVertex vertex(LocalVertex v) const {
    return {ids_[v], points_[v], quadrics_[v]};
  }
  [[nodiscard]] VertexId id(LocalVertex v) const { return ids_[v]; }
  [[nodiscard]] Point position(LocalVertex v) const { return points_[v]; }
  [[nodiscard]] const Quadric& quadric(LocalVertex v) const { return quadrics_[v]; }
  [[nodiscard]] BoxPlanes planes(LocalVertex v) const { return planes_[v]; }
  [[nodiscard]] bool is_free(LocalVertex v) const { return free_[v] != 0; }
  [[nodiscard]] BoxPlanes inner_planes() const { return inner_; }
  /// Is the edge in a plane that the mesh goes through?
  [[nodiscard]] bool is_in_inner_plane(LocalVertex v, LocalVertex w) const {
    return (planes_[v] & planes_[w] & inner_) != 0;
  }
  [[nodiscard]] bool is_alive(LocalVertex v) const { return stars_[v].size != 0; }
  /// Grows with every change of the mesh.
  [[nodiscard]] std::uint64_t changes() const { return changes_; }
  /// Changes whenever v moves, another vertex is merged into it, or a tet at it is removed.
  [[nodiscard]] std::uint32_t version(LocalVertex v) const { return versions_[v]; }

  /// The loaded tetrahedra at v, virtual ones included.  Invalid after any change of the mesh.
  [[nodiscard]] std::span<const LinkTriangle> star(LocalVertex v) const {
    return {pool_.data() + stars_[v].begin, stars_[v].size};
  }

  /// Number of distinct labels at v, exterior included (the paper's order, Sec 5.3.1).  Sides do
  /// not count, but an inner plane at v does once, as the exterior would.
  /// REQUIRES: v free (a fixed vertex may have labels that are not loaded).
  [[nodiscard]] int order(LocalVertex v) const { return orders_[v]; }
  /// The bits of the labels at v; all bits at a fixed vertex, whose labels may not all be loaded.
  [[nodiscard]] std::uint64_t label_signature(LocalVertex v) const { return signatures_[v]; }
  /// The label's bit, whatever its side (LabelBits); of more than 64 labels several share one.
  [[nodiscard]] std::uint64_t label_bit(Label label) const { return bits_.of(label); }
  /// True when v lies between two labels of the volume (not merely on the box).
  [[nodiscard]] bool on_interface(LocalVertex v) const {
    return orders_[v] > (planes_[v] != 0 ? 2 : 1);
  }

  /// Contracts edge (keep, drop): drop vanishes, keep goes to position with the given quadric.
  /// REQUIRES: both free, joined by an edge, a valid contraction; position on planes of keep alone.
  void contract(LocalVertex keep, LocalVertex drop, Point position, const Quadric& quadric);

  /// Moves v; its quadric stays the same function.  REQUIRES: v free; all tets stay positive.
  void move(LocalVertex v, Point position, const Quadric& quadric);

  /// REQUIRES: positive orientation, also in the sense of virtual tets.
  void add_tet(const LocalTet& tet);
  /// REQUIRES: the tet is there.
  void remove_tet(const LocalTet& tet);
  /// Gives a tet that is there another label.
  void relabel(const LocalTet& tet, Label label);

  /// Every tetrahedron once (virtual ones excluded): positive, grouped by its smallest vertex.
  [[nodiscard]] std::vector<LocalTet> tets() const;
  /// Every tetrahedron once (virtual ones excluded), vertices ascending, in ascending order.
  [[nodiscard]] std::vector<BlockTet> sorted_tets() const;

 private:
  struct Star {
    std::uint32_t begin = 0;
    std::uint32_t size = 0;
    std::uint32_t capacity = 0;
  };

  [[nodiscard]] Label side_of(const std::array<LocalVertex, 4>& tet, Point box) const;
  void count_stars(std::span<const LocalTet> tets);
  [[nodiscard]] std::vector<std::uint32_t> count_link_vertices();
  void classify_vertices();
  void classify_labels(LocalVertex v);
  /// The row of a tet, which is there, among those of v's star.
  [[nodiscard]] std::uint32_t row_of(LocalVertex v, const LinkTriangle& wanted) const;
  void append(LocalVertex v, LinkTriangle triangle);
  void reserve(LocalVertex v, std::uint32_t capacity);
  /// Moves stars together, where most of the pool is what they left behind, and leaves `room` free.
  void compact(std::uint32_t room);
  void erase(LocalVertex v, std::uint32_t index);
  void replace_in_link(LocalVertex keep, LocalVertex drop);
  void merge_stars(LocalVertex keep, LocalVertex drop);

  // Positions are read far more often than anything else, so they lie together.
  std::vector<Point> points_;
  std::vector<VertexId> ids_;
  std::vector<Quadric> quadrics_;
  std::vector<BoxPlanes> planes_;
  BoxPlanes inner_;
  std::vector<std::uint8_t> free_;
  std::vector<std::uint8_t> orders_;
  LabelBits bits_;  ///< bits of all labels, the exterior among them
  std::vector<std::uint64_t> signatures_;
  std::vector<std::uint32_t> versions_;
  std::vector<Star> stars_;
  std::vector<LinkTriangle> pool_;
  std::uint64_t changes_ = 0;
  VertexMarks marks_;
};

/// The star entry of corner i of a positive tet: an even permutation that brings it to the front.
[[nodiscard]] constexpr LinkTriangle link_triangle(const LocalTet& t, int i) {
  const auto& v = t.vertices;
  switch (i) {
    case 0:
      return {v[1], v[2], v[3], t.label};
    case 1:
      return {v[0], v[3], v[2], t.label};
    case 2:
      return {v[0], v[1], v[3], t.label};
    default:
      return {v[0], v[2], v[1], t.label};
  }
}

}  // namespace mw
