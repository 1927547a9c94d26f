// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The interface triangles at a vertex.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// Triangle (v, a, b) of an interface between labels low < high; a < b.
struct FanTriangle {
  LocalVertex a = 0;
  LocalVertex b = 0;
  Label low = 0;
  Label high = 0;
  bool faces_high = false;  ///< the normal (a - v) x (b - v) points to the side of high
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
    Label label = 0;
    bool ascends = false;  ///< the normal of (v, smaller, larger) points into the tet
    bool is_open = true;   ///< the other side has not come
  };

  void make_room(std::size_t sides);
  [[nodiscard]] std::size_t place_of(std::uint64_t edge) const;
  void collect_of_any(const TetMesh& mesh, LocalVertex v, std::vector<FanTriangle>& out);
  void collect_of_two(const TetMesh& mesh, LocalVertex v, std::vector<FanTriangle>& out);
  void pair_sides(LocalVertex a, LocalVertex b, Label label, std::vector<FanTriangle>& out);
  void open_or_close(LocalVertex a, LocalVertex b);

  std::vector<Side> sides_;          ///< hash table, linear probing; free where stamps differ
  std::vector<std::size_t> opened_;  ///< places in sides_ that hold a side of this call
  std::uint32_t stamp_ = 0;
};

}  // namespace mw
