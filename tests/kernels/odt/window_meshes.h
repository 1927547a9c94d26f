// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Windows for tests of constrained ODT, other triangulations of them, and a judge by brute force.
#pragma once

#include "kernels/odt/window_plc.h"
#include "kernels/optimise/flips.h"
#include "kernels/simplify/simplify.h"
#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {

/// A volume of any kind, and a part of it (or all) as a mesh, simplified or not, disturbed.
/// ENSURES: all vertices alive.
struct WindowCase {
  SmallVolume volume;
  Metric metric;
  TetMesh mesh;
};

[[nodiscard]] inline TetMesh without_dead_vertices(const TetMesh& mesh, Point box) {
  std::vector<BlockVertex> vertices;
  std::vector<std::uint32_t> row(mesh.vertex_count());
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    row[v] = static_cast<std::uint32_t>(vertices.size());
    if (mesh.is_alive(v)) vertices.push_back(mesh.vertex(v));
  }
  std::vector<BlockTet> tets = mesh.sorted_tets();
  for (BlockTet& t : tets) {
    for (std::uint32_t& v : t.vertices) v = row[v];
  }
  return {vertices, tets, box};
}

[[nodiscard]] inline WindowCase random_window(std::mt19937& random) {
  const auto kind = static_cast<VolumeKind>(below(random, audit::test::kVolumeKinds));
  SmallVolume volume = random_volume_of(random, kind, {5, 5, 5}, 1 + below(random, 4));
  const Metric metric = below(random, 3) == 0 ? Metric({1.0, 1.0, 2.5}) : Metric();
  const bool whole = below(random, 2) == 0;
  TetMesh mesh = whole ? dense_mesh(volume) : dense_cutout(volume, {{1, 0, 1}, {5, 4, 5}});
  if (below(random, 3) != 0) simplify(mesh, metric, {.quality_floor = 0.05});
  disturb(mesh, random);
  mesh = without_dead_vertices(mesh, far_corner(volume.shape));
  return {std::move(volume), metric, std::move(mesh)};
}

/// Flips about `tries` random edges inside labels, or only such on interfaces.
inline int flip_some(TetMesh& mesh, const Metric& metric, std::mt19937& random, int tries,
                     bool inside = true) {
  Flipper flipper(mesh, metric, 0.0);
  EdgeRing ring;
  int flips = 0;
  for (int i = 0; i < tries; ++i) {
    const auto [p, q] = random_edge(mesh, random);
    if (p == q || !collect_ring(mesh, p, q, ring)) continue;
    const bool one_label =
        std::ranges::all_of(ring.labels, [&](Label l) { return l == ring.labels[0]; });
    const bool on_box = std::ranges::count(ring.labels, kExterior) != 0;
    if (one_label != inside || on_box) continue;
    flips += flipper.remove_edge(p, q) ? 1 : 0;
  }
  return flips;
}

/// Each triangle by ascending vertices, with the labels of its tets; two on a side are two entries.
using FaceLabels = std::map<std::array<LocalVertex, 3>, std::vector<std::pair<int, Label>>>;

/// Side by the sign of the volume that the fourth vertex spans with the ascending triangle.
inline FaceLabels face_labels(const std::vector<LocalTet>& tets, const std::vector<Point>& at) {
  FaceLabels out;
  for (const LocalTet& t : tets) {
    for (std::size_t apex = 0; apex < 4; ++apex) {
      std::array<LocalVertex, 3> f{};
      std::size_t n = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        if (i != apex) f[n++] = t.vertices[i];
      }
      std::sort(f.begin(), f.end());
      const auto side = volume6(at[f[0]], at[f[1]], at[f[2]], at[t.vertices[apex]]);
      out[f].push_back({side > 0 ? 1 : -1, t.label});
    }
  }
  for (auto& [face, sides] : out) std::sort(sides.begin(), sides.end());
  return out;
}

/// Triangles of the hull and between labels.
inline FaceLabels borders(const FaceLabels& faces) {
  FaceLabels out;
  for (const auto& [face, sides] : faces) {
    if (sides.size() == 1 || sides[0].second != sides[1].second) out[face] = sides;
  }
  return out;
}

inline std::map<Label, std::int64_t> label_volumes(const std::vector<LocalTet>& tets,
                                                   const std::vector<Point>& at) {
  std::map<Label, std::int64_t> out;
  for (const LocalTet& t : tets) {
    const auto& v = t.vertices;
    out[t.label] += volume6(at[v[0]], at[v[1]], at[v[2]], at[v[3]]);
  }
  return out;
}

[[nodiscard]] inline std::vector<Point> positions(const TetMesh& mesh) {
  std::vector<Point> out;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) out.push_back(mesh.position(v));
  return out;
}

/// The tets partition what the mesh's tets do, with the same hull and the same interfaces.
inline void expect_same_regions(const std::vector<LocalTet>& tets, const TetMesh& mesh,
                                std::vector<Point> added = {}) {
  std::vector<Point> at = positions(mesh);
  at.insert(at.end(), added.begin(), added.end());
  for (const LocalTet& t : tets) {
    const auto& v = t.vertices;
    ASSERT_GT(volume6(at[v[0]], at[v[1]], at[v[2]], at[v[3]]), 0);
  }
  const FaceLabels faces = face_labels(tets, at), before = face_labels(mesh.tets(), at);
  for (const auto& [face, sides] : faces) {
    ASSERT_LE(sides.size(), 2U);
    ASSERT_TRUE(sides.size() == 1 || sides[0].first != sides[1].first);
  }
  EXPECT_TRUE(borders(faces) == borders(before));
  EXPECT_TRUE(label_volumes(tets, at) == label_volumes(mesh.tets(), at));
}

[[nodiscard]] inline std::multiset<TetKey> tet_keys(const std::vector<LocalTet>& tets) {
  std::multiset<TetKey> out;
  for (const LocalTet& t : tets) out.insert(tet_key(t));
  return out;
}

/// The tets of another mesh of the same regions, as a triangulator would answer.
[[nodiscard]] inline Triangulation as_triangulation(const WindowPlc& asked, const TetMesh& mesh,
                                                    const TetMesh& other) {
  const std::vector<Point> at = positions(mesh);
  std::map<std::pair<std::array<LocalVertex, 3>, int>, std::uint32_t> region_at;
  const auto each_face = [&](const LocalTet& t, auto visit) {
    for (const auto& [face, sides] : face_labels({t}, at)) visit(std::pair{face, sides[0].first});
  };
  for (std::size_t t = 0; t < asked.content.tets.size(); ++t) {
    each_face(asked.content.tets[t],
              [&](const auto& face) { region_at[face] = asked.content.regions[t]; });
  }
  const WindowPlc theirs = window_plc(other, Metric());
  const std::set<std::array<LocalVertex, 3>> facets(theirs.plc.facets.begin(),
                                                    theirs.plc.facets.end());
  std::map<std::uint32_t, std::uint32_t> ours_of;
  for (std::size_t t = 0; t < theirs.content.tets.size(); ++t) {
    each_face(theirs.content.tets[t], [&](const auto& face) {
      if (facets.contains(face.first) && region_at.contains(face)) {
        ours_of[theirs.content.regions[t]] = region_at.at(face);
      }
    });
  }
  Triangulation out;
  for (std::size_t t = 0; t < theirs.content.tets.size(); ++t) {
    out.tets.push_back(theirs.content.tets[t].vertices);
    out.regions.push_back(ours_of[theirs.content.regions[t]]);
  }
  return out;
}

}  // namespace mw::test
