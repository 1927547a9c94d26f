// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Exact squared distances in the plane: along rows first, then across them.
#include "io/labels/slice_distances.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "kernels/core/sort_distinct.h"

namespace mw::io {
namespace {

/// A contour is half a pixel from the centres beside it.
constexpr double kHalf = 0.5;

/// Further than any distance that matters, and its square still fits.
constexpr std::int64_t kFar = 1 << 20;

double length(std::int64_t square) {
  return std::sqrt(static_cast<double>(square) / static_cast<double>(SliceSteps::kUnits));
}

std::int64_t square_of(double edge) {
  return std::llround(edge * edge * static_cast<double>(SliceSteps::kUnits));
}

std::int64_t pixels_within(std::int64_t length, std::int64_t square) {
  std::int64_t n = 0;
  while ((n + 1) * (n + 1) * square <= length * length * SliceSteps::kUnits) ++n;
  return n;
}

}  // namespace

SliceSteps::SliceSteps(const std::array<double, 2>& edges)
    : squares_{std::max<std::int64_t>(square_of(std::min(edges[0], double{kSight + 1})), 1),
               std::max<std::int64_t>(square_of(std::min(edges[1], double{kSight + 1})), 1)} {
  const Pixel most{pixels_within(kSight, squares_[0]), pixels_within(kSight, squares_[1])};
  for (std::int64_t v = -most.v; v <= most.v; ++v) {
    for (std::int64_t u = -most.u; u <= most.u; ++u) {
      const std::int64_t square = u * u * squares_[0] + v * v * squares_[1];
      if (square <= kSight2) steps_.push_back({square, {u, v}});
    }
  }
  std::sort(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) {
    return std::tie(a.square, a.by.v, a.by.u) < std::tie(b.square, b.by.v, b.by.u);
  });
}

Pixel SliceSteps::reach() const {
  // A label that is seen, a disc that covers its pixel, and what that disc ends at.
  const auto along = [](std::int64_t square) {
    return pixels_within(kSight, square) + 2 * pixels_within(kDepth, square);
  };
  return {along(squares_[0]), along(squares_[1])};
}

SliceDistances::SliceDistances(const SliceSteps& steps, Pixel shape, std::vector<RawLabel> labels)
    : steps_(&steps), shape_(shape), labels_(std::move(labels)) {
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    if (i == 0 || labels_[i] != labels_[i - 1]) present_.push_back(labels_[i]);
  }
  sort_distinct(present_);
}

std::vector<std::int64_t> SliceDistances::row_distances() const {
  std::vector<std::int64_t> out(labels_.size(), kFar);
  for (std::int64_t v = 0; v < shape_.v; ++v) {
    const std::size_t first = at({0, v}), end = first + static_cast<std::size_t>(shape_.u);
    for (std::size_t i = first + 1; i < end; ++i) {
      out[i] = labels_[i] != labels_[i - 1] ? 1 : std::min(out[i - 1] + 1, kFar);
    }
    for (std::size_t i = end - 1; i > first; --i) {
      const std::int64_t from = labels_[i] != labels_[i - 1] ? 1 : out[i] + 1;
      out[i - 1] = std::min(out[i - 1], from);
    }
  }
  return out;
}

std::int32_t SliceDistances::square_to_other(Pixel p,
                                             const std::vector<std::int64_t>& in_rows) const {
  const RawLabel own = label(p);
  const auto along = [&](std::size_t i) { return in_rows[i] * in_rows[i] * steps_->square_u(); };
  std::int64_t best = std::min(along(at(p)), SliceSteps::kDepth2);
  for (std::int64_t n = 1; n * n * steps_->square_v() < best; ++n) {
    const std::int64_t across = n * n * steps_->square_v();
    for (const Pixel q : {Pixel{p.u, p.v - n}, Pixel{p.u, p.v + n}}) {
      if (!contains(q)) continue;
      best = std::min(best, label(q) != own ? across : across + along(at(q)));
    }
  }
  return static_cast<std::int32_t>(best);
}

void SliceDistances::measure() {
  const std::vector<std::int64_t> in_rows = row_distances();
  squares_.reserve(labels_.size());
  for (std::int64_t v = 0; v < shape_.v; ++v) {
    for (std::int64_t u = 0; u < shape_.u; ++u) {
      squares_.push_back(square_to_other({u, v}, in_rows));
    }
  }
  radii2_.resize(labels_.size());
}

std::int32_t SliceDistances::radius2(Pixel p) {
  std::int32_t& best = radii2_[at(p)];
  if (best > 0) return best;
  best = squares_[at(p)];
  for (const SliceSteps::Step& step : steps_->steps()) {
    if (step.square >= SliceSteps::kDepth2 || best >= SliceSteps::kDepth2) break;
    const Pixel q{p.u + step.by.u, p.v + step.by.v};
    // A disc that reaches p has the label of p, as no other is in it.
    if (contains(q) && squares_[at(q)] > step.square) best = std::max(best, squares_[at(q)]);
  }
  return best;
}

LabelDepth SliceDistances::inside(Pixel p) {
  const double radius = std::max(length(radius2(p)) - kHalf, kHalf);
  const double depth = length(squares_[at(p)]) - kHalf;
  const double near = std::min(depth, radius);
  return {.depth = depth, .radius = radius, .height = near * (2 * radius - near)};
}

LabelDepth SliceDistances::outside(Pixel p, RawLabel label) {
  std::int64_t square = SliceSteps::kSight2;
  std::int32_t thickest = 0;
  if (std::binary_search(present_.begin(), present_.end(), label)) {
    const auto steps = steps_->steps();
    // No pixel of another label is nearer than this.
    const std::int64_t least = squares_[at(p)];
    auto step = std::lower_bound(
        steps.begin(), steps.end(), least,
        [](const SliceSteps::Step& s, std::int64_t wanted) { return s.square < wanted; });
    for (; step != steps.end() && (thickest == 0 || step->square == square); ++step) {
      const Pixel q{p.u + step->by.u, p.v + step->by.v};
      if (!contains(q) || labels_[at(q)] != label) continue;
      square = step->square;
      thickest = std::max(thickest, radius2(q));
    }
  }
  const double radius = std::max(length(thickest) - kHalf, kHalf);
  const double away = length(square) - kHalf;
  return {.depth = -away, .radius = radius, .height = -away * (2 * radius + away)};
}

LabelDepth SliceDistances::depth_of(Pixel p, RawLabel label) {
  if (squares_.empty()) measure();
  return labels_[at(p)] == label ? inside(p) : outside(p, label);
}

}  // namespace mw::io
