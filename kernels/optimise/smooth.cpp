// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Newton's method on a convex energy, accepted by the shape energy.
#include "kernels/optimise/smooth.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <optional>

#include "kernels/quality/mesh_quality.h"

namespace mw {
namespace {

constexpr double kInterfaceSlack = 0.25;
constexpr int kNewtonSteps = 2;

/// Weight of the quadric beside the energy: at its limit it costs this share of the star.
constexpr double kQuadricShare = 0.1;

/// A move must lower the energy by this share: tiny moves would only keep stars from coming to
/// rest.
constexpr double kLeastGain = 0.002;

/// What a move of one vertex has to respect.
class Mover {
 public:
  Mover(const TetMesh& mesh, const Metric& metric, LocalVertex v, double least)
      : mesh_(mesh), metric_(metric), v_(v), fixed_(fixed_axes(mesh.planes(v))), least_(least) {
    if (mesh.on_interface(v)) {
      const Quadric& q = mesh.quadric(v);
      quadric_limit_ = std::max(q.c, kInterfaceSlack * q.trace());
    }
  }

  /// The lattice point at `offset` from x, if the quadric and the planes of the vertex let it go
  /// there.
  [[nodiscard]] std::optional<Point> target(Point x, Vec3 offset) const {
    for (int i = 0; i < 3; ++i) {
      if ((fixed_ >> i & 1U) != 0) offset[i] = 0.0;
    }
    const Point y = metric_.moved(x, offset);
    if (y == x) return std::nullopt;
    if (quadric_limit_) {
      const Vec3 from_owner = metric_.vector(mesh_.position(v_), y);
      if (mesh_.quadric(v_).value(from_owner) > *quadric_limit_) return std::nullopt;
    }
    return y;
  }

  [[nodiscard]] bool all_positive(Point x) const {
    for (const LinkTriangle& t : mesh_.star(v_)) {
      if (t.label == kExterior) continue;
      if (volume6(x, mesh_.position(t.a), mesh_.position(t.b), mesh_.position(t.c)) <= 0) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] double energy(Point x, double enough) const {
    return star_energy(mesh_, metric_, v_, x, least_, enough);
  }

  /// Newton's step for the sum of s^3 / v^2 over the star, s the sum of a tet's six squared edges
  /// and v its volume (times 6): a convex function of the position wherever all tets are positive,
  /// least for regular tets, and free of square roots.  On interfaces the quadric is added.
  [[nodiscard]] Vec3 newton_step(Point x) const {
    Vec3 gradient = Vec3::Zero();
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    double sum = 0.0;
    for (const LinkTriangle& t : mesh_.star(v_)) {
      if (t.label == kExterior) continue;
      const TetEdges e =
          tet_edges(metric_, x, mesh_.position(t.a), mesh_.position(t.b), mesh_.position(t.c));
      const Vec3 ab = e.b - e.a, ac = e.c - e.a;
      const Vec3 dv = -ab.cross(ac), ds = -2.0 * (e.a + e.b + e.c);
      const double s = e.a.squaredNorm() + e.b.squaredNorm() + e.c.squaredNorm() +
                       ab.squaredNorm() + ac.squaredNorm() + (ac - ab).squaredNorm();
      const double r = s / -e.a.dot(dv);
      const Vec3 u = r * (ds - r * dv);
      sum += s * r * r;
      gradient += r * r * (3.0 * ds - 2.0 * r * dv);
      hessian += 6.0 / s * u * u.transpose();
      hessian.diagonal().array() += 18.0 * r * r;
    }
    if (quadric_limit_) {
      const double weight = kQuadricShare * sum / *quadric_limit_;
      const Quadric q = mesh_.quadric(v_).shifted(metric_.vector(mesh_.position(v_), x));
      gradient += 2.0 * weight * q.linear();
      hessian += 2.0 * weight * q.matrix();
    }
    return solve(hessian, gradient);
  }

 private:
  /// -hessian^-1 gradient over the axes along which the vertex may move.
  [[nodiscard]] Vec3 solve(Eigen::Matrix3d hessian, Vec3 gradient) const {
    for (int i = 0; i < 3; ++i) {
      if ((fixed_ >> i & 1U) == 0) continue;
      hessian.row(i).setZero();
      hessian.col(i).setZero();
      hessian(i, i) = 1.0;
      gradient[i] = 0.0;
    }
    return -hessian.llt().solve(gradient);
  }

  const TetMesh& mesh_;
  const Metric& metric_;
  LocalVertex v_;
  unsigned fixed_;
  double least_;
  std::optional<double> quadric_limit_;
};

struct Best {
  Point position;
  double energy;

  bool offer(const Mover& mover, std::optional<Point> x) {
    if (!x) return false;
    const double e = mover.energy(*x, energy);
    if (e >= energy || !mover.all_positive(*x)) return false;
    position = *x;
    energy = e;
    return true;
  }
};

void search(const Mover& mover, Best& best) {
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Point start = best.position;
    const Vec3 way = mover.newton_step(start);
    bool moved = false;
    for (double step = 1.0; step > 0.2 && !moved; step *= 0.5) {
      moved = best.offer(mover, mover.target(start, step * way));
    }
    if (!moved) return;
  }
}

}  // namespace

bool smooth_vertex(TetMesh& mesh, const Metric& metric, LocalVertex v, const SmoothOptions& options,
                   DistanceGuard* guard) {
  const StarShape present = star_shape(mesh, metric, v);
  if (present.worst >= options.smooth_below) return false;
  const Mover mover(mesh, metric, v, least_allowed(present.worst, options.quality_floor));
  const Point start = mesh.position(v);
  Best best{start, present.energy};
  search(mover, best);
  if (best.energy > (1.0 - kLeastGain) * present.energy) return false;
  const bool guarded = guard != nullptr && mesh.on_interface(v);
  if (guarded && !guard->allows_move(mesh, v, best.position)) return false;
  const Vec3 move = metric.vector(start, best.position);
  mesh.move(v, best.position, mesh.quadric(v).shifted(move));
  if (guarded) guard->commit();
  return true;
}

}  // namespace mw
