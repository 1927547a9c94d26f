// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Computes the gain in bends and in fit; Flipper adds the gain in shapes.
#include "kernels/optimise/unfold.h"

#include <Eigen/Geometry>
#include <optional>

#include "kernels/distance/point_triangle.h"
#include "kernels/surface/surface_star.h"

namespace mw {
namespace {

/// A smaller gain in bend energy is not worth a try.
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

/// What the flip adds to the squared distances of the faces that a triangle carries.
double Unfolder::misfit(const SurfaceTriangle& t, const Hinge& h) const {
  const Vec3 voxel = metric_.voxel();
  const Vec3 at = metric_.vector({}, mesh_.position(star_.vertex()));
  double sum = 0.0;
  guard_.for_each_piece(
      triangle_key(star_.vertex(), t.a, t.b), t.low, [&](const DistanceGuard::Piece& piece) {
        const Vec3 p = piece.middle.cwiseProduct(voxel) - at;
        const double area =
            piece.quarters / kSamplesPerFace * voxel.prod() / voxel[static_cast<int>(piece.axis)];
        sum += area * (h.distance_after(p) - h.present_distance(p));
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

bool Unfolder::unfold_one(LocalVertex v) {
  star_.collect(mesh_, metric_, v);
  if (!find_open_spokes()) return false;
  star_.collect_rims(mesh_, metric_, at_open_);
  for (const Spoke& spoke : open_) {
    const LocalVertex q = star_.triangles()[spoke.first].a;
    const Hinge h = hinge(spoke);
    const double gain = h.gain();
    if (gain > kMinBendGain) {
      const double misfits = misfit(*h.first, h) + misfit(*h.second, h);
      const double of_surface =
          kBendFactor * weights_.bend * gain - kMisfitFactor / h.area() * misfits;
      if (flipper_.flip_surface(v, q, of_surface)) return true;
    }
    failed_.insert(mesh_, v, q);
  }
  return false;
}

std::uint64_t Unfolder::unfold(LocalVertex v) {
  std::uint64_t flips = 0;
  while (unfold_one(v)) ++flips;
  return flips;
}

}  // namespace mw
