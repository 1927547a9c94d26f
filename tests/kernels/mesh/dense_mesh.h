// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Meshes for kernel tests: start meshes of small volumes, disturbed, and seen by the oracle.
#pragma once

#include "kernels/mesh/tet_mesh.h"
#include "kernels/quality/quality.h"
#include "kernels/start/graded_start.h"
#include "tests/kernels/start/cells/level_maps.h"
#include "tests/oracle/cell_complex.h"
#include "tests/oracle/small_volumes.h"
#include "tests/testing.h"

namespace mw::test {

using audit::RegionBetti;
using audit::test::below;
using audit::test::betti_of;
using audit::test::complex_of;
using audit::test::random_kind;
using audit::test::random_shape;
using audit::test::random_volume;
using audit::test::random_volume_of;
using audit::test::SmallMesh;
using audit::test::SmallVolume;
using audit::test::volume_from;
using audit::test::VolumeKind;

/// The labels of a part of the volume; exterior where it reaches outside.
[[nodiscard]] inline LabelBox labels_in(const SmallVolume& volume, const Box3& box) {
  const Box3 all{{0, 0, 0}, volume.shape};
  LabelBox out{box, {}};
  for (Index3 v = box.lo; v.z < box.hi.z; ++v.z) {
    for (v.y = box.lo.y; v.y < box.hi.y; ++v.y) {
      for (v.x = box.lo.x; v.x < box.hi.x; ++v.x) {
        out.labels.push_back(
            all.contains(v) ? volume.labels[static_cast<std::size_t>(all.offset(v))] : kExterior);
      }
    }
  }
  return out;
}

[[nodiscard]] inline LevelMap level_map(const SmallVolume& volume) {
  return level_map(volume.shape, [&](const Box3& box) { return labels_in(volume, box); });
}

/// Start mesh of a part of the volume, its labels as they are.
[[nodiscard]] inline BlockMesh start_block(const SmallVolume& volume, const LevelMap& levels,
                                           const Box3& block, const StartOptions& options) {
  const Index3 halo{kStartHalo, kStartHalo, kStartHalo};
  const LabelBox labels = labels_in(volume, {block.lo - halo, block.hi + halo});
  return graded_start({.shape = labels, .original = labels}, levels, block, volume.shape, options);
}

/// Start mesh of a part of the volume: the paper's, five tets a voxel.
[[nodiscard]] inline BlockMesh dense_block(const SmallVolume& volume, const Box3& block,
                                           const StartOptions& options = {}) {
  return start_block(volume, LevelMap(), block, options);
}

/// Tets by ids, with the label.
using GlobalTets = std::multiset<std::pair<std::array<VertexId, 4>, Label>>;

inline void add_global(GlobalTets& out, const BlockMesh& block) {
  for (const BlockTet& t : block.tets) {
    std::array<VertexId, 4> ids{};
    for (std::size_t i = 0; i < 4; ++i) ids[i] = block.vertices[t.vertices[i]].id;
    out.insert({ids, t.label});
  }
}

[[nodiscard]] inline Point far_corner(Index3 shape) {
  return {static_cast<std::int32_t>(shape.x * kUnitsPerVoxel),
          static_cast<std::int32_t>(shape.y * kUnitsPerVoxel),
          static_cast<std::int32_t>(shape.z * kUnitsPerVoxel)};
}

/// Start mesh of the whole volume: every vertex is free.
[[nodiscard]] inline TetMesh dense_mesh(const SmallVolume& volume) {
  const BlockMesh block = dense_block(volume, {{0, 0, 0}, volume.shape});
  return {block.vertices, block.tets, far_corner(volume.shape)};
}

/// A window cut out of a larger volume.  ENSURES: some vertices are fixed.
[[nodiscard]] inline TetMesh dense_cutout(const SmallVolume& volume, const Box3& window) {
  const BlockMesh block = dense_block(volume, window);
  return {block.vertices, block.tets, far_corner(volume.shape)};
}

/// Signed six-fold volume of a tet.
[[nodiscard]] inline std::int64_t volume6_of(const TetMesh& mesh, const LocalTet& t) {
  return volume6(mesh.position(t.vertices[0]), mesh.position(t.vertices[1]),
                 mesh.position(t.vertices[2]), mesh.position(t.vertices[3]));
}

[[nodiscard]] inline bool has(const LocalTet& t, LocalVertex v) {
  return std::find(t.vertices.begin(), t.vertices.end(), v) != t.vertices.end();
}

/// The sum of six times the volumes of all tets.
[[nodiscard]] inline std::int64_t volume6_sum(const TetMesh& mesh) {
  std::int64_t sum = 0;
  for (const LocalTet& t : mesh.tets()) sum += volume6_of(mesh, t);
  return sum;
}

/// The least radius ratio of a mesh.
[[nodiscard]] inline double worst_ratio(const TetMesh& mesh, const Metric& metric) {
  double worst = 1.0;
  for (const LocalTet& t : mesh.tets()) worst = std::min(worst, radius_ratio(mesh, metric, t));
  return worst;
}

/// A point near the vertex, within its planes: up to `reach` units away along each axis.
[[nodiscard]] inline Point point_near(const TetMesh& mesh, LocalVertex v, std::mt19937& random,
                                      std::int32_t reach) {
  const unsigned fixed = fixed_axes(mesh.planes(v));
  const auto step = [&](unsigned axis) {
    const auto choices = static_cast<std::uint32_t>(2 * reach + 1);
    const std::int32_t d = static_cast<std::int32_t>(below(random, choices)) - reach;
    return (fixed >> axis & 1U) != 0 ? 0 : d;
  };
  Point x = mesh.position(v);
  x.x += step(0);
  x.y += step(1);
  x.z += step(2);
  return x;
}

/// Whether the tets around the vertex are positive when it is there.
[[nodiscard]] inline bool is_positive_at(const TetMesh& mesh, LocalVertex v, const Point& x) {
  for (const LinkTriangle& t : mesh.star(v)) {
    if (t.label == kExterior) continue;
    if (volume6(x, mesh.position(t.a), mesh.position(t.b), mesh.position(t.c)) <= 0) return false;
  }
  return true;
}

/// Moves free vertices about at random, within their planes, tets staying positive.
inline void disturb(TetMesh& mesh, std::mt19937& random) {
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v) || !mesh.is_free(v)) continue;
    const Point x = point_near(mesh, v, random, 400);
    if (is_positive_at(mesh, v, x)) mesh.move(v, x, mesh.quadric(v));
  }
}

