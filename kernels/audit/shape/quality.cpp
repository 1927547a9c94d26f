// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Radius ratios and dihedral angles.
#include "kernels/audit/shape/quality.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "kernels/core/lanes.h"
#include "kernels/core/vector3.h"

namespace mw::audit {
namespace {

/// Pairs of corners, and of the faces opposite to them.
constexpr std::array<std::array<std::size_t, 2>, 6> kPairs{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Stands for the cosine between faces of which one has no area.
constexpr double kNoCosine = 2;

/// The corners of four tets, coordinate by coordinate.
using CornerLanes = std::array<StoredLanes, 12>;

/// What is measured of four tets.
struct TetFigures {
  StoredLanes ratios;
  StoredLanes heights;                 ///< the least of four, or 0 where no face has an area
  StoredLanes shortest, longest;       ///< edges
  std::array<StoredLanes, 6> lengths;  ///< of the edges, by pair
  std::array<StoredLanes, 6> cosines;  ///< of dihedral angles, by pair
};

/// What all measures need: edges from a, and normals of the faces opposite to a, b, c, d, as long
/// as twice the face's area, all outward or all inward.
struct TetShape {
  std::array<Lanes3, 6> edges;  ///< by pair, from the first corner
  std::array<Lanes3, 4> normals;
  std::array<Lanes, 4> lengths;  ///< of the normals
};

MW_LANES Lanes length_of(const Lanes3& v) {
  return root(dot(v, v));
}

MW_LANES Lanes3 corner_lanes(const CornerLanes& corners, std::size_t i) {
  return {load(corners[3 * i]), load(corners[3 * i + 1]), load(corners[3 * i + 2])};
}

MW_LANES TetShape shape_of(const CornerLanes& corners) {
  const Lanes3 a = corner_lanes(corners, 0), b = corner_lanes(corners, 1),
               c = corner_lanes(corners, 2), d = corner_lanes(corners, 3);
  TetShape out{.edges = {b - a, c - a, d - a, c - b, d - b, d - c}, .normals = {}, .lengths = {}};
  out.normals = {cross(out.edges[3], out.edges[4]), cross(out.edges[2], out.edges[1]),
                 cross(out.edges[0], out.edges[2]), cross(out.edges[1], out.edges[0])};
  for (std::size_t i = 0; i < 4; ++i) out.lengths[i] = length_of(out.normals[i]);
  return out;
}

/// The share of one edge from a in n; see ratio_of().
MW_LANES Lanes3 weighted(const TetShape& tet, std::size_t i) {
  return dot(tet.edges[i], tet.edges[i]) * tet.normals[i + 1];
}

/// With D = 6 volume, S = total area and n = 2 D (circumcentre - a):
/// r_in = D / (2 S), r_circ = |n| / (2 |D|), hence 3 r_in / r_circ = 3 D^2 / (S |n|).
MW_LANES Lanes ratio_of(const TetShape& tet, const Lanes& det) {
  const auto& of_faces = tet.lengths;
  const Lanes area = (of_faces[0] + of_faces[1] + of_faces[2] + of_faces[3]) / 2.0;
  const Lanes below = area * length_of(weighted(tet, 0) + weighted(tet, 1) + weighted(tet, 2));
  const Lanes ratio = 3.0 * det * det / below, none = lanes(0.0), one = lanes(1.0);
  const Lanes most = one < ratio ? one : ratio;
  return (below > none) & (ratio > none) ? most : none;  // 0 also where squares overflow
}

MW_LANES Lanes least_height(const TetShape& tet, const Lanes& det) {
  Lanes largest = tet.lengths[0];
  for (std::size_t i = 1; i < 4; ++i) {
    largest = largest < tet.lengths[i] ? tet.lengths[i] : largest;
  }
  const Lanes none = lanes(0.0);
  const Lanes size = (det < none ? -det : det) + none;  // no zero is negative
  return largest > none ? size / largest : none;
}

MW_WIDE void measure(const CornerLanes& corners, TetFigures& out) {
  const TetShape tet = shape_of(corners);
  const Lanes det = -dot(tet.edges[0], tet.normals[1]);
  store(ratio_of(tet, det), out.ratios);
  store(least_height(tet, det), out.heights);
  Lanes shortest = length_of(tet.edges[0]), longest = shortest;
  for (std::size_t pair = 0; pair < kPairs.size(); ++pair) {
    const auto [i, k] = kPairs[pair];
    const Lanes areas = tet.lengths[i] * tet.lengths[k];
    const Lanes cosine = -dot(tet.normals[i], tet.normals[k]) / areas, one = lanes(1.0);
    const Lanes within = cosine < -one ? -one : one < cosine ? one : cosine;
    store(areas == lanes(0.0) ? lanes(kNoCosine) : within, out.cosines[pair]);
    const Lanes length = length_of(tet.edges[pair]);
    shortest = length < shortest ? length : shortest;
    longest = longest < length ? length : longest;
    store(length, out.lengths[pair]);
  }
  store(shortest, out.shortest);
  store(longest, out.longest);
}

/// Takes up to four tets, of which the last one fills the other lanes.
TetFigures figures_of(std::span<const NumberedTet> tets) {
  CornerLanes corners;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const auto& tet = tets[std::min(lane, tets.size() - 1)].corners;
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i][lane] = tet[i / 3][i % 3];
  }
  TetFigures out;
  measure(corners, out);
  return out;
}

/// Rounds to the nearest, halves up, without a call to the C library.  REQUIRES: 0 <= x < 2^62.
std::int64_t rounded(double x) {
  const auto whole = static_cast<std::int64_t>(x);
  return whole + (x - static_cast<double>(whole) >= 0.5 ? 1 : 0);
}

/// The bins of dihedral angles by cosine.  Lattices are full of right angles and the like, which
/// rounding must not put on either side.
class DihedralBins {
 public:
  DihedralBins() {
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      const double share = static_cast<double>(i + 1) / static_cast<double>(ends_.size() + 1);
      ends_[i] = std::cos(share * std::numbers::pi) + 1e-9;
    }
    for (std::size_t slice = 0; slice < first_.size(); ++slice) {
      const double most = 2 * static_cast<double>(slice + 1) / kSlices - 1;
      while (first_[slice] < ends_.size() && ends_[first_[slice]] > most) ++first_[slice];
    }
  }

