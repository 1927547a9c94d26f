// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Newton's method on a convex energy, accepted by the shape energy.
#include "kernels/optimise/smooth.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <optional>

#include "kernels/quality/mesh_quality.h"
#include "kernels/quality/star_batch.h"

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
  Mover(const TetMesh& mesh, const Metric& metric, StarBatch& star, LocalVertex v, double least)
      : mesh_(mesh),
        metric_(metric),
        star_(star),
        v_(v),
        fixed_(fixed_axes(mesh.planes(v))),
        least_(least) {
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
      if (mesh_.quadric(v_).value(from_start(y)) > *quadric_limit_) return std::nullopt;
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
    return star_.energy_at(from_start(x), least_, enough);
  }

  /// Newton's step for StarBatch::terms_at; on interfaces the quadric is added.
  [[nodiscard]] Vec3 newton_step(Point x) const {
    StarTerms terms = star_.terms_at(from_start(x));
    if (quadric_limit_) {
      const double weight = kQuadricShare * terms.value / *quadric_limit_;
      const Quadric q = mesh_.quadric(v_).shifted(from_start(x));
      terms.gradient += 2.0 * weight * q.linear();
      terms.hessian += 2.0 * weight * q.matrix();
    }
    return solve(terms.hessian, terms.gradient);
  }

 private:
  [[nodiscard]] Vec3 from_start(Point x) const { return metric_.vector(mesh_.position(v_), x); }

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
  StarBatch& star_;
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

bool Smoother::smooth(LocalVertex v) {
  star_.collect(mesh_, metric_, v);
  const StarShape present = star_.shape_at(Vec3::Zero());
  if (present.worst >= options_.smooth_below) return false;
  const Mover mover(mesh_, metric_, star_, v, least_allowed(present.worst, options_.quality_floor));
  const Point start = mesh_.position(v);
  Best best{start, present.energy};
  search(mover, best);
  if (best.energy > (1.0 - kLeastGain) * present.energy) return false;
  const bool guarded = guard_ != nullptr && mesh_.on_interface(v);
  if (guarded && !guard_->allows_move(mesh_, v, best.position)) return false;
  const Vec3 move = metric_.vector(start, best.position);
  mesh_.move(v, best.position, mesh_.quadric(v).shifted(move));
  if (guarded) guard_->commit();
  return true;
}

}  // namespace mw
