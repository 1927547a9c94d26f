// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Vertex stars by counting, triangles by sorting inside a star.
#include "kernels/audit/mesh_stars.h"

#include <algorithm>
#include <limits>
#include <string>

#include "kernels/core/error.h"

namespace mw::audit {
namespace {

void require_sound(const AuditMesh& mesh) {
  if (mesh.tets.size() != mesh.labels.size()) {
    throw Error(ErrorKind::kInput, "audit: the mesh has " + std::to_string(mesh.tets.size()) +
                                       " tets but " + std::to_string(mesh.labels.size()) +
                                       " labels");
  }
  if (mesh.tets.size() > std::size_t{1} << 31 ||
      mesh.vertices.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorKind::kResource, "audit: more than 2^31 tets or 2^32 vertices; audit parts");
  }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (const std::uint64_t v : mesh.tets[t]) {
      if (v < mesh.vertices.size()) continue;
      throw Error(ErrorKind::kInput, "audit: tet " + std::to_string(t) + " names vertex " +
                                         std::to_string(v) + " of " +
                                         std::to_string(mesh.vertices.size()));
    }
  }
}

/// True for an odd permutation of 0 .. 3.
constexpr bool is_odd(const std::array<unsigned, 4>& order) {
  unsigned inversions = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = i + 1; k < 4; ++k) inversions += order[i] > order[k] ? 1U : 0U;
  }
  return inversions % 2 != 0;
}

/// is_odd() of the orders (6 - at - i - k, at, i, k), by 16 at + 4 i + k.
constexpr std::array<bool, 64> kIsOdd = [] {
  std::array<bool, 64> out{};
  for (unsigned place = 0; place < out.size(); ++place) {
    const unsigned at = place / 16, i = place / 4 % 4, k = place % 4;
    if (at != i && at != k && i != k) out[place] = is_odd({6 - at - i - k, at, i, k});
  }
  return out;
}();

/// The side of the triangle (vertex, tet[i], tet[k]), where vertex = tet[at].
FaceSide side_of(const TetRow& tet, std::uint32_t id, unsigned at, unsigned i, unsigned k) {
  if (tet[i] > tet[k]) std::swap(i, k);
  return {tet[i] << 32 | tet[k], id, kIsOdd[16 * at + 4 * i + k]};
}

}  // namespace

unsigned apex_of(const TetRow& tet, const std::array<std::uint32_t, 3>& triangle) {
  const auto apex = std::find_if(tet.begin(), tet.end(), [&](std::uint64_t v) {
    return std::find(triangle.begin(), triangle.end(), v) == triangle.end();
  });
  return static_cast<unsigned>(apex - tet.begin());
}

bool MeshStars::leaves_out(std::size_t tet) const {
  const TetRow& t = mesh().tets[tet];
  return t[0] == t[1] || t[0] == t[2] || t[0] == t[3] || t[1] == t[2] || t[1] == t[3] ||
         t[2] == t[3];
}

MeshStars::MeshStars(const MeshTile& tile) : tile_(tile) {
  const AuditMesh& mesh = tile.mesh;
  require_sound(mesh);
  begin_.assign(mesh.vertices.size() + 1, 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (leaves_out(t)) continue;
    for (const std::uint64_t v : mesh.tets[t]) ++begin_[v + 1];
  }
  for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
  tets_.resize(begin_.back());
  std::vector<std::uint64_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (leaves_out(t)) continue;
    for (const std::uint64_t v : mesh.tets[t]) tets_[next[v]++] = static_cast<std::uint32_t>(t);
  }
}

void MeshStars::collect_sides(std::uint32_t vertex, std::vector<FaceSide>& sides) const {
  sides.clear();
  for (const std::uint32_t id : star(vertex)) {
    const TetRow& tet = mesh().tets[id];
    std::array<unsigned, 3> larger{};
    unsigned count = 0;
    unsigned at = 0;
    for (unsigned i = 0; i < 4; ++i) {
      if (tet[i] == vertex) at = i;
      if (tet[i] > vertex) larger[count++] = i;
    }
    if (count < 2) continue;
    sides.push_back(side_of(tet, id, at, larger[0], larger[1]));
    if (count < 3) continue;
    sides.push_back(side_of(tet, id, at, larger[0], larger[2]));
    sides.push_back(side_of(tet, id, at, larger[1], larger[2]));
  }
  // A tet has a triangle once.
  std::sort(sides.begin(), sides.end(), [](const FaceSide& a, const FaceSide& b) {
    return a.others != b.others ? a.others < b.others : a.tet < b.tet;
  });
}

}  // namespace mw::audit
