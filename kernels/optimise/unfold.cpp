// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Computes the gain in bends and in fit; Flipper adds the gain in shapes.
#include "kernels/optimise/unfold.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "kernels/distance/point_triangle.h"
#include "kernels/quality/quality.h"
#include "kernels/surface/surface_star.h"

namespace mw {
namespace {

/// A smaller gain in bend energy is not worth a try, and a poor cap may cost as much
/// (bench/parameters.md, "Constants").
constexpr double kMinBendGain = 0.02;
/// Energy of a bend, in shape energies of a tet, for each unit of SurfaceWeights::bend.
constexpr double kBendFactor = 5.0;
/// Energy of the mean squared distance of carried faces, in shape energies of a tet, for each voxel
/// squared.
constexpr double kMisfitFactor = 100.0;

double bend_between(const Vec3& m, const std::optional<Vec3>& n) {
  return n ? bend_energy(cosine_between(m, *n)) : 0.0;
}

}  // namespace

/// Positions are relative to v: q, and a and b on the two sides; (v, q, a) and (v, b, q) face high.
struct Unfolder::Hinge {
  const SurfaceTriangle* first = nullptr;   ///< (v, q, a)
  const SurfaceTriangle* second = nullptr;  ///< (v, b, q)
  Vec3 q, a, b;
  std::optional<Vec3> across_va, across_vb, across_qa, across_qb;  ///< normals of other triangles

  [[nodiscard]] Vec3 near_v() const { return b.cross(a); }  ///< normal of (v, b, a)
  [[nodiscard]] Vec3 near_q() const { return (q - b).cross(a - b); }

  /// By how much the bend energy of the five edges falls.
  [[nodiscard]] double gain() const {
    const Vec3 m = first->normal(Vec3::Zero()), n = second->normal(Vec3::Zero());
    const double before = bend_energy(cosine_between(m, n)) + bend_between(m, across_va) +
                          bend_between(m, across_qa) + bend_between(n, across_vb) +
                          bend_between(n, across_qb);
    const Vec3 k = near_v(), l = near_q();
    const double after = bend_energy(cosine_between(k, l)) + bend_between(k, across_va) +
                         bend_between(k, across_vb) + bend_between(l, across_qa) +
                         bend_between(l, across_qb);
    return before - after;
  }
  [[nodiscard]] double area() const {
    return 0.5 * (first->normal(Vec3::Zero()).norm() + second->normal(Vec3::Zero()).norm());
  }
  [[nodiscard]] double present_distance(const Vec3& p) const {
    return std::min(foot_on_triangle(p, q, a).squared_distance,
                    foot_on_triangle(p, b, q).squared_distance);
  }
  [[nodiscard]] double distance_after(const Vec3& p) const {
    return std::min(foot_on_triangle(p, b, a).squared_distance,
                    foot_on_triangle(p - b, q - b, a - b).squared_distance);
  }
};

struct Unfolder::Dimple {
  /// A triangle across from v, positions relative to v.
  struct Triangle {
    LinkTriangle corners;
    Vec3 a, b, c;
    Vec3 normal;  ///< points to high

    [[nodiscard]] bool has(LocalVertex p, LocalVertex q) const {
      return corners.has(p) && corners.has(q);
    }
  };
  const SurfaceStar& star;
  std::vector<Triangle> triangles;

  /// By how much bend energies fall: those at v go, those between triangles across from v come.
  [[nodiscard]] double gain() const {
    double after = 0.0;
    for (const Rim& r : star.rims()) {
      const SurfaceTriangle& old = star.triangles()[r.triangle];
      for (const Triangle& t : triangles) {
        if (t.has(old.a, old.b)) after += bend_between(t.normal, r.normal);
      }
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) after += bend_at_common_edge(triangles[i], triangles[k]);
    }
    return star.bends_at(Vec3::Zero()) - after;
  }
  [[nodiscard]] static double bend_at_common_edge(const Triangle& s, const Triangle& t) {
    const auto& [a, b, c, label] = s.corners;
    const bool meet = t.has(a, b) || t.has(b, c) || t.has(c, a);
    return meet ? bend_between(s.normal, t.normal) : 0.0;
  }
  [[nodiscard]] double area() const {
    double sum = 0.0;
    for (const Triangle& t : triangles) sum += 0.5 * t.normal.norm();
    return sum;
  }
  [[nodiscard]] double present_distance(const Vec3& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const SurfaceTriangle& t : star.triangles()) {
      least = std::min(least, foot_on_triangle(p, t.to_a, t.to_b).squared_distance);
    }
    return least;
  }
  [[nodiscard]] double distance_after(const Vec3& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : triangles) {
      least = std::min(least, foot_on_triangle(p - t.a, t.b - t.a, t.c - t.a).squared_distance);
    }
    return least;
  }
};

