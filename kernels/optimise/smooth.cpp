// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Newton's method on a convex energy, accepted by the shape energy.
#include "kernels/optimise/smooth.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "kernels/core/index.h"
#include "kernels/quality/quality.h"
#include "kernels/surface/surface_star.h"

namespace mw {
namespace {

constexpr double kInterfaceSlack = 0.25;

/// Weight of the quadric beside the energy: at its limit it costs this share of the star's energy.
constexpr double kQuadricShare = 0.1;

/// A move must lower the energy by this share: tiny moves would only keep stars from coming to
/// rest (bench/parameters.md, "Constants").
constexpr double kMinGain = 0.002;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Steps of the searches around a fold and around a foot in a plane, as shares of the mean edge.
constexpr std::array<double, 4> kSearchSteps{0.4, 0.2, 0.1, 0.05};
constexpr int kHalvings = 2;
/// The bound on distance often refuses as large a step as the volume of a speck asks for.
constexpr int kHalvingsOfSpecks = 5;
/// How often the way to a plane is halved before it is given up.
constexpr int kHalvingsToPlane = 4;

/// What a move of one vertex has to respect, and what it costs.
class Mover {
 public:
  /// What the cost of a place is made of; surface is null where none is fitted.
  struct Costs {
    StarBatch& star;
    const ShortEdges& short_edges;
    SurfaceEnergy* surface;
  };

  // More than five parameters: a vertex with its star, and what moves are measured by.
  Mover(const TetMesh& mesh, const Metric& metric, const Costs& costs, LocalVertex v,
        const StarShape& present, double min)
      : mesh_(mesh),
        metric_(metric),
        costs_(costs),
        v_(v),
        fixed_(fixed_axes(mesh.planes(v))),
        present_(present.energy),
        min_(min) {
    if (costs.surface == nullptr && mesh.on_interface(v)) {
      const Quadric& q = mesh.quadric(v);
      quadric_limit_ = std::max(q.c, kInterfaceSlack * q.trace());
    }
  }

  /// Restricts all further moves to a plane.
  void keep_to(const FlatPlane& plane) { fixed_ |= 1U << plane.axis; }

  /// The lattice point at `offset` from x, if the quadric and the planes of the vertex let it go
  /// there.
  [[nodiscard]] std::optional<Point> target(Point x, Vec3 offset) const {
    for (int i = 0; i < 3; ++i) {
      if ((fixed_ >> i & 1U) != 0) offset[i] = 0.0;
    }
    const Point y = metric_.moved(x, offset);
    if (y == x) return std::nullopt;
    const bool is_limited = quadric_limit_ < kNoLimit;
    if (is_limited && mesh_.quadric(v_).value(from_start(y)) > quadric_limit_) return std::nullopt;
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
    const Vec3 at = from_start(x);
    const double of_surface = costs_.surface == nullptr ? 0.0 : costs_.surface->value_at(at);
    const double beside = present_ * (of_surface + costs_.short_edges.value_at(at));
    return beside + costs_.star.energy_at(at, min_, enough - beside);
  }

