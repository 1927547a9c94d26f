// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Filters are steps of diffusion, and the recurrence of Chebyshev polynomials.
#include "kernels/source/face_graph.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/metric.h"

namespace mw {
namespace {

constexpr unsigned kWeightBits = 6;
constexpr double kFullWeight = 1 << kWeightBits;
/// Four full weights add up to 2^kWayBits.
constexpr unsigned kWayBits = kWeightBits + 2;
constexpr unsigned kShareBits = 16;

/// Faces count less for each other where the cosine of their normals is below kAlike, and not at
/// all from kUnlike down.
constexpr double kUnlike = 0.925, kAlike = 0.975;

using Value = FaceFilter::Value;
using Sums = std::array<std::int64_t, 3>;

std::int64_t rounded(std::int64_t value, unsigned bits) {
  return (value + (std::int64_t{1} << (bits - 1))) >> bits;
}

void add(std::vector<Sums>& sums, const std::vector<Value>& values, std::int64_t share) {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) sums[i][k] += share * values[i][k];
  }
}

Vec3 unit(const Value& v) {
  const Vec3 out(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
  const double length = out.norm();
  return length > 0.0 ? Vec3(out / length) : Vec3::Zero();
}

}  // namespace

FaceFilter::FaceFilter(const FaceGraph& graph, std::vector<Value> normals) : graph_(graph) {
  const auto full = static_cast<std::uint8_t>(kFullWeight);
  weights_.assign(graph.size(), {full, full, full, full});
  diffuse(normals, kNormalSteps);
  weigh(normals);
}

void FaceFilter::weigh(const std::vector<Value>& normals) {
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    for (std::size_t edge = 0; edge < 4; ++edge) {
      const double cosine = unit(normals[i]).dot(unit(normals[graph_.neighbours(i)[edge]]));
      const double share = std::clamp((cosine - kUnlike) / (kAlike - kUnlike), 0.0, 1.0);
      weights_[i][edge] = static_cast<std::uint8_t>(std::floor(kFullWeight * share + 0.5));
    }
  }
}

/// 2^kWayBits times the way from a face's value to the mean of its neighbours'.
std::int64_t FaceFilter::way(const std::vector<Value>& values, std::size_t face,
                             std::size_t coordinate) const {
  const FaceGraph::Neighbours& n = graph_.neighbours(face);
  const std::int64_t own = values[face][coordinate];
  std::int64_t out = 0;
  for (std::size_t edge = 0; edge < 4; ++edge) {
    out += weights_[face][edge] * (values[n[edge]][coordinate] - own);
  }
  return out;
}

void FaceFilter::diffuse(std::vector<Value>& values) const {
  diffuse(values, kSteps);
}

void FaceFilter::diffuse(std::vector<Value>& values, int steps) const {
  std::vector<Value> next(values.size());
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t move = rounded(3 * way(values, i, k), kWayBits + 2);
        next[i][k] = values[i][k] + static_cast<std::int32_t>(move);
      }
    }
    values.swap(next);
  }
}

std::vector<Value> FaceFilter::mean(const std::vector<Value>& values) const {
  std::vector<Value> out(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      out[i][k] = values[i][k] + static_cast<std::int32_t>(rounded(way(values, i, k), kWayBits));
    }
  }
  return out;
}

/// Replaces T(k - 1) by T(k + 1) = 2 M T(k) - T(k - 1).
void FaceFilter::next_chebyshev(const std::vector<Value>& present,
                                std::vector<Value>& before) const {
  for (std::size_t i = 0; i < present.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t twice = rounded(way(present, i, k), kWayBits - 1);
      before[i][k] = 2 * present[i][k] - before[i][k] + static_cast<std::int32_t>(twice);
    }
  }
}

void FaceFilter::smooth(std::vector<Value>& values) const {
  std::vector<Sums> sums(values.size());
  add(sums, values, kShares[0]);
  std::vector<Value> present = mean(values);
  add(sums, present, kShares[1]);
  for (std::size_t degree = 2; degree < kShares.size(); ++degree) {
    next_chebyshev(present, values);
    values.swap(present);
    add(sums, present, kShares[degree]);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      values[i][k] = static_cast<std::int32_t>(rounded(sums[i][k], kShareBits));
    }
  }
}

}  // namespace mw
