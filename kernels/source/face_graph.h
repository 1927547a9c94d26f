// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxel faces between labels, which of them are neighbours on an interface, and low-pass filters on
// that graph, in whole numbers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/core/label.h"

namespace mw {

/// The faces between two labels of a box, each with four edges.  At an edge a face's neighbour is
/// the other face of the same two labels.  It has none where four such faces meet, or where the
/// interface ends.  Faces between a label and the exterior do not count.
/// Memory: 4 bytes a voxel, 20 a face.
class FaceGraph {
 public:
  struct Face {
    Index3 lower;  ///< the voxel on the face's lower side
    unsigned axis = 0;
    bool low_is_lower = true;  ///< the smaller label is on that side
  };
  /// The neighbour at each edge; a face is its own neighbour at an edge without another.
  using Neighbours = std::array<std::uint32_t, 4>;

  /// Keeps a reference to the labels.
  explicit FaceGraph(const LabelBox& labels);

  /// How many faces the graph of these labels has.
  [[nodiscard]] static std::size_t count(const LabelBox& labels);

  [[nodiscard]] std::size_t size() const { return faces_.size(); }
  /// Faces ascend with their lower voxel, x fastest, then with the axis.
  [[nodiscard]] Face face(std::size_t row) const;
  [[nodiscard]] const Neighbours& neighbours(std::size_t row) const { return neighbours_[row]; }

 private:
  [[nodiscard]] std::uint32_t row_of(Index3 lower, unsigned axis) const;
  [[nodiscard]] Label at(Index3 v) const {
    return labels_.box.contains(v) ? labels_.at(v) : kExterior;
  }
  [[nodiscard]] Neighbours find_neighbours(std::uint32_t row) const;

  const LabelBox& labels_;
  std::vector<std::uint32_t> firsts_;  ///< how many faces belong to voxels before each voxel
  std::vector<std::uint32_t> faces_;   ///< 8 * lower voxel + 2 * axis + low_is_lower
  std::vector<Neighbours> neighbours_;
};

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
