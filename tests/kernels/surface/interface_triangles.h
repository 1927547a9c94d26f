// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Interfaces by maps of all tets, and meshes with samples, for tests of surfaces and distances.
#pragma once

#include <Eigen/Geometry>

#include "kernels/distance/distance_guard.h"
#include "kernels/surface/surface_star.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {

/// A triangle between labels low < high; the normal of its corners points to high.
struct InterfaceTriangle {
  std::array<LocalVertex, 3> corners{};  ///< the smallest first
  Label low = 0;
  Label high = 0;

  friend auto operator<=>(const InterfaceTriangle&, const InterfaceTriangle&) = default;

  [[nodiscard]] bool has(LocalVertex v) const {
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  }
  [[nodiscard]] TriangleKey key() const { return triangle_key(corners[0], corners[1], corners[2]); }
  [[nodiscard]] Vec3 normal(const TetMesh& mesh, const Metric& metric) const {
    const Point p = mesh.position(corners[0]);
    return metric.vector(p, mesh.position(corners[1]))
        .cross(metric.vector(p, mesh.position(corners[2])));
  }
  /// Does it run through its edge from a to b?
  [[nodiscard]] bool runs(LocalVertex a, LocalVertex b) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (corners[i] == a && corners[(i + 1) % 3] == b) return true;
    }
    return false;
  }
};

/// All of the mesh, by the tets on both sides.
[[nodiscard]] inline std::set<InterfaceTriangle> interface_triangles(const TetMesh& mesh) {
  std::map<TriangleKey, std::map<Label, LocalVertex>> sides;
  for (const LocalTet& t : mesh.tets()) {
    for (int i = 0; i < 4; ++i) {
      const LinkTriangle f = link_triangle(t, i);
      sides[triangle_key(f.a, f.b, f.c)][t.label] = t.vertices[static_cast<std::size_t>(i)];
    }
  }
  std::set<InterfaceTriangle> out;
  for (const auto& [key, apexes] : sides) {
    if (apexes.size() < 2) continue;
    const auto& [high, apex] = *apexes.rbegin();
    auto [a, b, c] = key;
    const bool faces_high =
        volume6(mesh.position(a), mesh.position(b), mesh.position(c), mesh.position(apex)) > 0;
    if (!faces_high) std::swap(b, c);
    out.insert({{a, b, c}, apexes.begin()->first, high});
  }
  return out;
}

/// An edge, smaller end first, where exactly two triangles of a pair of labels meet that run
/// through it in opposite ways.
struct InterfaceEdge {
  std::array<LocalVertex, 2> ends{};
  std::array<InterfaceTriangle, 2> triangles;

  [[nodiscard]] bool has(LocalVertex v) const { return ends[0] == v || ends[1] == v; }
  [[nodiscard]] double bend(const TetMesh& mesh, const Metric& metric) const {
    return bend_energy(
        cosine_between(triangles[0].normal(mesh, metric), triangles[1].normal(mesh, metric)));
  }
};

[[nodiscard]] inline std::vector<InterfaceEdge> interface_edges(
    const std::set<InterfaceTriangle>& triangles) {
  std::map<std::array<LocalVertex, 4>, std::vector<InterfaceTriangle>> at;
  for (const InterfaceTriangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(t.corners[i], t.corners[(i + 1) % 3]);
      at[{a, b, t.low, t.high}].push_back(t);
    }
  }
  std::vector<InterfaceEdge> out;
  for (const auto& [key, found] : at) {
    if (found.size() != 2 || found[0].runs(key[0], key[1]) == found[1].runs(key[0], key[1])) {
      continue;
    }
    out.push_back({{key[0], key[1]}, {found[0], found[1]}});
  }
  return out;
}

/// The sum of bend energies of all interface edges.
[[nodiscard]] inline double all_bends(const TetMesh& mesh, const Metric& metric) {
  double sum = 0.0;
  for (const InterfaceEdge& e : interface_edges(interface_triangles(mesh))) {
    sum += e.bend(mesh, metric);
  }
  return sum;
}

/// The sum of bends over the edges of all interface triangles at v.
[[nodiscard]] inline double bends_around(const TetMesh& mesh, const Metric& metric, LocalVertex v) {
  double sum = 0.0;
  for (const InterfaceEdge& e : interface_edges(interface_triangles(mesh))) {
    if (e.triangles[0].has(v) || e.triangles[1].has(v)) sum += e.bend(mesh, metric);
  }
  return sum;
}

/// The start mesh of a volume with its samples.
struct GuardedMesh {
  GuardedMesh(const SmallVolume& volume, double bound)
      : GuardedMesh(dense_block(volume, {{0, 0, 0}, volume.shape},
                                {.with_samples = true, .max_distance = bound}),
                    volume, bound) {}
  GuardedMesh(const GuardedMesh&) = delete;
  GuardedMesh& operator=(const GuardedMesh&) = delete;

  LabelBox labels;
  TetMesh mesh;
  CarriedSamples samples;
  DistanceGuard guard;

 private:
  GuardedMesh(const BlockMesh& block, const SmallVolume& volume, double bound)
      : labels(labels_in(volume,
                         grown({{0, 0, 0}, volume.shape}, LabelReach::search_reach(bound) + 1))),
        mesh(block.vertices, block.tets, far_corner(volume.shape)),
        guard(labels, bound, samples) {
    for (const BlockSample& s : block.samples) samples.add(s.triangle, s.side, s.samples);
  }
};

}  // namespace mw::test
