// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Area and smoothness of the interfaces between labels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernels/audit/compensated_sum.h"
#include "kernels/audit/mesh_stars.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// Edges that bend by more are sharp.
inline constexpr double kSharpDegrees = 60;

/// Figures of the triangles between two labels, without the sides of the box.  The bend of an edge
/// is the angle between the normals of its two triangles, both out of the lower label: 0 where the
/// interface is flat.  Only edges at which exactly two triangles of the same two labels meet count.
/// An ideal mesh of a ball of radius r with edges of length e has about e / r radians.
struct ShapeReport {
  std::uint64_t triangles = 0;
  double area = 0;  ///< square physical units
  /// Percentiles of the bends by length of edge, to 0.05 degrees.
  double bend_p50_deg = 0;
  double bend_p95_deg = 0;
  double bend_p99_deg = 0;
  double bend_max_deg = 0;
  double sharp_share = 0;  ///< share of that length that bends by more than kSharpDegrees
  /// Shares of that length, in bins of 5 degrees.
  std::array<double, 36> bend_histogram{};
};

/// A triangle at an edge (p, q) by its third corner.
struct Wing {
  Position apex{};
  bool turned = false;  ///< (q - p) x (apex - p) points into the lower label
};

/// Takes triangles and edges one after the other.  Percentiles come from a histogram with bins of
/// 0.1 degrees, weights being added in the order of the calls: the same calls give the same bits.
/// Memory: 28 KiB.
class ShapeMeter {
 public:
  /// REQUIRES (all members): finite coordinates, physical units.
  void add_triangle(const Position& a, const Position& b, const Position& c);
  /// Adds an edge with its two triangles.
  void add_edge(const Position& p, const Position& q, const Wing& one, const Wing& other);
  /// Adds what another one has taken.
  void add(const ShapeMeter& other);
  /// Returns the sums over everything so far.
  [[nodiscard]] ShapeReport report() const;

 private:
  static constexpr std::size_t kBinsPerDegree = 10;

  [[nodiscard]] double percentile(double share, double total) const;

  std::uint64_t triangles_ = 0;
  CompensatedSum area_;
  std::vector<CompensatedSum> bins_ = std::vector<CompensatedSum>(180 * kBinsPerDegree);
  CompensatedSum length_;
  CompensatedSum sharp_length_;
  double largest_ = 0;
};

/// Measures the triangles and edges that a tile owns.  Triangles with three tets or more, and those
/// between labels that are not the volume's (which all count as one), are no interfaces.
/// REQUIRES: finite vertices.  Memory: 72 bytes an interface triangle.  Deterministic.
[[nodiscard]] ShapeMeter measure_shape(const MeshStars& stars);

}  // namespace mw::audit
