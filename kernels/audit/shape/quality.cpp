// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Radius ratios and dihedral angles.
#include "kernels/audit/shape/quality.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "kernels/core/vector3.h"

namespace mw::audit {
namespace {

/// What both measures need: edges from a, and normals of the faces opposite to a, b, c, d, as long
/// as twice the face's area, all outward or all inward.
struct TetShape {
  TetShape(const Position& a, const Position& b, const Position& c, const Position& d)
      : edges{minus(b, a), minus(c, a), minus(d, a)} {
    normals[1] = cross(edges[2], edges[1]);
    normals[2] = cross(edges[0], edges[2]);
    normals[3] = cross(edges[1], edges[0]);
    normals[0] = cross(minus(c, b), minus(d, b));
    for (std::size_t i = 0; i < 4; ++i) lengths[i] = norm(normals[i]);
  }

  [[nodiscard]] double radius_ratio() const;
  /// Returns the least of the four heights, or 0 where a face has no area.
  [[nodiscard]] double least_height() const;

  std::array<Position, 3> edges;
  std::array<Position, 4> normals;
  std::array<double, 4> lengths{};
};

/// With D = 6 volume, S = total area and n = 2 D (circumcentre - a):
/// r_in = D / (2 S), r_circ = |n| / (2 |D|), hence 3 r_in / r_circ = 3 D^2 / (S |n|).
double TetShape::radius_ratio() const {
  const double det = -dot(edges[0], normals[1]);
  Position n{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double square = dot(edges[i], edges[i]);
    for (std::size_t k = 0; k < 3; ++k) n[k] += square * normals[i + 1][k];
  }
  const double area = (lengths[0] + lengths[1] + lengths[2] + lengths[3]) / 2;
  const double below = area * norm(n);
  const double ratio = 3 * det * det / below;
  return below > 0 && ratio > 0 ? std::min(ratio, 1.0) : 0;  // 0 also where squares overflow
}

double TetShape::least_height() const {
  const double largest = *std::max_element(lengths.begin(), lengths.end());
  return largest > 0 ? std::abs(dot(edges[0], normals[1])) / largest : 0;
}

std::array<double, 6> edge_lengths(const std::array<Position, 4>& corners) {
  std::array<double, 6> out{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = i + 1; k < 4; ++k) out[count++] = norm(minus(corners[k], corners[i]));
  }
  return out;
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

std::size_t dihedral_bin(double cosine) {
  static const DihedralBins bins;
  return bins.of(cosine);
}

/// Serves only the report, so a last bit that depends on the C library does no harm.
double degrees_of_cosine(double cosine) {
  return std::acos(cosine) * 180 / std::numbers::pi;
}

}  // namespace

double radius_ratio(const Position& a, const Position& b, const Position& c, const Position& d) {
  return TetShape(a, b, c, d).radius_ratio();
}

void QualityMeter::add(const Position& a, const Position& b, const Position& c, const Position& d) {
  add(tets_, {a, b, c, d});
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

void QualityMeter::add(std::uint64_t number, const std::array<Position, 4>& corners) {
  const TetShape tet(corners[0], corners[1], corners[2], corners[3]);
  const double ratio = tet.radius_ratio();
  const std::array<double, 6> edges = edge_lengths(corners);
  const auto [shortest, longest] = std::minmax_element(edges.begin(), edges.end());
  take_lengths(*shortest, *longest, tet.least_height());
  for (const double length : edges) lengths_.add(length);
  take_worst(number, ratio);
  ++tets_;
  ratios_ += static_cast<Int128>(std::round(ratio * kUnits));
  if (ratio < kSliverRadiusRatio) ++slivers_;
  const auto bins = report_.radius_ratio_histogram.size();
  const auto bin = static_cast<std::size_t>(ratio * static_cast<double>(bins));
  ++report_.radius_ratio_histogram[std::min(bin, bins - 1)];
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = i + 1; k < 4; ++k) {
      const double lengths = tet.lengths[i] * tet.lengths[k];
      if (lengths == 0) continue;
      const double cosine = std::clamp(-dot(tet.normals[i], tet.normals[k]) / lengths, -1., 1.);
      largest_cosine_ = std::max(largest_cosine_, cosine);
      smallest_cosine_ = std::min(smallest_cosine_, cosine);
      ++report_.dihedral_histogram[dihedral_bin(cosine)];
    }
  }
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
  const auto& at = tile.mesh.vertices;
  for (std::size_t t = 0; t < tile.mesh.tets.size(); ++t) {
    if (!tile.owns_tet(t)) continue;
    const auto& [a, b, c, d] = tile.mesh.tets[t];
    meter.add(tile.tet_id(t), {at[a], at[b], at[c], at[d]});
  }
  return meter;
}

}  // namespace mw::audit