Unfolder::Hinge Unfolder::hinge(const Spoke& spoke) const {
  const auto& triangles = star_.triangles();
  const SurfaceTriangle& first = triangles[spoke.first];
  const SurfaceTriangle& second = triangles[spoke.second];
  Hinge h{&first, &second, first.to_a, first.to_b, second.to_a, {}, {}, {}, {}};
  // A spoke runs to a of its first triangle and to b of its second.
  for (const Spoke& s : star_.spokes()) {
    if (s.second == spoke.first) h.across_va = triangles[s.first].normal(Vec3::Zero());
    if (s.first == spoke.second) h.across_vb = triangles[s.second].normal(Vec3::Zero());
  }
  for (const Rim& r : star_.rims()) {
    if (r.triangle == spoke.first) h.across_qa = r.normal;
    if (r.triangle == spoke.second) h.across_qb = r.normal;
  }
  return h;
}

/// What a change adds to the squared distances of the faces that a triangle carries.
template <typename Change>
double Unfolder::misfit(const SurfaceTriangle& t, const Change& change) const {
  const Vec3 voxel = metric_.voxel();
  const Vec3 at = metric_.vector({}, mesh_.position(star_.vertex()));
  double sum = 0.0;
  guard_.for_each_piece(
      triangle_key(star_.vertex(), t.a, t.b), t.low, [&](const DistanceGuard::Piece& piece) {
        const Vec3 p = piece.middle.cwiseProduct(voxel) - at;
        const double area =
            piece.quarters / kSamplesPerFace * voxel.prod() / voxel[static_cast<int>(piece.axis)];
        sum += area * (change.distance_after(p) - change.present_distance(p));
      });
  return sum;
}

/// Half of the spokes have failed from their other end already; their rims need not be found.
bool Unfolder::find_open_spokes() {
  open_.clear();
  at_open_.assign(star_.triangles().size(), 0);
  for (const Spoke& spoke : star_.spokes()) {
    if (failed_.contains(mesh_, star_.vertex(), star_.triangles()[spoke.first].a)) continue;
    open_.push_back(spoke);
    at_open_[spoke.first] = at_open_[spoke.second] = 1;
  }
  return !open_.empty();
}

/// True if the two triangles of a spoke are faces of one tet of poor shape.
bool Unfolder::is_poor_cap(LocalVertex v, const Spoke& spoke) const {
  const SurfaceTriangle& first = star_.triangles()[spoke.first];
  const LocalVertex q = first.a, a = first.b, b = star_.triangles()[spoke.second].a;
  const auto star = mesh_.star(v);
  const auto cap = std::find_if(star.begin(), star.end(), [&](const LinkTriangle& t) {
    return t.has(q) && t.has(a) && t.has(b);
  });
  return cap != star.end() && radius_ratio(mesh_, metric_, mesh_.position(v), *cap) < kDecentRatio;
}

/// Flips the edge of a spoke where that gains; of a poor cap the shape is a gain, too.
bool Unfolder::unfold_hinge(LocalVertex v, const Spoke& spoke) {
  const Hinge h = hinge(spoke);
  const double gain = h.gain();
  if (!(gain > kMinBendGain) && !(gain > -kMinBendGain && is_poor_cap(v, spoke))) return false;
  const double misfits = misfit(*h.first, h) + misfit(*h.second, h);
  const double of_surface = kBendFactor * weights_.bend * gain - kMisfitFactor / h.area() * misfits;
  return flipper_.flip_surface(v, h.first->a, of_surface);
}

/// Finds a dimple at a vertex between two labels whose interface triangles are one fan.
Unfolder::Dimple Unfolder::dimple(LocalVertex v) {
  Dimple out{star_, {}};
  const auto& fan = star_.triangles();
  if (mesh_.order(v) != 2 || mesh_.planes(v) != 0 || star_.spokes().size() != fan.size())
    return out;
  const Point at = mesh_.position(v);
  const auto from_v = [&](LocalVertex w) { return metric_.vector(at, mesh_.position(w)); };
  for (const LinkTriangle& t : flipper_.find_dimple(v, star_.fan())) {
    const Vec3 a = from_v(t.a), b = from_v(t.b), c = from_v(t.c), away = (b - a).cross(c - a);
    out.triangles.push_back({t, a, b, c, without_side(t.label) == fan[0].high ? away : -away});
  }
  return out;
}

bool Unfolder::unfold_dimple(LocalVertex v) {
  const Dimple d = dimple(v);
  if (d.triangles.empty()) return false;
  star_.collect_rims(mesh_, metric_);
  const double gain = d.gain();
  if (!(gain > kMinBendGain)) return false;
  double misfits = 0.0;
  for (const SurfaceTriangle& t : star_.triangles()) misfits += misfit(t, d);
  if (kBendFactor * weights_.bend * gain < kMisfitFactor / d.area() * misfits) return false;
  return flipper_.flip_dimple(v, star_.fan());
}

bool Unfolder::unfold_one(LocalVertex v) {
  star_.collect(mesh_, metric_, v);
  if (unfold_dimple(v)) return true;
  if (!find_open_spokes()) return false;
  star_.collect_rims(mesh_, metric_, at_open_);
  for (const Spoke& spoke : open_) {
    if (unfold_hinge(v, spoke)) return true;
    failed_.insert(mesh_, v, star_.triangles()[spoke.first].a);
  }
  return false;
}

std::uint64_t Unfolder::unfold(LocalVertex v) {
  std::uint64_t flips = 0;
  while (unfold_one(v)) ++flips;
  return flips;
}

}  // namespace mw
