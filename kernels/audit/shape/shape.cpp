// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Interface triangles from vertex stars, bends from a sorted list of their edges.
#include "kernels/audit/shape/shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "kernels/audit/mesh_stars.h"
#include "kernels/audit/partition/orientation.h"
#include "kernels/core/vector3.h"

namespace mw::audit {
namespace {

/// The normal out of the lower label, as long as twice the triangle's area.
Position normal(const Position& p, const Position& edge, const Wing& wing) {
  const Position n = cross(edge, minus(wing.apex, p));
  return wing.turned ? Position{-n[0], -n[1], -n[2]} : n;
}

/// A triangle as one of its edges sees it.
struct EdgeSide {
  std::uint32_t p = 0;  ///< p < q
  std::uint32_t q = 0;
  std::uint32_t apex = 0;
  LabelPair labels{};
  bool turned = false;

  [[nodiscard]] bool same_edge(const EdgeSide& other) const { return p == other.p && q == other.q; }
};

class ShapeAudit {
 public:
  explicit ShapeAudit(const MeshStars& stars) : stars_(stars), mesh_(stars.mesh()) {}

  ShapeMeter run() {
    visit_whole_faces(stars_, [&](const MeshFace& face) {
      if (face.sides.size() == 2 && label(face, 0) != label(face, 1)) add_triangle(face);
    });
    std::sort(sides_.begin(), sides_.end(), [](const EdgeSide& a, const EdgeSide& b) {
      return std::tie(a.p, a.q, a.apex) < std::tie(b.p, b.q, b.apex);
    });
    for (std::size_t begin = 0, end = 0; begin < sides_.size(); begin = end) {
      while (end < sides_.size() && sides_[end].same_edge(sides_[begin])) ++end;
      if (end - begin == 2) add_edge(sides_[begin], sides_[begin + 1]);
    }
    return std::move(meter_);
  }

 private:
  [[nodiscard]] Label label(const MeshFace& face, std::size_t side) const {
    return mesh_.labels[face.sides[side].tet];
  }
  [[nodiscard]] const Position& at(std::uint64_t vertex) const { return mesh_.vertices[vertex]; }

  /// True if (b - a) x (c - a) points out of the tet on triangle a, b, c.
  [[nodiscard]] bool points_out(const MeshFace& face, std::size_t side) const {
    const auto& [a, b, c] = face.vertices;
    const TetRow& tet = mesh_.tets[face.sides[side].tet];
    return orientation(at(tet[apex_of(tet, face.vertices)]), at(a), at(b), at(c)) > 0;
  }

  void add_triangle(const MeshFace& face) {
    const auto& [a, b, c] = face.vertices;
    const LabelPair labels = label_pair(label(face, 0), label(face, 1));
    const bool out = points_out(face, label(face, 0) == labels.low ? 0 : 1);
    if (stars_.owns(a)) meter_.add_triangle(at(a), at(b), at(c));
    add_side({a, b, c, labels, !out});
    add_side({b, c, a, labels, !out});
    add_side({a, c, b, labels, out});
  }

  void add_side(const EdgeSide& side) {
    if (stars_.owns(side.p)) sides_.push_back(side);
  }

  void add_edge(const EdgeSide& one, const EdgeSide& other) {
    if (one.labels != other.labels) return;
    meter_.add_edge(at(one.p), at(one.q), {at(one.apex), one.turned},
                    {at(other.apex), other.turned});
  }

  const MeshStars& stars_;
  const AuditMesh& mesh_;
  ShapeMeter meter_;
  std::vector<EdgeSide> sides_;
};

}  // namespace

void ShapeMeter::add_triangle(const Position& a, const Position& b, const Position& c) {
  ++triangles_;
  area_.add(norm(cross(minus(b, a), minus(c, a))) / 2);
}

void ShapeMeter::add_edge(const Position& p, const Position& q, const Wing& one,
                          const Wing& other) {
  const Position edge = minus(q, p);
  const Position m = normal(p, edge, one);
  const Position n = normal(p, edge, other);
  const double weight = norm(edge);
  const double degrees = std::atan2(norm(cross(m, n)), dot(m, n)) * (180 / std::numbers::pi);
  // Lattices are full of right angles and the like, which rounding must not put on either side.
  constexpr double kRounding = 1e-9;
  const auto bin = static_cast<std::size_t>((degrees + kRounding) * kBinsPerDegree);
  bins_[std::min(bin, bins_.size() - 1)].add(weight);
  length_.add(weight);
  if (degrees > kSharpDegrees + kRounding) sharp_length_.add(weight);
  largest_ = std::max(largest_, degrees);
}

void ShapeMeter::add(const ShapeMeter& other) {
  triangles_ += other.triangles_;
  area_.add(other.area_);
  for (std::size_t i = 0; i < bins_.size(); ++i) bins_[i].add(other.bins_[i]);
  length_.add(other.length_);
  sharp_length_.add(other.sharp_length_);
  largest_ = std::max(largest_, other.largest_);
}

/// The middle of the first bin up to which the wanted share of the length lies.
double ShapeMeter::percentile(double share, double total) const {
  CompensatedSum below;
  std::size_t bin = 0;
  for (; bin + 1 < bins_.size(); ++bin) {
    below.add(bins_[bin].value());
    if (below.value() >= share * total) break;
  }
  return std::min((static_cast<double>(bin) + 0.5) / kBinsPerDegree, largest_);
}

ShapeReport ShapeMeter::report() const {
  ShapeReport out{.triangles = triangles_, .area = area_.value(), .bend_max_deg = largest_};
  const double total = length_.value();
  if (total <= 0) return out;
  out.bend_p50_deg = percentile(0.50, total);
  out.bend_p95_deg = percentile(0.95, total);
  out.bend_p99_deg = percentile(0.99, total);
  out.sharp_share = sharp_length_.value() / total;
  const std::size_t fine = bins_.size() / out.bend_histogram.size();
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    out.bend_histogram[i / fine] += bins_[i].value() / total;
  }
  return out;
}

ShapeMeter measure_shape(const MeshStars& stars) {
  return ShapeAudit(stars).run();
}

}  // namespace mw::audit