/// The mesh as the oracle reads it; rows are local vertices.
[[nodiscard]] inline SmallMesh small_mesh(const TetMesh& mesh, const std::vector<LocalTet>& tets) {
  SmallMesh out;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    const Point p = mesh.position(v);
    out.vertices.push_back(
        {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
  }
  for (const LocalTet& t : tets) {
    out.tets.push_back({t.vertices[0], t.vertices[1], t.vertices[2], t.vertices[3]});
    out.labels.push_back(t.label);
  }
  return out;
}

/// Betti numbers by ranks, closed and open, of all labels and the exterior.
[[nodiscard]] inline std::vector<RegionBetti> betti(const TetMesh& mesh,
                                                    const std::vector<LocalTet>& tets,
                                                    std::size_t label_count) {
  return betti_of(complex_of(small_mesh(mesh, tets).view(), label_count), label_count);
}
[[nodiscard]] inline std::vector<RegionBetti> betti(const TetMesh& mesh, std::size_t label_count) {
  return betti(mesh, mesh.tets(), label_count);
}
[[nodiscard]] inline std::vector<RegionBetti> betti(const SmallVolume& volume) {
  return betti_of(complex_of(volume.view(), volume.label_count), volume.label_count);
}

/// A tet whatever the order in which its vertices are named.
struct TetKey {
  std::array<LocalVertex, 4> vertices{};  ///< ascending
  bool odd = false;                       ///< orientation relative to ascending order
  Label label = 0;

  friend auto operator<=>(const TetKey&, const TetKey&) = default;
};

[[nodiscard]] inline TetKey tet_key(const LocalTet& t) {
  TetKey key{t.vertices, false, t.label};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      if (t.vertices[i] > t.vertices[j]) key.odd = !key.odd;
    }
  }
  std::sort(key.vertices.begin(), key.vertices.end());
  return key;
}

