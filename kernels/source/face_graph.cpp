// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The four voxels around an edge tell which faces meet there.  Filters are steps of diffusion, and
// the recurrence of Chebyshev polynomials.
#include "kernels/source/face_graph.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/metric.h"
#include "kernels/start/cells/cell.h"

namespace mw {
namespace {

/// Calls visit(voxel, axis, low_is_lower) on the faces of a box, in order.
template <typename Visit>
void each_face(const LabelBox& labels, Visit visit) {
  const Index3 shape = labels.box.shape();
  const std::array<std::int64_t, 3> strides{1, shape.x, shape.x * shape.y};
  std::size_t voxel = 0;
  for_each_index(shape, [&](Index3 v) {
    const Label below = labels.labels[voxel];
    const std::array<bool, 3> has_upper{v.x + 1 < shape.x, v.y + 1 < shape.y, v.z + 1 < shape.z};
    for (unsigned axis = 0; axis < 3 && below != kExterior; ++axis) {
      if (!has_upper[axis]) continue;
      const Label above = labels.labels[voxel + static_cast<std::size_t>(strides[axis])];
      if (above != below && above != kExterior) visit(voxel, axis, below < above);
    }
    ++voxel;
  });
}

}  // namespace

std::size_t FaceGraph::count(const LabelBox& labels) {
  std::size_t out = 0;
  each_face(labels, [&](std::size_t, unsigned, bool) { ++out; });
  return out;
}

FaceGraph::FaceGraph(const LabelBox& labels) : labels_(labels), firsts_(labels.labels.size()) {
  faces_.reserve(count(labels));
  std::size_t next = 0;  // the first voxel whose entry is not known
  const auto know = [&](std::size_t end) {
    for (; next < end; ++next) firsts_[next] = static_cast<std::uint32_t>(faces_.size());
  };
  each_face(labels, [&](std::size_t voxel, unsigned axis, bool low_is_lower) {
    know(voxel + 1);
    faces_.push_back(static_cast<std::uint32_t>(8 * voxel + 2 * axis) + (low_is_lower ? 1U : 0U));
  });
  know(firsts_.size());
  neighbours_.reserve(faces_.size());
  for (std::uint32_t row = 0; row < faces_.size(); ++row) {
    neighbours_.push_back(find_neighbours(row));
  }
}

FaceGraph::Face FaceGraph::face(std::size_t row) const {
  const std::uint32_t packed = faces_[row];
  const std::int64_t voxel = packed >> 3;
  const Index3 shape = labels_.box.shape();
  const Index3 from_lo{voxel % shape.x, voxel / shape.x % shape.y, voxel / (shape.x * shape.y)};
  return {labels_.box.lo + from_lo, packed >> 1 & 3U, (packed & 1U) != 0};
}

/// REQUIRES: the voxel has a face across the axis on its upper side.
std::uint32_t FaceGraph::row_of(Index3 lower, unsigned axis) const {
  std::uint32_t row = firsts_[static_cast<std::size_t>(labels_.box.offset(lower))];
  while ((faces_[row] >> 1 & 3U) != axis) ++row;
  return row;
}

FaceGraph::Neighbours FaceGraph::find_neighbours(std::uint32_t row) const {
  const Face f = face(row);
  const Index3 upper = f.lower + axis_vector(f.axis);
  const Label below = at(f.lower), above = at(upper);
  Neighbours out{row, row, row, row};
  std::size_t edge = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (axis == f.axis) continue;
    for (const bool up : {false, true}) {
      const Index3 step = axis_vector(axis, up ? 1 : -1);
      const Label beside_lower = at(f.lower + step), beside_upper = at(upper + step);
      // The face between a voxel and the one beside it.
      const auto across = [&](Index3 v) { return row_of(up ? v : v + step, axis); };
      if (beside_lower == below && beside_upper == above) {
        out[edge] = row_of(f.lower + step, f.axis);
      } else if (beside_lower == above && beside_upper != below) {
        out[edge] = across(f.lower);
      } else if (beside_upper == below && beside_lower != above) {
        out[edge] = across(upper);
      }
      ++edge;
    }
  }
  return out;
}

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