  /// REQUIRES: a cosine from -1 to 1.
  [[nodiscard]] std::size_t of(double cosine) const {
    const auto slice = static_cast<std::size_t>((cosine + 1) * (kSlices / 2.0));
    std::size_t bin = first_[std::min(slice, first_.size() - 1)];
    while (bin < ends_.size() && ends_[bin] > cosine) ++bin;
    return bin;
  }

 private:
  static constexpr std::size_t kSlices = 512;

  std::array<double, std::tuple_size_v<decltype(QualityReport::dihedral_histogram)> - 1> ends_{};
  std::array<std::size_t, kSlices> first_{};  ///< the first bin of each slice of cosines
};

/// Serves only the report, so a last bit that depends on the C library does no harm.
double degrees_of_cosine(double cosine) {
  return std::acos(cosine) * 180 / std::numbers::pi;
}

}  // namespace

double radius_ratio(const Position& a, const Position& b, const Position& c, const Position& d) {
  const NumberedTet tet{0, {a, b, c, d}};
  return figures_of({&tet, 1}).ratios[0];
}

void QualityMeter::add(const Position& a, const Position& b, const Position& c, const Position& d) {
  const NumberedTet tet{tets_, {a, b, c, d}};
  add({&tet, 1});
}

void QualityMeter::take_worst(std::uint64_t tet, double ratio) {
  const bool is_tie = ratio == report_.radius_ratio_min && tet < report_.worst_tet;
  if (tets_ > 0 && ratio >= report_.radius_ratio_min && !is_tie) return;
  report_.radius_ratio_min = ratio;
  report_.worst_tet = tet;
}

/// REQUIRES: called before the tets with these lengths are counted.
void QualityMeter::take_lengths(double shortest, double longest, double height) {
  const bool is_first = tets_ == 0;
  report_.edge_min = is_first ? shortest : std::min(report_.edge_min, shortest);
  report_.edge_max = is_first ? longest : std::max(report_.edge_max, longest);
  report_.height_min = is_first ? height : std::min(report_.height_min, height);
}