/// The tet with its vertices in an order of positive orientation.
[[nodiscard]] inline LocalTet positive(const TetKey& key) {
  LocalTet t{key.vertices, key.label};
  if (key.odd) std::swap(t.vertices[0], t.vertices[1]);
  return t;
}

/// Every tet that some star knows, virtual ones included, and in how many stars it is.
[[nodiscard]] inline std::map<TetKey, int> tets_by_stars(const TetMesh& mesh) {
  std::map<TetKey, int> out;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    for (const LinkTriangle& t : mesh.star(v)) ++out[tet_key({{v, t.a, t.b, t.c}, t.label})];
  }
  return out;
}

/// Tets after contracting (keep, drop), from the list alone.
[[nodiscard]] inline std::vector<LocalTet> contracted(std::vector<LocalTet> tets, LocalVertex keep,
                                                      LocalVertex drop) {
  std::erase_if(tets, [&](const LocalTet& t) { return has(t, keep) && has(t, drop); });
  for (LocalTet& t : tets) std::replace(t.vertices.begin(), t.vertices.end(), drop, keep);
  return tets;
}

/// A random edge of the mesh with both ends free, or (0, 0) when the pick found none.
[[nodiscard]] inline std::pair<LocalVertex, LocalVertex> random_edge(const TetMesh& mesh,
                                                                     std::mt19937& random) {
  const LocalVertex p = below(random, mesh.vertex_count());
  const auto star = mesh.star(p);
  if (star.empty() || !mesh.is_free(p)) return {0, 0};
  const LinkTriangle t = star[below(random, static_cast<std::uint32_t>(star.size()))];
  const std::array<LocalVertex, 3> link{t.a, t.b, t.c};
  const LocalVertex q = link[below(random, 3)];
  if (q == mesh.infinity() || !mesh.is_free(q)) return {0, 0};
  return {p, q};
}

/// Where edge (p, q) can go without leaving the box's planes: at 0 the end p, 1 q, 2 the middle.
[[nodiscard]] inline std::optional<Point> contraction_target(const TetMesh& mesh, LocalVertex p,
                                                             LocalVertex q, std::uint32_t at) {
  const unsigned planes_p = mesh.planes(p), planes_q = mesh.planes(q);
  const unsigned both = planes_p & planes_q;
  const Point a = mesh.position(p), b = mesh.position(q);
  if (at == 0) return both == planes_q ? std::optional(a) : std::nullopt;
  if (at == 1) return both == planes_p ? std::optional(b) : std::nullopt;
  if (planes_p != planes_q) return std::nullopt;
  return Point{(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
}

/// Exact: all tets that survive contracting (p, q) to x are positive.
[[nodiscard]] inline bool stays_positive(const TetMesh& mesh, LocalVertex p, LocalVertex q,
                                         Point x) {
  const auto positive_around = [&](LocalVertex v, LocalVertex other) {
    const auto star = mesh.star(v);
    return std::all_of(star.begin(), star.end(), [&](const LinkTriangle& t) {
      return t.label == kExterior || t.has(other) ||
             volume6(x, mesh.position(t.a), mesh.position(t.b), mesh.position(t.c)) > 0;
    });
  };
  return positive_around(p, q) && positive_around(q, p);
}

}  // namespace mw::test
