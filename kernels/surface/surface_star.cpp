// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds pairs of triangles by comparing all of them, as most stars have a dozen at most.
#include "kernels/surface/surface_star.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace mw {
namespace {

/// The curvature where it cannot be told.
constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// How many bits are set in 0 to 15.  (Counting takes a function call on the baseline processor.)
constexpr std::array<std::uint8_t, 1U << kLanes> kBitCounts{0, 1, 1, 2, 1, 2, 2, 3,
                                                            1, 2, 2, 3, 2, 3, 3, 4};

double curvature_of(const SurfaceStar& star, double most) {
  Vec3 volume_gradient = Vec3::Zero(), area_gradient = Vec3::Zero();
  for (const SurfaceTriangle& t : star.triangles()) {
    const Vec3 normal = t.normal(Vec3::Zero());
    const double length = normal.norm();
    if (!(length > 0.0)) continue;
    volume_gradient += normal / 6.0;
    area_gradient += 0.5 / length * normal.cross(t.to_b - t.to_a);
  }
  const double square = volume_gradient.squaredNorm();
  if (!(square > 0.0)) return kUnknown;
  return std::clamp(area_gradient.dot(volume_gradient) / square, -most, most);
}

}  // namespace

void SurfaceStar::collect(const TetMesh& mesh, const Metric& metric, LocalVertex v) {
  collect_triangles(mesh, metric, v);
  find_spokes();
}

void SurfaceStar::collect_triangles(const TetMesh& mesh, const Metric& metric, LocalVertex v) {
  vertex_ = v;
  triangles_.clear();
  spokes_.clear();
  rims_.clear();
  fan_.collect(mesh, v, found_);
  const Point origin = mesh.position(v);
  for (const FanTriangle& t : found_) {
    const LocalVertex a = t.faces_high ? t.a : t.b, b = t.faces_high ? t.b : t.a;
    triangles_.push_back({a, b, t.low, t.high, metric.vector(origin, mesh.position(a)),
                          metric.vector(origin, mesh.position(b))});
  }
}

/// Normals agree along an interface, so the two triangles of a spoke run through it in opposite
/// directions: its far end is a of one and b of the other.
void SurfaceStar::find_spokes() {
  spokes_.clear();
  gather_corners();
  const auto n = static_cast<std::uint32_t>(triangles_.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const SurfaceTriangle& t = triangles_[i];
    int at_spoke = 0;
    std::uint32_t other = n, first = 0;
    for (const CornerLanes& group : corners_) {
      unsigned found = group.of_triangles_at(t.a, t.low, t.high);
      at_spoke += kBitCounts[found];
      if (i >= first && i - first < kLanes) found &= ~(1U << (i - first));
      if (found != 0) other = first + static_cast<std::uint32_t>(std::countr_zero(found));
      first += kLanes;
    }
    if (at_spoke == 2 && triangles_[other].b == t.a) spokes_.push_back({i, other});
  }
}

/// Lanes beyond the last triangle lie between a label and itself, so that no search finds them.
void SurfaceStar::gather_corners() {
  corners_.assign((triangles_.size() + kLanes - 1) / kLanes, {});
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const SurfaceTriangle& t = triangles_[i];
    CornerLanes& group = corners_[i / kLanes];
    group.a[i % kLanes] = static_cast<std::int32_t>(t.a);
    group.b[i % kLanes] = static_cast<std::int32_t>(t.b);
    group.low[i % kLanes] = static_cast<std::int32_t>(t.low);
    group.high[i % kLanes] = static_cast<std::int32_t>(t.high);
  }
}

unsigned SurfaceStar::CornerLanes::of_triangles_at(LocalVertex w, Label l, Label h) const {
  const auto vertex = static_cast<std::int32_t>(w);
  return lane_bits(((load(a) == vertex) | (load(b) == vertex)) &
                   (load(low) == static_cast<std::int32_t>(l)) &
                   (load(high) == static_cast<std::int32_t>(h)));
}

void SurfaceStar::merge(const SurfaceStar& star, const Vec3& move, const SurfaceStar& other,
                        const Vec3& other_move) {
  vertex_ = star.vertex();
  triangles_.clear();
  rims_.clear();
  add_without(other.vertex(), star, move);
  add_without(star.vertex(), other, other_move);
  find_spokes();
}

