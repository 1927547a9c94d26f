// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Low-pass filters on the graph of voxel faces, in whole numbers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/source/face_graph.h"

namespace mw {

/// Filters for values that faces have.  Each result is a function of the values and labels within
/// kReach edges.  Both filters are polynomials of M, the operator that takes a face to the mean of
/// its neighbours.  To keep sharp edges, neighbours whose normals differ by more than some 12
/// degrees count less for each other, and from 22 degrees on not at all; the face counts instead.
/// Memory: 4 bytes a face, and up to 36 while a filter works.
class FaceFilter {
 public:
  /// The coordinates of a point or a vector, in any unit.
  using Value = std::array<std::int32_t, 3>;

  static constexpr int kNormalSteps = 5;  ///< steps before normals of neighbours are compared
  static constexpr int kSteps = 14;       ///< the degree of the filters
  static constexpr int kReach = kNormalSteps + kSteps;

  /// Keeps a reference to the graph.  normals are those of the faces, all of one length.
  FaceFilter(const FaceGraph& graph, std::vector<Value> normals);

  /// Applies (1/4 + 3/4 M)^kSteps, whose kernel has no negative values.
  void diffuse(std::vector<Value>& values) const;

  /// Applies the polynomial p of degree kSteps with p(1) = 1 and p'(1) = p''(1) = 0 for which the
  /// integral of p^2 from -1 to 0.9 is least.  So a bias begins with the sixth derivatives of a
  /// surface, while the steps of its voxels fade as much as they can.  REQUIRES: values below 2^26.
  void smooth(std::vector<Value>& values) const;

  /// The coefficients of the Chebyshev polynomials in p, in units of 2^-16.
  static constexpr std::array<std::int64_t, kSteps + 1> kShares{9158,  16997, 16089, 12774, 10365,
                                                                6132,  3577,  -172,  -1499, -3682,
                                                                -2981, -3353, -724,  -256,  3111};

 private:
  /// The weight of each edge; kFullWeight counts as 1.
  using Weights = std::array<std::uint8_t, 4>;

  [[nodiscard]] std::int64_t way(const std::vector<Value>& values, std::size_t face,
                                 std::size_t coordinate) const;
  void diffuse(std::vector<Value>& values, int steps) const;
  [[nodiscard]] std::vector<Value> mean(const std::vector<Value>& values) const;
  void next_chebyshev(const std::vector<Value>& present, std::vector<Value>& before) const;
  void weigh(const std::vector<Value>& normals);

  const FaceGraph& graph_;
  std::vector<Weights> weights_;
};

}  // namespace mw
