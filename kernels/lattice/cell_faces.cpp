// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Squares cut along even diagonals, quartered beside smaller cells, or fanned from a hanging node.
#include "kernels/lattice/cell_faces.h"

#include <optional>
#include <tuple>

namespace mw {
namespace {

struct Plane {
  Index3 origin;  ///< lowest corner of the face
  unsigned first = 0;
  unsigned second = 0;
};

Plane plane_of(const Cell& cell, CellFace face) {
  const Index3 origin = cell.lo + axis_vector(face.axis, face.high ? cell.size() : 0);
  return {origin, face.axis == 0 ? 1U : 0U, face.axis == 2 ? 1U : 2U};
}

/// Two triangles of a square of 2^level, joined along the diagonal of its even corners.
void cut_square(const Plane& p, Index3 lo, int level, std::vector<CornerTriangle>& out) {
  const std::int64_t s = std::int64_t{1} << level;
  const Index3 u = axis_vector(p.first, s), v = axis_vector(p.second, s);
  const Index3 a = lo, b = lo + u, c = lo + u + v, d = lo + v;
  if (is_odd(a, level)) {
    out.push_back({a, b, d});
    out.push_back({c, b, d});
  } else {
    out.push_back({b, a, c});
    out.push_back({d, a, c});
  }
}

bool id_less(Index3 a, Index3 b) {
  return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
}

}  // namespace

bool CellFaces::is_finer(Index3 voxel, int level) const {
  return Box3{{0, 0, 0}, volume_}.contains(voxel) && levels_.level_at(voxel) < level;
}

bool CellFaces::face_is_split(const Cell& cell, CellFace face) const {
  return is_finer(cell.lo + axis_vector(face.axis, face.high ? cell.size() : -1), cell.level);
}

bool CellFaces::edge_is_split(const Cell& cell, unsigned along, Index3 start) const {
  const unsigned first = along == 0 ? 1U : 0U, second = along == 2 ? 1U : 2U;
  for (std::int64_t i = -1; i < 1; ++i) {
    for (std::int64_t j = -1; j < 1; ++j) {
      if (is_finer(start + axis_vector(first, i) + axis_vector(second, j), cell.level)) {
        return true;
      }
    }
  }
  return false;
}

bool CellFaces::has_hanging_nodes(const Cell& cell) const {
  if (cell.level == 0) return false;
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (face_is_split(cell, {axis, false}) || face_is_split(cell, {axis, true})) return true;
    for (unsigned i = 0; i < 8; ++i) {
      if ((i >> axis & 1U) == 0 && edge_is_split(cell, axis, cell_corner(cell, i))) return true;
    }
  }
  return false;
}

void CellFaces::triangles(const Cell& cell, CellFace face, std::vector<CornerTriangle>& out) const {
  out.clear();
  const Plane p = plane_of(cell, face);
  const std::int64_t s = cell.size();
  if (cell.level > 0 && face_is_split(cell, face)) {
    for (std::int64_t i = 0; i < 2; ++i) {
      for (std::int64_t j = 0; j < 2; ++j) {
        cut_square(p, p.origin + axis_vector(p.first, i * s / 2) + axis_vector(p.second, j * s / 2),
                   cell.level - 1, out);
      }
    }
    return;
  }
  const Index3 u = axis_vector(p.first, s), v = axis_vector(p.second, s);
  const std::array<Index3, 4> corner{p.origin, p.origin + u, p.origin + u + v, p.origin + v};
  std::array<Index3, 8> rim;
  std::size_t rims = 0;
  std::optional<Index3> hub;
  for (std::size_t i = 0; i < 4; ++i) {
    rim[rims++] = corner[i];
    const unsigned along = i % 2 == 0 ? p.first : p.second;
    const Index3 start = id_less(corner[i], corner[(i + 1) % 4]) ? corner[i] : corner[(i + 1) % 4];
    if (cell.level == 0 || !edge_is_split(cell, along, start)) continue;
    const Index3 hanging = start + axis_vector(along, s / 2);
    rim[rims++] = hanging;
    if (!hub || id_less(hanging, *hub)) hub = hanging;
  }
  if (!hub) return cut_square(p, p.origin, cell.level, out);
  for (std::size_t i = 0; i < rims; ++i) {
    const Index3 a = rim[i], b = rim[(i + 1) % rims];
    if (a != *hub && b != *hub) out.push_back({*hub, a, b});
  }
}

}  // namespace mw
