// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A queue of edges; those whose ends have changed since are skipped.
#include "kernels/decimate/surface_decimator.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace mw {
namespace {

using Triangle = SurfaceDecimator::Triangle;

/// Weight of the vertex's own place beside the planes of its triangles, which alone do not say
/// where in a plane it should be.
constexpr double kPointWeight = 1e-3;
/// The least area that a star shows along its mean normal, as a share of its whole area, for which
/// its volume says where its vertex goes.  A star around the tip of a thread shows next to nothing.
constexpr double kLeastSpan = 0.01;
/// The least cosine between the normals of a triangle before and after a contraction.
constexpr double kLeastCosine = 0.2;
/// The least quality of a new triangle that is worse than the one before; an equilateral one has 1.
constexpr double kLeastQuality = 0.05;

bool has(const Triangle& t, std::uint32_t v) {
  return t[0] == v || t[1] == v || t[2] == v;
}

Vec3 normal_of(const std::array<Vec3, 3>& at) {
  return (at[1] - at[0]).cross(at[2] - at[0]);
}

double quality_of(const std::array<Vec3, 3>& at) {
  const double edges =
      (at[1] - at[0]).squaredNorm() + (at[2] - at[1]).squaredNorm() + (at[0] - at[2]).squaredNorm();
  return edges > 0.0 ? 2.0 * std::sqrt(3.0) * normal_of(at).norm() / edges : 0.0;
}

}  // namespace

bool SurfaceDecimator::IsDearer::operator()(const Candidate& a, const Candidate& b) const {
  return std::tie(a.cost, a.keep, a.drop) > std::tie(b.cost, b.keep, b.drop);
}

SurfaceDecimator::SurfaceDecimator(const std::vector<Vec3>& vertices,
                                   std::vector<Triangle> triangles)
    : vertices_(vertices.size()),
      triangles_(std::move(triangles)),
      is_gone_(triangles_.size()),
      left_(triangles_.size()) {
  for (std::size_t v = 0; v < vertices.size(); ++v) vertices_[v].place = vertices[v];
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    for (const std::uint32_t v : triangles_[t]) vertices_[v].triangles.push_back(t);
  }
  find_quadrics();
  find_fixed();
}

void SurfaceDecimator::find_quadrics() {
  for (const Triangle& t : triangles_) {
    const Vec3 normal =
        normal_of({vertices_[t[0]].place, vertices_[t[1]].place, vertices_[t[2]].place});
    const double area = 0.5 * normal.norm();
    if (!(area > 0.0)) continue;
    for (const std::uint32_t v : t) {
      vertices_[v].quadric.add_plane(normal.normalized(), Vec3::Zero(), area);
      vertices_[v].quadric.add_point(kPointWeight * area);
    }
  }
}

/// Fixes the ends of edges that do not have two triangles, and vertices of triangles without area.
void SurfaceDecimator::find_fixed() {
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    const std::vector<std::uint32_t> ends = edge_ends(v);
    for (auto end = ends.begin(); end != ends.end();) {
      const auto next = std::upper_bound(end, ends.end(), *end);
      if (next - end != 2) vertices_[v].is_fixed = true;
      end = next;
    }
    if (!(vertices_[v].quadric.trace() > 0.0)) vertices_[v].is_fixed = true;
  }
}

void SurfaceDecimator::decimate(double bound) {
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    if (is_gone_[t]) continue;
    const auto [a, b, c] = triangles_[t];
    // Each edge has a triangle on either side, in which its ends follow each other the other way.
    if (a < b) push(a, b);
    if (b < c) push(b, c);
    if (c < a) push(c, a);
  }
  while (!queue_.empty()) {
    const Candidate c = queue_.top();
    queue_.pop();
    if (!is_current(c) || !keeps_topology(c.keep, c.drop)) continue;
    for (const Vec3& place : places_for(c.keep, c.drop, sum_of(c.keep, c.drop))) {
      const double moved = moved_to(place, c.keep, c.drop);
      if (moved > bound) continue;
      if (!keeps_sides(c.keep, c.drop, place) || !keeps_sides(c.drop, c.keep, place)) continue;
      contract(c.keep, c.drop, place, moved);
      for (const std::uint32_t w : neighbours(c.keep)) push(c.keep, w);
      break;
    }
  }
}

