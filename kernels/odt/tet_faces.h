// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Triangles of tets, sorted so that the tets on both sides of one come together.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// One of the four triangles of a positive tet.
struct TetFace {
  std::array<LocalVertex, 3> vertices{};  ///< ascending
  std::uint32_t tet = 0;
  /// 0 or 1; two positive tets on opposite sides of a triangle differ, on the same side agree.
  std::uint32_t side = 0;

  friend auto operator<=>(const TetFace&, const TetFace&) = default;
};

[[nodiscard]] inline TetFace tet_face(const LocalTet& tet, int corner, std::uint32_t number) {
  const LinkTriangle t = link_triangle(tet, corner);
  TetFace face{{t.a, t.b, t.c}, number, 0};
  auto& v = face.vertices;
  const auto sort_two = [&face](LocalVertex& a, LocalVertex& b) {
    if (a < b) return;
    std::swap(a, b);
    face.side ^= 1U;
  };
  sort_two(v[0], v[1]);
  sort_two(v[1], v[2]);
  sort_two(v[0], v[1]);
  return face;
}

/// Calls visit(first, last) for the faces of each triangle; triangles ascend, and so do their tets.
template <typename Visit>
void for_each_triangle(std::vector<TetFace>& faces, Visit visit) {
  std::sort(faces.begin(), faces.end());
  for (auto first = faces.begin(); first != faces.end();) {
    const auto last = std::find_if(first, faces.end(),
                                   [&](const TetFace& f) { return f.vertices != first->vertices; });
    visit(first, last);
    first = last;
  }
}

}  // namespace mw
