// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Compares lengths with the limits of both ends and of the label around.
#include "kernels/size/edge_limits.h"

#include <algorithm>

namespace mw {

bool EdgeLimits::is_within(Point a, Point b, double limit) const {
  return metric_.vector(a, b).squaredNorm() <= limit * limit;
}

bool EdgeLimits::is_short(LocalVertex v, LocalVertex w) const {
  constexpr double kShort = 0.6;
  const Point a = mesh_.position(v), b = mesh_.position(w);
  double limit = SizeField::kNoLimit;
  bool is_asked = false;
  for (const LinkTriangle& t : mesh_.star(v)) {
    if (t.label == kExterior || !t.has(w) || !sizes_->is_asked(t.label)) continue;
    limit = std::min(limit, sizes_->of_label(t.label));
    is_asked = true;
  }
  return is_asked && is_within(a, b, kShort * std::min({sizes_->at(a), sizes_->at(b), limit}));
}

bool EdgeLimits::star_keeps(LocalVertex v, LocalVertex without, Point x) const {
  const double at_x = sizes_->at(x), surely = sizes_->least() * sizes_->least();
  for (const LinkTriangle& t : mesh_.star(v)) {
    if (t.label == kExterior || t.has(without)) continue;
    const double limit = stretch_ * std::min(at_x, sizes_->of_label(t.label));
    for (const LocalVertex w : {t.a, t.b, t.c}) {
      const Point y = mesh_.position(w);
      const double squared = metric_.vector(x, y).squaredNorm();
      if (squared <= surely) continue;
      const double least = std::min(limit, stretch_ * sizes_->at(y));
      if (squared > least * least) return false;
    }
  }
  return true;
}

bool EdgeLimits::tet_keeps(const LocalTet& tet) const {
  if (tet.label == kExterior) return true;
  const double limit = sizes_->of_label(tet.label);
  for (std::size_t i = 0; i < 4; ++i) {
    const Point a = mesh_.position(tet.vertices[i]);
    const double at_a = std::min(limit, sizes_->at(a));
    for (std::size_t j = i + 1; j < 4; ++j) {
      const Point b = mesh_.position(tet.vertices[j]);
      if (!is_within(a, b, stretch_ * std::min(at_a, sizes_->at(b)))) return false;
    }
  }
  return true;
}

}  // namespace mw