/// A fixed end is kept, otherwise the one that comes first.
void SurfaceDecimator::push(std::uint32_t a, std::uint32_t b) {
  if (vertices_[a].is_fixed && vertices_[b].is_fixed) return;
  const bool keeps_b = vertices_[b].is_fixed || (!vertices_[a].is_fixed && b < a);
  const std::uint32_t keep = keeps_b ? b : a, drop = keeps_b ? a : b;
  const Quadric sum = sum_of(keep, drop);
  const Vec3 way = places_for(keep, drop, sum).front() - vertices_[keep].place;
  queue_.push({sum.value(way), keep, drop, vertices_[keep].age, vertices_[drop].age});
}

bool SurfaceDecimator::is_current(const Candidate& c) const {
  const Vertex &keep = vertices_[c.keep], &drop = vertices_[c.drop];
  return keep.is_alive && drop.is_alive && keep.age == c.keep_age && drop.age == c.drop_age;
}

/// Returns the error of both ends, relative to the place of the kept one.
Quadric SurfaceDecimator::sum_of(std::uint32_t keep, std::uint32_t drop) const {
  const Vec3 way = vertices_[keep].place - vertices_[drop].place;
  return vertices_[keep].quadric + vertices_[drop].quadric.shifted(way);
}

/// Returns where the kept vertex may go, the best place first.  Each is moved the cheapest way to
/// the plane of places that keep the volume.
std::array<Vec3, 3> SurfaceDecimator::places_for(std::uint32_t keep, std::uint32_t drop,
                                                 const Quadric& sum) const {
  const Vec3& at = vertices_[keep].place;
  if (vertices_[keep].is_fixed) return {at, at, at};
  const Eigen::Matrix3d inverse = sum.matrix().inverse();
  const Vec3 least = -(inverse * sum.linear()), middle = 0.5 * (vertices_[drop].place - at);
  std::array<Vec3, 3> out{least, 0.5 * (least + middle), middle};
  const Plane plane = volume_plane(keep, drop);
  Vec3 way = inverse * plane.normal;
  const double height = plane.normal.dot(way);
  if (height > 0.0) way /= height;
  for (Vec3& x : out) x += at + (plane.at - plane.normal.dot(x)) * way;
  return out;
}

/// Returns the plane of all places, relative to that of the kept vertex, from which triangles to
/// the rim of both stars enclose as much as the stars do.  Its normal is zero if it is ill-defined.
SurfaceDecimator::Plane SurfaceDecimator::volume_plane(std::uint32_t keep,
                                                       std::uint32_t drop) const {
  Plane out;
  double area = 0.0;
  const Vec3& at = vertices_[keep].place;
  const auto add = [&](const Triangle& t) {
    const std::array<Vec3, 3> corners{vertices_[t[0]].place - at, vertices_[t[1]].place - at,
                                      vertices_[t[2]].place - at};
    const Vec3 normal = normal_of(corners);
    out.normal += normal;
    out.at += normal.dot(corners[0]);
    area += normal.norm();
  };
  for (const std::uint32_t t : vertices_[keep].triangles) add(triangles_[t]);
  for (const std::uint32_t t : vertices_[drop].triangles) {
    if (!has(triangles_[t], keep)) add(triangles_[t]);
  }
  return out.normal.norm() > kLeastSpan * area ? out : Plane{};
}

