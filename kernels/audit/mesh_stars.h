// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which tets are at each vertex of a mesh, and every triangle once with the tets on it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/audit/subject.h"

namespace mw::audit {

/// A tet on one triangle.
struct FaceSide {
  std::uint64_t others = 0;  ///< the triangle's two larger vertices, middle one in the high half
  std::uint32_t tet = 0;
  bool odd = false;  ///< the tet is an odd permutation of (its apex, the triangle ascending)

  friend auto operator<=>(const FaceSide&, const FaceSide&) = default;
};

/// A triangle, vertices ascending, and the tets on it, ascending.
struct MeshFace {
  std::array<std::uint32_t, 3> vertices{};
  std::span<const FaceSide> sides;
};

/// Returns which corner of a tet is opposite to one of its triangles.
[[nodiscard]] unsigned apex_of(const TetRow& tet, const std::array<std::uint32_t, 3>& triangle);

/// The tets at every vertex of a tile.  Tets that name a vertex twice are left out.
/// Memory: 16 bytes a tet and 8 a vertex.  Reads the mesh as long as it lives.
class MeshStars {
 public:
  /// Errors: kInput when labels and tets differ in number or a vertex row is out of range,
  /// kResource above 2^31 tets or from 2^32 - 1 vertices on.
  explicit MeshStars(const MeshTile& tile);
  explicit MeshStars(const AuditMesh& mesh) : MeshStars(MeshTile{.mesh = mesh}) {}

  [[nodiscard]] const MeshTile& tile() const { return tile_; }
  [[nodiscard]] const AuditMesh& mesh() const { return tile_.mesh; }
  [[nodiscard]] bool owns(std::uint64_t vertex) const { return tile_.owns(vertex); }
  [[nodiscard]] std::uint32_t vertex_count() const {
    return static_cast<std::uint32_t>(begin_.size() - 1);
  }
  /// The tets at a vertex, ascending.
  [[nodiscard]] std::span<const std::uint32_t> star(std::uint32_t vertex) const {
    return std::span(tets_).subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
  }
  /// The sides of all triangles whose smallest vertex this is, sorted by triangle, then tet.
  void collect_sides(std::uint32_t vertex, std::vector<FaceSide>& sides) const;

  /// True for a tet that is in no star, as it names a vertex twice.
  [[nodiscard]] bool leaves_out(std::size_t tet) const;

 private:
  MeshTile tile_;
  std::vector<std::uint64_t> begin_;
  std::vector<std::uint32_t> tets_;
};

/// Calls visit(MeshFace) for every triangle whose smallest vertex is `vertex`, in ascending order.
template <class Visit>
void visit_faces_at(const MeshStars& stars, std::uint32_t vertex, std::vector<FaceSide>& scratch,
                    Visit&& visit) {
  stars.collect_sides(vertex, scratch);
  for (std::size_t begin = 0; begin < scratch.size();) {
    const std::uint64_t others = scratch[begin].others;
    std::size_t end = begin + 1;
    while (end < scratch.size() && scratch[end].others == others) ++end;
    visit(MeshFace{{vertex, static_cast<std::uint32_t>(others >> 32),
                    static_cast<std::uint32_t>(others & 0xffffffffU)},
                   std::span<const FaceSide>(scratch).subspan(begin, end - begin)});
    begin = end;
  }
}

/// Calls visit(MeshFace) for every triangle that the tile owns, in ascending order of its vertices.
template <class Visit>
void for_each_face(const MeshStars& stars, Visit&& visit) {
  std::vector<FaceSide> scratch;
  for (std::uint32_t v = 0; v < stars.vertex_count(); ++v) {
    if (stars.owns(v)) visit_faces_at(stars, v, scratch, visit);
  }
}

/// Visits every triangle with a vertex that the tile owns; the tile has all tets on it.
template <class Visit>
void visit_whole_faces(const MeshStars& stars, Visit&& visit) {
  std::vector<FaceSide> scratch;
  for (std::uint32_t v = 0; v < stars.vertex_count(); ++v) {
    visit_faces_at(stars, v, scratch, [&](const MeshFace& face) {
      const auto& [a, b, c] = face.vertices;
      if (stars.owns(a) || stars.owns(b) || stars.owns(c)) visit(face);
    });
  }
}

}  // namespace mw::audit