  /// Newton's step for StarBatch::terms_at, short edges and the surface energy.  At interface
  /// vertices without a surface energy the quadric is added instead.
  [[nodiscard]] Vec3 newton_step(Point x) const {
    const Vec3 at = from_start(x);
    StarTerms terms = costs_.star.terms_at(at);
    const double of_shape = terms.value;
    if (costs_.surface != nullptr) costs_.surface->add_derivatives(at, of_shape, terms);
    costs_.short_edges.add_derivatives(at, of_shape, terms);
    if (quadric_limit_ < kNoLimit) {
      const double weight = kQuadricShare * of_shape / quadric_limit_;
      const Quadric q = mesh_.quadric(v_).shifted(at);
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
  Costs costs_;
  LocalVertex v_;
  unsigned fixed_;
  double present_;
  double min_;
  double quadric_limit_ = kNoLimit;
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

Point between(Point a, Point b) {
  return {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2, a.z + (b.z - a.z) / 2};
}

double mean_edge(const SurfaceStar& star) {
  double sum = 0.0;
  for (const SurfaceTriangle& t : star.triangles()) sum += t.to_a.norm();
  return sum / static_cast<double>(star.triangles().size());
}

/// Puts the vertex at x, whatever that costs, unless tets would be too bad there.
bool begin_at(Point x, const Mover& mover, Best& best) {
  const double energy = mover.all_positive(x) ? mover.energy(x, kNoLimit) : kNoLimit;
  if (energy < kNoLimit) best = {x, energy};
  return energy < kNoLimit;
}

/// Puts the vertex at the best of some places in the plane around its foot there.  Returns false
/// where tets would be too bad at all of them.
bool begin_around(Point foot, const FlatPlane& plane, double edge, const Mover& mover, Best& best) {
  Best found{foot, kNoLimit};
  const auto u = static_cast<int>((plane.axis + 1) % 3), v = static_cast<int>((plane.axis + 2) % 3);
  for (const double step : kSearchSteps) {
    for_each_index(Box3{{-1, -1, 0}, {2, 2, 1}}, [&](Index3 i) {
      Vec3 way = Vec3::Zero();
      way[u] = static_cast<double>(i.x);
      way[v] = static_cast<double>(i.y);
      found.offer(mover, mover.target(foot, step * edge * way));
    });
  }
  if (found.energy < kNoLimit) best = found;
  return found.energy < kNoLimit;
}

/// Puts the vertex at its foot in the plane, or beside that, or as near to it as the tets stay good
/// enough, and restricts all further moves to the plane.
void begin_in(const FlatPlane& plane, double edge, Mover& mover, Best& best) {
  mover.keep_to(plane);
  Point foot = with_coordinate(best.position, plane.axis, plane.place);
  if (foot == best.position || begin_at(foot, mover, best)) return;
  if (begin_around(foot, plane, edge, mover, best)) return;
  for (int halving = 0; halving < kHalvingsToPlane; ++halving) {
    foot = between(best.position, foot);
    if (foot == best.position || begin_at(foot, mover, best)) return;
  }
}

void search(const Mover& mover, Best& best, int steps) {
  for (int i = 0; i < steps; ++i) {
    const Point start = best.position;
    const Vec3 way = mover.newton_step(start);
    bool moved = false;
    for (double step = 1.0; step > 0.2 && !moved; step *= 0.5) {
      moved = best.offer(mover, mover.target(start, step * way));
    }
    if (!moved) return;
  }
}

/// The mean normal of a star, and two directions across it; unit vectors.
std::array<Vec3, 3> frame_of(const SurfaceStar& star) {
  Vec3 normal = Vec3::Zero();
  for (const SurfaceTriangle& t : star.triangles()) normal += t.normal(Vec3::Zero());
  const double length = normal.norm();
  normal = length > 0.0 ? Vec3(normal / length) : Vec3::UnitX();
  const Vec3 across = normal.unitOrthogonal();
  return {normal, across, normal.cross(across)};
}

/// Takes each step along the frame that lowers the energy, long ones first.
void search_around(const Mover& mover, const SurfaceStar& star, Best& best) {
  const std::array<Vec3, 3> frame = frame_of(star);
  const double edge = mean_edge(star);
  for (const double step : kSearchSteps) {
    for (const Vec3& way : frame) {
      if (best.offer(mover, mover.target(best.position, step * edge * way))) continue;
      best.offer(mover, mover.target(best.position, -step * edge * way));
    }
  }
}

/// Moves to the best place by move(place), or where that is refused to places half as far.
// More than five parameters: a search by bisection, and what it is to stop at.
template <typename Move>
bool take(const Mover& mover, Point start, Best best, double enough, int halvings, Move move) {
  for (; best.energy <= enough; --halvings) {
    if (move(best.position)) return true;
    if (halvings == 0) return false;
    best.position = between(start, best.position);
    if (best.position == start || !mover.all_positive(best.position)) return false;
    best.energy = mover.energy(best.position, enough);
  }
  return false;
}

}  // namespace

Smoother::Smoother(TetMesh& mesh, const Metric& metric, const SmoothOptions& options,
                   DistanceGuard* guard, VolumeDebts* debts)
    : mesh_(mesh),
      metric_(metric),
      options_(options),
      limits_(EdgeLimits::of_moves(mesh, metric, options.sizes)),
      guard_(guard),
      debts_(debts),
      surface_energy_(options.surface.value_or(SurfaceWeights{})) {
  if (fits_interfaces() && options_.surface->with_pressure) {
    curvature_.measure(mesh, metric);
  }
  if (fits_interfaces() && options_.surface->line > 0.0) lines_.find(mesh);
}

void Smoother::collect_surface(LocalVertex v) {
  const SurfaceWeights& weights = *options_.surface;
  if (weights.bend > 0.0) {
    surface_.collect(mesh_, metric_, v);
    surface_.collect_rims(mesh_, metric_);
  } else {
    surface_.collect_triangles(mesh_, metric_, v);
  }
  surface_energy_.collect(mesh_, metric_, surface_, *guard_,
                          weights.with_pressure ? &curvature_ : nullptr, debts_);
  if (!(weights.line > 0.0)) return;
  const std::optional<LinePlace> place = lines_.place(mesh_, metric_, v);
  if (!place) return;
  surface_energy_.add_line(*place);
  if (!(weights.line_planes > 0.0)) return;
  surface_energy_.add_line_planes(metric_, mesh_.position(v), guard_->labels(), place->edge);
}

/// Returns the plane that v belongs to: it has the faces that v carries, and the vertices of the
/// ring or the faces that they carry.  If the ring carries other faces, v is on a step of a slope,
/// which must not become a staircase.  REQUIRES: the surface is collected.
std::optional<FlatPlane> Smoother::plane_to_keep(LocalVertex v) {
  const std::span<const FanTriangle> fan = surface_.fan();
  const std::optional<FlatPlane> plane = flat_plane(mesh_, *guard_, v, fan);
  if (!plane || (fixed_axes(mesh_.planes(v)) >> plane->axis & 1U) != 0) return std::nullopt;
  const bool belongs_there =
      has_ring(*plane, mesh_, fan) || wide_plane_.holds(*plane, mesh_, *guard_, fan);
  return belongs_there ? plane : std::nullopt;
}

bool Smoother::smooth(LocalVertex v) {
  const bool fitted = fits_interfaces() && mesh_.on_interface(v);
  star_.collect(mesh_, metric_, v);
  const StarShape present = star_.shape_at(Vec3::Zero());
  if (!fitted && present.worst >= options_.smooth_below) return false;
  if (fitted) collect_surface(v);
  const double min =
      min_allowed(present.worst, fitted ? kFloorOnSurface : kDecentRatio, options_.quality_floor);
  short_edges_.collect(star_);
  Mover mover(mesh_, metric_, {star_, short_edges_, fitted ? &surface_energy_ : nullptr}, v,
              present, min);
  const Point start = mesh_.position(v);
  const double present_energy = present.energy * (1.0 + short_edges_.value_at(Vec3::Zero()));
  Best best{start, present_energy};
  const std::optional<FlatPlane> plane = fitted ? plane_to_keep(v) : std::nullopt;
  if (plane) begin_in(*plane, mean_edge(surface_), mover, best);
  const double enough = best.position == start ? (1.0 - kMinGain) * present_energy : best.energy;
  search(mover, best, options_.newton_steps);
  const bool folded =
      fitted && options_.surface->bend > 0.0 && surface_energy_.min_cosine() < kSharpCosine;
  if (folded) search_around(mover, surface_, best);
  const int halvings = fitted && surface_energy_.has_specks() ? kHalvingsOfSpecks
                       : folded || limits_.any()              ? kHalvings
                                                              : 0;
  const bool moved =
      take(mover, start, best, enough, halvings, [&](Point x) { return move_to(v, x); });
  if (fitted && debts_ != nullptr) {
    debts_->set(v, surface_energy_.debts_at(metric_.vector(start, mesh_.position(v))));
  }
  return moved;
}

/// Moves v if the distance bound and the limits on edges allow it; returns whether it did.
bool Smoother::move_to(LocalVertex v, Point target) {
  if (!limits_.allow_star(v, v, target)) return false;
  const bool guarded = guard_ != nullptr && mesh_.on_interface(v);
  if (guarded && !fits_interfaces()) fan_.collect(mesh_, v, triangles_);
  const std::span<const FanTriangle> fan = fits_interfaces() ? surface_.fan() : triangles_;
  if (guarded && !guard_->allows_move(mesh_, v, fan, target)) return false;
  const Vec3 move = metric_.vector(mesh_.position(v), target);
  mesh_.move(v, target, mesh_.quadric(v).shifted(move));
  if (guarded) guard_->commit();
  return true;
}

}  // namespace mw
