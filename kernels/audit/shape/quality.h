// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Shape of a mesh's tets (promise P3).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "kernels/audit/shape/length_bins.h"
#include "kernels/audit/subject.h"
#include "kernels/core/lattice.h"

namespace mw::audit {

/// Radius ratios below this are called slivers (paper, Table 3).
inline constexpr double kSliverRadiusRatio = 0.1;

/// Figures over all tets, in physical units.
struct QualityReport {
  double radius_ratio_min = 0;
  std::uint64_t worst_tet = 0;  ///< first tet with the least radius ratio
  double radius_ratio_mean = 0;
  std::array<std::uint64_t, 20> radius_ratio_histogram{};  ///< equal bins over [0, 1]
  /// Counts the dihedral angles of all tets, in bins of 5 degrees.
  std::array<std::uint64_t, 36> dihedral_histogram{};
  double sliver_fraction = 0;
  double dihedral_min_deg = 0;
  double dihedral_max_deg = 0;
  double edge_min = 0;
  double edge_max = 0;
  double edge_median = 0;  ///< an edge counts once for each tet that has it; within 0.1 %
  /// The least distance of a corner from the opposite face, by which explicit solvers step.
  double height_min = 0;
};

/// 3 r_in / r_circ: 1 for a regular tet, 0 for a flat one, whatever its orientation.
[[nodiscard]] double radius_ratio(const Position& a, const Position& b, const Position& c,
                                  const Position& d);

/// A tet of a mesh: its number there, and its corners.
struct NumberedTet {
  std::uint64_t number = 0;
  std::array<Position, 4> corners{};
};

/// Takes tets one after the other.  Sums are of whole numbers (radius ratios in units of 2^-40), so
/// that parts of a mesh may be measured apart, in any order.
class QualityMeter {
 public:
  /// Adds a tet under the number of those that came before.  REQUIRES: finite coordinates.
  void add(const Position& a, const Position& b, const Position& c, const Position& d);
  /// Adds tets, which are measured four at a time.  REQUIRES: finite coordinates.
  void add(std::span<const NumberedTet> tets);
  /// Adds what another one has taken.  The numbers of its tets count from `first` here.
  void add(const QualityMeter& other, std::uint64_t first = 0);
  /// Sums up all tets so far.
  [[nodiscard]] QualityReport report() const;

 private:
  static constexpr double kUnits = 1099511627776.0;

  void take_ratio(std::uint64_t tet, double ratio);
  void take_cosines(const std::array<double, 6>& cosines);
  void take_worst(std::uint64_t tet, double ratio);
  void take_lengths(double shortest, double longest, double height);

  LengthBins lengths_;
  QualityReport report_;  ///< without the figures that need the number of tets
  std::uint64_t tets_ = 0;
  std::uint64_t slivers_ = 0;
  Int128 ratios_ = 0;           ///< sum in units of 1 / kUnits
  double largest_cosine_ = -2;  ///< cosine of the sharpest dihedral angle
  double smallest_cosine_ = 2;  ///< cosine of the bluntest
};

/// Measures the tets that a tile owns, by their numbers in the whole mesh.  An empty mesh gives
/// zeros.  Flat tets count as radius ratio 0; faces without area are left out of the dihedral
/// angles.  REQUIRES: vertex rows in range, finite coordinates.  Cost: O(tets).
[[nodiscard]] QualityMeter tally_quality(const MeshTile& tile);

}  // namespace mw::audit