/// Returns the other ends of the edges of v, ascending, once for each triangle of the edge.
std::vector<std::uint32_t> SurfaceDecimator::edge_ends(std::uint32_t v) const {
  std::vector<std::uint32_t> out;
  for (const std::uint32_t t : vertices_[v].triangles) {
    for (const std::uint32_t w : triangles_[t]) {
      if (w != v) out.push_back(w);
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Returns the other ends of the edges of v, ascending.
std::vector<std::uint32_t> SurfaceDecimator::neighbours(std::uint32_t v) const {
  std::vector<std::uint32_t> out = edge_ends(v);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// The link condition: both ends have no neighbours in common but the two that the edge's triangles
/// have, and no edge between these is in both links.
bool SurfaceDecimator::keeps_topology(std::uint32_t keep, std::uint32_t drop) const {
  const auto& all = vertices_[drop].triangles;
  if (std::count_if(all.begin(), all.end(),
                    [&](std::uint32_t t) { return has(triangles_[t], keep); }) != 2) {
    return false;
  }
  const std::vector<std::uint32_t> one = neighbours(keep), other = neighbours(drop);
  std::vector<std::uint32_t> common;
  std::set_intersection(one.begin(), one.end(), other.begin(), other.end(),
                        std::back_inserter(common));
  return common.size() == 2 && !(spans(keep, drop, common) && spans(drop, keep, common));
}

/// True if v has a triangle with both of these vertices and without the other one.
bool SurfaceDecimator::spans(std::uint32_t v, std::uint32_t other,
                             const std::vector<std::uint32_t>& two) const {
  const auto& all = vertices_[v].triangles;
  return std::any_of(all.begin(), all.end(), [&](std::uint32_t t) {
    const Triangle& corners = triangles_[t];
    return !has(corners, other) && has(corners, two[0]) && has(corners, two[1]);
  });
}

double SurfaceDecimator::moved_to(const Vec3& place, std::uint32_t keep, std::uint32_t drop) const {
  const auto of = [&](const Vertex& v) { return v.moved + (place - v.place).norm(); };
  return std::max(of(vertices_[keep]), of(vertices_[drop]));
}

/// True if the triangles of v without the other vertex look the same way when v is at the place,
/// and do not become needles.
bool SurfaceDecimator::keeps_sides(std::uint32_t v, std::uint32_t other, const Vec3& place) const {
  const auto& all = vertices_[v].triangles;
  return std::all_of(all.begin(), all.end(), [&](std::uint32_t t) {
    if (has(triangles_[t], other)) return true;
    std::array<Vec3, 3> before, after;
    for (std::size_t i = 0; i < 3; ++i) {
      before[i] = vertices_[triangles_[t][i]].place;
      after[i] = triangles_[t][i] == v ? place : before[i];
    }
    const Vec3 m = normal_of(before), n = normal_of(after);
    if (!(m.dot(n) > kLeastCosine * m.norm() * n.norm())) return false;
    const double quality = quality_of(after);
    return quality >= kLeastQuality || quality >= quality_of(before);
  });
}

void SurfaceDecimator::contract(std::uint32_t keep, std::uint32_t drop, const Vec3& place,
                                double moved) {
  Vertex &kept = vertices_[keep], &dropped = vertices_[drop];
  kept.quadric = sum_of(keep, drop).shifted(place - kept.place);
  kept.place = place;
  kept.moved = moved;
  ++kept.age;
  for (const std::uint32_t t : dropped.triangles) {
    if (has(triangles_[t], keep)) {
      is_gone_[t] = true;
      --left_;
      for (const std::uint32_t v : triangles_[t]) {
        if (v != drop) std::erase(vertices_[v].triangles, t);
      }
      continue;
    }
    std::replace(triangles_[t].begin(), triangles_[t].end(), drop, keep);
    kept.triangles.push_back(t);
  }
  std::sort(kept.triangles.begin(), kept.triangles.end());
  dropped.is_alive = false;
  dropped.triangles = {};
}

SurfaceDecimator::Surface SurfaceDecimator::surface() const {
  Surface out;
  std::vector<std::uint32_t> rows(vertices_.size());
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (vertices_[v].triangles.empty()) continue;
    rows[v] = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.push_back(vertices_[v].place);
  }
  out.triangles.reserve(left_);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (is_gone_[t]) continue;
    const auto [a, b, c] = triangles_[t];
    out.triangles.push_back({rows[a], rows[b], rows[c]});
  }
  return out;
}

}  // namespace mw
