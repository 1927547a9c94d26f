// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// New rows ascend by id.
#include "kernels/odt/rebuild.h"

#include <algorithm>
#include <numeric>

namespace mw {
namespace {

/// Vertices in use ascending by id, and the new row of each old one.
struct NewRows {
  std::vector<BlockVertex> vertices;
  std::vector<LocalVertex> row;
};

NewRows new_rows(const TetMesh& mesh, std::span<const LocalTet> tets,
                 std::span<const BlockVertex> added) {
  const LocalVertex old_count = mesh.vertex_count();
  std::vector<std::uint8_t> used(old_count + added.size(), 0);
  for (const LocalTet& t : tets) {
    for (LocalVertex v : t.vertices) used[v] = 1;
  }
  const auto vertex = [&](LocalVertex v) {
    return v < old_count ? mesh.vertex(v) : added[v - old_count];
  };
  std::vector<LocalVertex> order;
  for (LocalVertex v = 0; v < used.size(); ++v) {
    if (used[v] != 0) order.push_back(v);
  }
  const auto id = [&](LocalVertex v) {
    return v < old_count ? mesh.id(v) : added[v - old_count].id;
  };
  std::sort(order.begin(), order.end(),
            [&](LocalVertex a, LocalVertex b) { return id(a) < id(b); });
  NewRows out;
  out.row.resize(used.size());
  for (LocalVertex v : order) {
    out.row[v] = static_cast<LocalVertex>(out.vertices.size());
    out.vertices.push_back(vertex(v));
  }
  return out;
}

CarriedSamples moved_samples(const CarriedSamples& samples, std::span<const LocalTet> tets,
                             const std::vector<LocalVertex>& row) {
  CarriedSamples out;
  if (samples.empty()) return out;
  for (const LocalTet& t : tets) {
    for (int corner = 0; corner < 4; ++corner) {
      const LinkTriangle f = link_triangle(t, corner);
      const TriangleKey key = triangle_key(f.a, f.b, f.c);
      const Label side = without_side(t.label);
      if (!samples.has(key, side)) continue;
      const TriangleKey moved = triangle_key(row[f.a], row[f.b], row[f.c]);
      for (const FaceSamples s : samples.of(key)) out.add(moved, side, s);
    }
  }
  return out;
}

}  // namespace

void rebuild(TetMesh& mesh, CarriedSamples& samples, std::span<const LocalTet> tets,
             std::span<const BlockVertex> added, Point box) {
  const NewRows rows = new_rows(mesh, tets, added);
  samples = moved_samples(samples, tets, rows.row);
  std::vector<BlockTet> sorted;
  sorted.reserve(tets.size());
  for (const LocalTet& t : tets) {
    BlockTet tet{t.vertices, t.label};
    for (std::uint32_t& v : tet.vertices) v = rows.row[v];
    std::sort(tet.vertices.begin(), tet.vertices.end());
    sorted.push_back(tet);
  }
  std::sort(sorted.begin(), sorted.end());
  mesh = TetMesh(rows.vertices, sorted, box, mesh.inner_planes());
}

}  // namespace mw
