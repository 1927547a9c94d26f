// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Follows lines from vertex to vertex, and fits cubics to them.
#include "kernels/surface/line_field.h"

#include <algorithm>
#include <span>
#include <utility>

#include "kernels/surface/line_edges.h"

namespace mw {
namespace {

/// How far along a line vertices count, and how far from a cubic they may be in the mean for all of
/// them to count, in voxels: voxels make a line no more uneven (bench/parameters.md, "Lines").
constexpr double kReachOfLine = 6.0, kMostAstray = 0.25;
/// The place on a curve through more than a few vertices counts as much more, because their own
/// errors cancel (bench/parameters.md, "Lines").
constexpr double kShareOfMany = 2.0;
constexpr std::size_t kFew = 4;
/// A vertex at the end of the reach, which would count for less, is left out: a fit to places of no
/// weight would divide by rounding errors.
constexpr double kLeastShare = 1e-3;

/// The known vertices of a line around the one that is looked for, which is at 0.
class Curve {
 public:
  /// along: the length of the line from 0, negative on one side.
  void add(const Vec3& place, double along, double weight) {
    known_.push_back({place, along, weight});
  }
  [[nodiscard]] std::size_t size() const { return known_.size(); }

  /// Fits the cubic that is nearest to all that were added; of three vertices it is a parabola.
  /// It is a sum of polynomials that are orthogonal over the vertices (Forsythe).
  /// REQUIRES: three at least.
  void fit() {
    constexpr std::size_t kTerms = 4;
    at_zero_ = Vec3::Zero();
    astray_ = weights_ = 0.0;
    for (const Known& k : known_) {
      astray_ += k.weight * k.place.squaredNorm();
      weights_ += k.weight;
    }
    double now_at_zero = 1.0, last_at_zero = 0.0, last_norm = 0.0;
    for (std::size_t degree = 0; degree < std::min(kTerms, known_.size()); ++degree) {
      double norm = 0.0, moment = 0.0;
      Vec3 product = Vec3::Zero();
      for (const Known& k : known_) {
        norm += k.weight * k.now * k.now;
        moment += k.weight * k.now * k.now * k.along;
        product += k.weight * k.now * k.place;
      }
      at_zero_ += now_at_zero / norm * product;
      astray_ -= product.squaredNorm() / norm;
      const double shift = moment / norm, back = degree == 0 ? 0.0 : norm / last_norm;
      for (Known& k : known_) {
        const double next = (k.along - shift) * k.now - back * k.last;
        k.last = std::exchange(k.now, next);
      }
      const double next_at_zero = -shift * now_at_zero - back * last_at_zero;
      last_at_zero = std::exchange(now_at_zero, next_at_zero);
      last_norm = norm;
    }
  }
  [[nodiscard]] const Vec3& at_zero() const { return at_zero_; }
  /// The mean squared distance of the vertices from the curve.
  [[nodiscard]] double astray() const { return astray_ / weights_; }

 private:
  struct Known {
    Vec3 place;
    double along = 0.0;
    double weight = 0.0;
    double now = 1.0;   ///< value of the polynomial of the present degree
    double last = 0.0;  ///< and of the one before
  };

  std::vector<Known> known_;
  Vec3 at_zero_ = Vec3::Zero();
  double astray_ = 0.0;
  double weights_ = 0.0;
};

}  // namespace

void LineField::find(const TetMesh& mesh) {
  neighbours_.resize(mesh.vertex_count());
  LineEdges edges;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    neighbours_[v] = {v, v};
    if (!mesh.is_alive(v) || !mesh.is_free(v) || mesh.order(v) < kLabelsOfLine) continue;
    const std::span<const LocalVertex> ends = edges.at(mesh, v);
    if (ends.size() == 2) neighbours_[v] = {ends[0], ends[1]};
  }
}

/// Returns the neighbour of v on the other side than `from`.
std::optional<LocalVertex> LineField::beyond(LocalVertex v, LocalVertex from) const {
  if (!has(v)) return std::nullopt;
  return neighbours_[v][neighbours_[v][0] == from ? 1 : 0];
}

std::optional<LinePlace> LineField::place(const TetMesh& mesh, const Metric& metric,
                                          LocalVertex v) const {
  if (!has(v)) return std::nullopt;
  const auto [p, q] = neighbours_[v];
  if (!has(p) && !has(q)) return std::nullopt;
  const Point origin = mesh.position(v);
  const auto to = [&](LocalVertex w) { return metric.vector(origin, mesh.position(w)); };
  const Vec3 to_p = to(p), to_q = to(q), way = to_q - to_p;
  const double chord = way.norm(), mean = 0.5 * (to_p.norm() + to_q.norm());
  if (!(chord > 0.0)) return std::nullopt;
  const double voxel = metric.voxel().minCoeff(), reach = kReachOfLine * voxel;
  // Lengths count as half the mean at least: the curve would swing out beside a short edge.
  const auto add_side = [&](LocalVertex first, double sign, std::size_t most, Curve& curve) {
    LocalVertex last = v, w = first;
    Vec3 before = Vec3::Zero();
    double along = 0.0;
    for (std::size_t count = 0; count < most && w != v; ++count) {
      const Vec3 place = to(w);
      along += std::max((place - before).norm(), 0.5 * mean);
      const double share = 1.0 - along * along / (reach * reach);
      if (most > kFew && !(share > kLeastShare)) return;
      curve.add(place, sign * along, most > kFew ? share * share : 1.0);
      const std::optional<LocalVertex> next = beyond(w, last);
      if (!next) return;
      last = std::exchange(w, *next);
      before = place;
    }
  };
  const auto curve_of = [&](std::size_t most) {
    Curve curve;
    add_side(p, -1.0, most, curve);
    add_side(q, 1.0, most, curve);
    return curve;
  };
  constexpr std::size_t kMany = 32;
  if (Curve wide = curve_of(kMany); wide.size() > kFew) {
    wide.fit();
    const double most = kMostAstray * voxel;
    if (wide.astray() < most * most) {
      return LinePlace{wide.at_zero(), way / chord, mean, kShareOfMany};
    }
  }
  Curve near = curve_of(kFew / 2);
  near.fit();
  return LinePlace{near.at_zero(), way / chord, mean};
}

}  // namespace mw
