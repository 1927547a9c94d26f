// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bends before and after.
#include "kernels/simplify/bend_filter.h"

#include <utility>

namespace mw {
namespace {

constexpr double kShareOfPresent = 0.8;
/// Bend energy that any contraction may leave: between two labels, where surfaces are smooth, and
/// where more meet.
constexpr double kFreeBetweenTwo = 0.5;
constexpr double kFreeElsewhere = 1.0;

}  // namespace

bool BendFilter::stays_smooth(const Contraction& c) {
  collect(c);
  merged_.merge(keep_, metric_.vector(mesh_.position(c.keep), c.position), drop_,
                metric_.vector(mesh_.position(c.drop), c.position));
  const bool two = mesh_.order(c.keep) == 2 && mesh_.order(c.drop) == 2;
  const double free = two ? kFreeBetweenTwo : kFreeElsewhere;
  const double after = merged_.bends_at(Vec3::Zero());
  if (after <= free) return true;
  return after <= kShareOfPresent * present_ + free;
}

void BendFilter::collect(const Contraction& c) {
  const std::uint64_t now = mesh_.changes() + 1;
  if (at_ == now && keep_.vertex() == c.keep && drop_.vertex() == c.drop) return;
  at_ = now;
  present_ = 0.0;
  for (const auto& [star, v] : {std::pair{&keep_, c.keep}, std::pair{&drop_, c.drop}}) {
    star->collect(mesh_, metric_, v);
    star->collect_rims(mesh_, metric_);
    present_ += star->bends_at(Vec3::Zero());
  }
}

}  // namespace mw
