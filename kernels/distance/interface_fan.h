// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The interface triangles at a vertex; and whether any of two labels is near a point, without a
// list of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/distance/point_triangle.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// Triangle (v, a, b) of an interface between labels low < high; a < b.
struct FanTriangle {
  LocalVertex a = 0;
  LocalVertex b = 0;
  Label low = 0;
  Label high = 0;
  bool faces_high = false;  ///< the normal (a - v) x (b - v) points to the side of high
  /// Where both tets are (kFirstSide); several triangles that differ in this are one interface.
  Label side = 0;
  bool in_inner_plane = false;  ///< the tets are on different sides
};

/// Collects the triangles at v that have different labels of the volume on their two sides,
/// ascending; the sides of the box are no interface.  At a vertex that is not free, only triangles
/// with both tets loaded are found.
class InterfaceFan {
 public:
  void collect(const TetMesh& mesh, LocalVertex v, std::vector<FanTriangle>& out);

 private:
  /// One side of triangle (v, a, b), until the other one comes.
  struct Side {
    std::uint64_t edge = 0;   ///< its smaller vertex in the upper half
    std::uint32_t stamp = 0;  ///< number of the call that filled it
    Label label = 0;          ///< with its side (kFirstSide)
    bool ascends = false;     ///< the normal of (v, smaller, larger) points into the tet
    bool is_open = true;      ///< the other side has not come
  };

  void make_room(std::size_t sides);
  [[nodiscard]] std::size_t place_of(std::uint64_t edge) const;
  void collect_of_any(const TetMesh& mesh, LocalVertex v, std::vector<FanTriangle>& out);
  void collect_of_two(const TetMesh& mesh, LocalVertex v, std::vector<FanTriangle>& out);
  void pair_sides(LocalVertex a, LocalVertex b, Label sided, std::vector<FanTriangle>& out);
  void open_or_close(LocalVertex a, LocalVertex b);

  std::vector<Side> sides_;          ///< hash table, linear probing; free where stamps differ
  std::vector<std::size_t> opened_;  ///< places in sides_ that hold a side of this call
  std::uint32_t stamp_ = 0;
};

/// A quick test before the interface triangles around a change are listed.  Of the samples that no
/// changed triangle takes, nineteen in twenty find no unchanged one either (an abdomen CT), and the
/// list costs more than this test.
class NearTriangle {
 public:
  struct Wanted {
    Vec3 point;          ///< in voxels
    double limit = 0.0;  ///< the largest distance
    Label low = 0;
    Label high = 0;
  };

  /// Returns false only when no triangle between low and high is within the limit, of those that
  /// are at one of `vertices` and have no corner in `without`.
  /// REQUIRES: no vertex of `vertices` is in `without`.
  [[nodiscard]] bool may_be_at(const TetMesh& mesh, std::span<const LocalVertex> vertices,
                               const std::array<LocalVertex, 2>& without, const Wanted& wanted);

 private:
  [[nodiscard]] bool may_be_at(const TetMesh& mesh, LocalVertex v,
                               const std::array<LocalVertex, 2>& without,
                               const Wanted& wanted) const;
  [[nodiscard]] unsigned sides_of(Point p) const;

  Point lo_{}, hi_{};  ///< corners of a box of all that is within the limit
};

}  // namespace mw
