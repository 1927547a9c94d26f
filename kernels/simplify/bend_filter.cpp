// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bend energies before and after a contraction.
#include "kernels/simplify/contraction_filters.h"

#include <algorithm>
#include <optional>

#include "kernels/core/assert.h"
#include "kernels/core/sort_distinct.h"
#include "kernels/surface/flat_plane.h"
#include "kernels/surface/thin_label.h"

namespace mw {
namespace {

/// A contraction must take out a fifth of the present bends, beside what is free
/// (bench/parameters.md, "Constants").
constexpr double kShareOfPresent = 0.8;
/// A junction that leaves its place to absorb a vertex of lower order must take out two fifths, and
/// nothing is free, because most junctions lie well (bench/parameters.md, "Constants").
constexpr double kShareOfMoved = 0.6;
/// The bend energy that other contractions may leave: between two labels, where surfaces are
/// smooth, and where more meet (bench/parameters.md, "Constants").
constexpr double kFreeBetweenTwo = 0.38;
constexpr double kFreeElsewhere = 0.55;
/// The most of both on a held sheet, which can only be even between the places where it is held if
/// vertices are left there (bench/parameters.md, "Thin labels").
constexpr double kShareWhereHeld = 0.6;
constexpr double kFreeWhereHeld = 0.1;

}  // namespace

bool BendFilter::stays_smooth(const Contraction& c) {
  Gathered &keep = star_of(c.keep, c.drop), &drop = star_of(c.drop, c.keep);
  if (leaves_plane(c, keep.star.fan(), drop.star.fan())) return false;
  merged_.merge(keep.star, metric_.vector(mesh_.position(c.keep), c.position), drop.star,
                metric_.vector(mesh_.position(c.drop), c.position));
  const bool two = mesh_.order(c.keep) == 2 && mesh_.order(c.drop) == 2;
  const bool leaves = c.moves && mesh_.order(c.keep) != mesh_.order(c.drop);
  const double free = leaves ? 0.0 : two ? kFreeBetweenTwo : kFreeElsewhere;
  const double share = leaves ? kShareOfMoved : kShareOfPresent;
  const double after = merged_.bends_at(Vec3::Zero());
  const double free_where_held = std::min(free, kFreeWhereHeld);
  if (after <= free_where_held) return true;
  const double present = present_bends(keep) + present_bends(drop);
  if (after > share * present + free) return false;
  // Few contractions are between the two, so few look at the input's labels.
  return after <= std::min(share, kShareWhereHeld) * present + free_where_held || !is_held_at(keep);
}

bool BendFilter::is_held_at(Gathered& g) {
  if (labels_ == nullptr) return false;
  if (g.is_held) return *g.is_held;
  const Point at = mesh_.position(g.star.vertex());
  const auto is_held = [&](Label label) {
    const std::optional<ThinLabel> thin = thin_label_at(*labels_, at, label);
    return thin && thin->is_held;
  };
  around_.clear();
  for (const SurfaceTriangle& t : g.star.triangles()) {
    around_.insert(around_.end(), {t.low, t.high});
  }
  sort_distinct(around_);
  g.is_held = std::any_of(around_.begin(), around_.end(), is_held);
  return *g.is_held;
}

/// True if the interface triangles at both ends lie in one plane across an axis and the survivor
/// would not.  Shapes may keep it from ever coming back.
bool BendFilter::leaves_plane(const Contraction& c, std::span<const FanTriangle> keep,
                              std::span<const FanTriangle> drop) const {
  if (keep.empty() || drop.empty()) return false;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const FlatPlane plane{.axis = axis, .place = along(mesh_.position(c.keep), axis)};
    if (along(c.position, axis) == plane.place) continue;
    if (has_ring(plane, mesh_, keep) && has_ring(plane, mesh_, drop)) return true;
  }
  return false;
}

double BendFilter::present_bends(Gathered& g) {
  if (!g.bends) g.bends = g.star.bends_at(Vec3::Zero());
  return *g.bends;
}

std::span<const FanTriangle> BendFilter::fan(LocalVertex end) const {
  const bool first = gathered_[0].is(end, mesh_.changes() + 1);
  MW_ASSERT(first || gathered_[1].is(end, mesh_.changes() + 1));
  return gathered_[first ? 0 : 1].star.fan();
}

/// Returns the star of v.  Keeps that of `other`, because candidates of a vertex share its star.
BendFilter::Gathered& BendFilter::star_of(LocalVertex v, LocalVertex other) {
  const std::uint64_t now = mesh_.changes() + 1;
  for (Gathered& g : gathered_) {
    if (g.is(v, now)) return g;
  }
  Gathered& g = gathered_[gathered_[0].is(other, now) ? 1 : 0];
  g.at = now;
  g.bends.reset();
  g.is_held.reset();
  g.star.collect(mesh_, metric_, v);
  g.star.collect_rims(mesh_, metric_);
  return g;
}

}  // namespace mw