void SurfaceStar::add_without(LocalVertex vanishing, const SurfaceStar& star, const Vec3& move) {
  auto rim = star.rims_.begin();
  for (std::uint32_t i = 0; i < star.triangles_.size(); ++i) {
    const bool has_rim = rim != star.rims_.end() && rim->triangle == i;
    SurfaceTriangle t = star.triangles_[i];
    if (!t.has(vanishing)) {
      if (has_rim) rims_.push_back({static_cast<std::uint32_t>(triangles_.size()), rim->normal});
      t.to_a -= move;
      t.to_b -= move;
      triangles_.push_back(t);
    }
    if (has_rim) ++rim;
  }
}

void SurfaceStar::normals_at(const Vec3& x, std::vector<SurfaceNormal>& out) const {
  out.resize(triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Vec3 normal = triangles_[i].normal(x);
    out[i] = {normal, normal.squaredNorm()};
  }
}

double SurfaceStar::bends_at(const Vec3& x) const {
  normals_at(x, normals_);
  return bends(normals_);
}

double SurfaceStar::bends(std::span<const SurfaceNormal> normals) const {
  double sum = 0.0;
  for (const Spoke& s : spokes_) {
    const SurfaceNormal &m = normals[s.first], &n = normals[s.second];
    sum += bend_energy(m.vector.dot(n.vector), m.square * n.square);
  }
  for (const Rim& r : rims_) {
    const SurfaceNormal& m = normals[r.triangle];
    sum += bend_energy(m.vector.dot(r.normal), m.square * r.normal.squaredNorm());
  }
  return sum;
}

void SurfaceStar::collect_rims(const TetMesh& mesh, const Metric& metric) {
  rims_.clear();
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) find_rim(mesh, metric, i);
}

void SurfaceStar::collect_rims(const TetMesh& mesh, const Metric& metric,
                               std::span<const std::uint8_t> wanted) {
  rims_.clear();
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    if (wanted[i] != 0) find_rim(mesh, metric, i);
  }
}

void SurfaceStar::find_rim(const TetMesh& mesh, const Metric& metric, std::uint32_t row) {
  const SurfaceTriangle& t = triangles_[row];
  const std::optional<LocalVertex> other = across(mesh, t);
  if (!other) return;
  // Across the edge the normal of (b, a, other) points to high, as that of (v, a, b) does.
  const Vec3 to_other = metric.vector(mesh.position(vertex_), mesh.position(*other));
  const Vec3 normal = (t.to_a - t.to_b).cross(to_other - t.to_b);
  const double length = normal.norm();
  if (length > 0.0) rims_.push_back({row, normal / length});
}

/// Returns the third corner of the triangle across the edge opposite v, if exactly two triangles of
/// its labels meet there.  Only tets of the two labels are compared, so the ring needs no order;
/// where neither end is free, collect_ring() tells whether all of it is loaded.
std::optional<LocalVertex> SurfaceStar::across(const TetMesh& mesh, const SurfaceTriangle& t) {
  LocalVertex p = t.a, q = t.b;
  if (mesh.star(q).size() < mesh.star(p).size()) std::swap(p, q);
  if (!mesh.is_free(p)) std::swap(p, q);
  if (mesh.is_free(p)) {
    collect_ring_tets(mesh, p, q, ring_);
  } else if (!collect_ring(mesh, p, q, ring_)) {
    return std::nullopt;
  }
  LocalVertex other = mesh.infinity();
  int others = 0, rises = 0;
  const auto add = [&](LocalVertex w, bool rise) {
    rises += rise ? 1 : 0;
    if (w == vertex_) return;
    other = w;
    ++others;
  };
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    if (without_side(ring_.labels[i]) != t.low) continue;
    for (std::size_t k = 0; k < ring_.size(); ++k) {
      if (without_side(ring_.labels[k]) != t.high) continue;
      if (ring_.ends[i] == ring_.vertices[k]) add(ring_.ends[i], true);
      if (ring_.ends[k] == ring_.vertices[i]) add(ring_.vertices[i], false);
    }
  }
  // Around an edge of six regions both may lead from low to high; then no surface runs through it.
  return others == 1 && rises == 1 ? std::optional(other) : std::nullopt;
}

void CurvatureField::measure(const TetMesh& mesh, const Metric& metric) {
  curvature_.assign(mesh.vertex_count(), kUnknown);
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v) || !mesh.is_free(v)) continue;
    if (mesh.order(v) != 2 || mesh.planes(v) != 0) continue;
    star_.collect_triangles(mesh, metric, v);
    curvature_[v] = curvature_of(star_, kMaxCurvature);
  }
}

std::optional<double> CurvatureField::at(LocalVertex v) const {
  if (v >= curvature_.size() || curvature_[v] == kUnknown) return std::nullopt;
  return curvature_[v];
}

}  // namespace mw
