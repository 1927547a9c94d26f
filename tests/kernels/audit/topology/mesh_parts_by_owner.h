// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A small mesh taken apart into tiles, whatever vertices those own.
#pragma once

#include "tests/oracle/small_volumes.h"

namespace mw::audit::test {

/// One tile's arrays.
struct OwnedPart {
  SmallMesh mesh;
  std::vector<std::uint64_t> vertex_ids;
  std::vector<std::uint64_t> tet_ids;
  std::vector<std::uint8_t> owned;

  [[nodiscard]] MeshTile view() const { return {mesh.view(), vertex_ids, tet_ids, owned}; }
};

/// All tets with a vertex of that owner.  owner: by vertex.
inline OwnedPart part_of_owner(const SmallMesh& mesh, const std::vector<std::uint32_t>& owner,
                               std::uint32_t tile) {
  OwnedPart out;
  std::vector<std::uint64_t> row(mesh.vertices.size());
  const auto is_there = [&](const TetRow& tet) {
    return std::any_of(tet.begin(), tet.end(), [&](auto v) { return owner[v] == tile; });
  };
  std::vector<bool> is_used(mesh.vertices.size());
  for (const TetRow& tet : mesh.tets) {
    for (const std::uint64_t v : tet) is_used[v] = is_used[v] || is_there(tet);
  }
  for (std::uint64_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!is_used[v]) continue;
    row[v] = out.vertex_ids.size();
    out.vertex_ids.push_back(v);
    out.mesh.vertices.push_back(mesh.vertices[v]);
    out.owned.push_back(owner[v] == tile ? 1 : 0);
  }
  for (std::uint64_t t = 0; t < mesh.tets.size(); ++t) {
    const TetRow& tet = mesh.tets[t];
    if (!is_there(tet)) continue;
    out.tet_ids.push_back(t);
    out.mesh.tets.push_back({row[tet[0]], row[tet[1]], row[tet[2]], row[tet[3]]});
    out.mesh.labels.push_back(mesh.labels[t]);
  }
  return out;
}

/// Each vertex is anyone's: tiles in shreds.
inline std::vector<std::uint32_t> random_owners(std::mt19937& random, std::size_t vertices,
                                                std::uint32_t tiles) {
  std::vector<std::uint32_t> out;
  for (std::size_t v = 0; v < vertices; ++v) {
    const bool again = v > 0 && below(random, 3) == 0;
    out.push_back(again ? out.back() : below(random, tiles));
  }
  return out;
}

}  // namespace mw::audit::test
