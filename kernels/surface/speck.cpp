// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Follows a part of a label from tet to tet.
#include "kernels/surface/speck.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "kernels/surface/thin_label.h"

namespace mw {
namespace {

/// The most voxels of a speck (bench/parameters.md, "Thin labels").
constexpr int kMostVoxels = 3;

bool has(const LocalTet& tet, LocalVertex v) {
  return std::find(tet.vertices.begin(), tet.vertices.end(), v) != tet.vertices.end();
}

bool is_same(const LocalTet& a, const LocalTet& b) {
  return std::all_of(a.vertices.begin(), a.vertices.end(),
                     [&](LocalVertex v) { return has(b, v); });
}

/// Returns the tet on the other side of the face across from corner i, if it is loaded.
std::optional<LocalTet> neighbour(const TetMesh& mesh, const LocalTet& tet, int i) {
  const LinkTriangle face = link_triangle(tet, i);
  const LocalVertex across = tet.vertices[static_cast<std::size_t>(i)];
  for (const LinkTriangle& t : mesh.star(face.a)) {
    if (!t.has(face.b) || !t.has(face.c) || t.has(across)) continue;
    return LocalTet{{face.a, t.a, t.b, t.c}, without_side(t.label)};
  }
  return std::nullopt;
}

Point middle_of(const TetMesh& mesh, std::span<const LocalTet> tets) {
  std::array<std::int64_t, 3> sum{};
  for (const LocalTet& tet : tets) {
    for (const LocalVertex v : tet.vertices) {
      const Point p = mesh.position(v);
      sum[0] += p.x;
      sum[1] += p.y;
      sum[2] += p.z;
    }
  }
  const auto mean = [&](std::int64_t total) {
    return static_cast<std::int32_t>(total / static_cast<std::int64_t>(4 * tets.size()));
  };
  return {mean(sum[0]), mean(sum[1]), mean(sum[2])};
}

}  // namespace

std::span<const SpeckVolume> SpeckMeasure::at(const TetMesh& mesh, const Metric& metric,
                                              LocalVertex v, Label label, const LabelBox& labels) {
  found_.clear();
  seen_.clear();
  for (const LinkTriangle& t : mesh.star(v)) {
    if (without_side(t.label) != label) continue;
    const LocalTet first{{v, t.a, t.b, t.c}, label};
    const auto is_first = [&](const LocalTet& known) { return is_same(known, first); };
    if (std::any_of(seen_.begin(), seen_.end(), is_first)) continue;
    if (!collect_part(mesh, first)) break;
    seen_.insert(seen_.end(), part_.begin(), part_.end());
    if (const auto speck = measure(mesh, metric, v, labels)) found_.push_back(*speck);
  }
  return found_;
}

/// Returns whether the part is of a few tets.  Where the next tet is not loaded the part ends:
/// nearly all such parts are a single tet, and a window that loads more of it puts the rest right.
bool SpeckMeasure::collect_part(const TetMesh& mesh, const LocalTet& first) {
  constexpr std::size_t kMostTets = 24;
  part_.assign(1, first);
  for (std::size_t i = 0; i < part_.size(); ++i) {
    for (int corner = 0; corner < 4; ++corner) {
      const std::optional<LocalTet> next = neighbour(mesh, part_[i], corner);
      if (!next || next->label != first.label) continue;
      const auto is_next = [&](const LocalTet& known) { return is_same(known, *next); };
      if (std::any_of(part_.begin(), part_.end(), is_next)) continue;
      if (part_.size() == kMostTets) return false;
      part_.push_back(*next);
    }
  }
  return true;
}

std::optional<SpeckVolume> SpeckMeasure::measure(const TetMesh& mesh, const Metric& metric,
                                                 LocalVertex v, const LabelBox& labels) const {
  const Point at = mesh.position(v);
  const int voxels = voxels_of_part(labels, middle_of(mesh, part_), part_.front().label);
  if (voxels == 0 || voxels > kMostVoxels) return std::nullopt;
  const double target6 = 6.0 * voxels * metric.voxel().prod();
  SpeckVolume out{.share = 0.0};
  for (const LocalTet& tet : part_) {
    const auto& [p, q, r, s] = tet.vertices;
    const std::int64_t own =
        volume6(mesh.position(p), mesh.position(q), mesh.position(r), mesh.position(s));
    out.share += static_cast<double>(own) * metric.unit().prod() / target6;
    const auto corner = std::find(tet.vertices.begin(), tet.vertices.end(), v);
    if (corner == tet.vertices.end()) continue;
    const LinkTriangle t = link_triangle(tet, static_cast<int>(corner - tet.vertices.begin()));
    const Vec3 a = metric.vector(at, mesh.position(t.a));
    out.slope -= (metric.vector(at, mesh.position(t.b)) - a)
                     .cross(metric.vector(at, mesh.position(t.c)) - a) /
                 target6;
  }
  return out;
}

}  // namespace mw