void QualityMeter::add(const QualityMeter& other, std::uint64_t first) {
  if (other.tets_ == 0) return;
  const QualityReport& lengths = other.report_;
  take_lengths(lengths.edge_min, lengths.edge_max, lengths.height_min);
  take_worst(first + other.report_.worst_tet, other.report_.radius_ratio_min);
  tets_ += other.tets_;
  slivers_ += other.slivers_;
  lengths_.add(other.lengths_);
  ratios_ += other.ratios_;
  largest_cosine_ = std::max(largest_cosine_, other.largest_cosine_);
  smallest_cosine_ = std::min(smallest_cosine_, other.smallest_cosine_);
  const auto add_bins = [](const auto& from, auto& to) {
    std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus<>());
  };
  add_bins(other.report_.radius_ratio_histogram, report_.radius_ratio_histogram);
  add_bins(other.report_.dihedral_histogram, report_.dihedral_histogram);
}

void QualityMeter::add(std::span<const NumberedTet> tets) {
  for (std::size_t first = 0; first < tets.size(); first += kLanes) {
    const auto group = tets.subspan(first, std::min(kLanes, tets.size() - first));
    const TetFigures figures = figures_of(group);
    for (std::size_t lane = 0; lane < group.size(); ++lane) {
      std::array<double, 6> cosines{};
      for (std::size_t pair = 0; pair < kPairs.size(); ++pair) {
        lengths_.add(figures.lengths[pair][lane]);
        cosines[pair] = figures.cosines[pair][lane];
      }
      take_lengths(figures.shortest[lane], figures.longest[lane], figures.heights[lane]);
      take_ratio(group[lane].number, figures.ratios[lane]);
      take_cosines(cosines);
    }
  }
}

void QualityMeter::take_ratio(std::uint64_t tet, double ratio) {
  take_worst(tet, ratio);
  ++tets_;
  ratios_ += rounded(ratio * kUnits);
  if (ratio < kSliverRadiusRatio) ++slivers_;
  const auto bins = report_.radius_ratio_histogram.size();
  const auto bin = static_cast<std::size_t>(ratio * static_cast<double>(bins));
  ++report_.radius_ratio_histogram[std::min(bin, bins - 1)];
}

void QualityMeter::take_cosines(const std::array<double, 6>& cosines) {
  static const DihedralBins bins;
  double largest = largest_cosine_, smallest = smallest_cosine_;
  for (const double cosine : cosines) {
    if (cosine == kNoCosine) continue;
    largest = std::max(largest, cosine);
    smallest = std::min(smallest, cosine);
    ++report_.dihedral_histogram[bins.of(cosine)];
  }
  largest_cosine_ = largest;
  smallest_cosine_ = smallest;
}

QualityReport QualityMeter::report() const {
  QualityReport report = report_;
  if (tets_ == 0) return report;
  const auto count = static_cast<double>(tets_);
  report.radius_ratio_mean = static_cast<double>(ratios_) / kUnits / count;
  report.edge_median = lengths_.median();
  report.sliver_fraction = static_cast<double>(slivers_) / count;
  if (largest_cosine_ < -1) return report;
  report.dihedral_min_deg = degrees_of_cosine(largest_cosine_);
  report.dihedral_max_deg = degrees_of_cosine(smallest_cosine_);
  return report;
}

QualityMeter tally_quality(const MeshTile& tile) {
  QualityMeter meter;
  std::vector<NumberedTet> group;
  const auto& at = tile.mesh.vertices;
  for (std::size_t t = 0; t < tile.mesh.tets.size(); ++t) {
    if (!tile.owns_tet(t)) continue;
    const auto& [a, b, c, d] = tile.mesh.tets[t];
    group.push_back({tile.tet_id(t), {at[a], at[b], at[c], at[d]}});
    if (group.size() < kLanes) continue;
    meter.add(group);
    group.clear();
  }
  meter.add(group);
  return meter;
}

}  // namespace mw::audit
