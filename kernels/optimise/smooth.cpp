// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pattern search for the position of least shape energy.
#include "kernels/optimise/smooth.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "kernels/quality/mesh_quality.h"

namespace mw {
namespace {

constexpr double kInterfaceSlack = 0.25;
constexpr int kHalvings = 4;

/// What a move of one vertex has to respect.
class Mover {
 public:
  Mover(const TetMesh& mesh, const Metric& metric, LocalVertex v, double quality_floor)
      : mesh_(mesh),
        metric_(metric),
        v_(v),
        fixed_(fixed_axes(mesh.planes(v))),
        least_(least_allowed(worst_of_star(mesh, metric, v), quality_floor)) {
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

  /// Mean of the link triangles' corners: where the vertex would go by Laplacian smoothing.
  [[nodiscard]] Vec3 to_centroid() const {
    Vec3 sum = Vec3::Zero();
    double count = 0.0;
    for (const LinkTriangle& t : mesh_.star(v_)) {
      if (t.label == kExterior) continue;
      for (LocalVertex w : {t.a, t.b, t.c}) {
        sum += metric_.vector(mesh_.position(v_), mesh_.position(w));
      }
      count += 3.0;
    }
    return sum / count;
  }

  [[nodiscard]] double reach() const {
    double longest = 0.0;
    for (const LinkTriangle& t : mesh_.star(v_)) {
      if (t.label == kExterior) continue;
      const Vec3 a = metric_.vector(mesh_.position(v_), mesh_.position(t.a));
      longest = std::max(longest, a.squaredNorm());
    }
    return std::sqrt(longest);
  }

 private:
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
  const Vec3 way = mover.to_centroid();
  const Point start = best.position;
  for (double step : {1.0, 0.5, 0.25}) best.offer(mover, mover.target(start, step * way));
  double h = 0.25 * mover.reach();
  for (int halving = 0; halving < kHalvings; ++halving, h *= 0.5) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = h * Vec3::Unit(axis);
      if (!best.offer(mover, mover.target(best.position, step))) {
        best.offer(mover, mover.target(best.position, -step));
      }
    }
  }
}

}  // namespace

bool smooth_vertex(TetMesh& mesh, const Metric& metric, LocalVertex v, double quality_floor,
                   DistanceGuard* guard) {
  const Mover mover(mesh, metric, v, quality_floor);
  const Point start = mesh.position(v);
  Best best{start, mover.energy(start, std::numeric_limits<double>::infinity())};
  search(mover, best);
  if (best.position == start) return false;
  const bool guarded = guard != nullptr && mesh.on_interface(v);
  if (guarded && !guard->allows_move(mesh, v, best.position)) return false;
  const Vec3 move = metric.vector(start, best.position);
  mesh.move(v, best.position, mesh.quadric(v).shifted(move));
  if (guarded) guard->commit();
  return true;
}

}  // namespace mw
