// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Planes of the interface voxel faces at a corner, and its point term.
#include "kernels/start/corner_quadric.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <span>

#include "kernels/core/index.h"
#include "kernels/core/lanes.h"
#include "kernels/start/cells/cell.h"

namespace mw {
namespace {

constexpr std::int64_t kWide = 2;

/// The eight voxels around a corner, x fastest, from the lower to the higher side of each axis.
using Octant = std::array<Label, 8>;

Octant voxels_around(const LabelBox& labels, Index3 corner) {
  Octant out;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto bit = [i](unsigned axis) { return static_cast<std::int64_t>(i >> axis & 1U); };
    out[i] = labels.at(corner + Index3{bit(0) - 1, bit(1) - 1, bit(2) - 1});
  }
  return out;
}

/// Sums over the interface faces between two labels: normals from the lower label to the higher,
/// and centres relative to the corner, in half voxels.
struct PairFaces {
  LabelPair labels;
  std::int64_t count = 0;
  Index3 normal;
  Index3 centre;
};

/// Returns how far the centre of a voxel is from the corner along an axis, by its place in the 4^3
/// voxels around.
constexpr std::int64_t centre_of(std::size_t place) {
  return 2 * (static_cast<std::int64_t>(place) - kWide) + 1;
}

/// How many bits are set, and the sum of centre_of() over their places.
struct BitSums {
  std::int64_t count = 0;
  std::int64_t centre = 0;
};

constexpr std::array<BitSums, 16> kBitSums = [] {
  std::array<BitSums, 16> out{};
  for (unsigned bits = 0; bits < out.size(); ++bits) {
    for (unsigned place = 0; place < 4; ++place) {
      if ((bits >> place & 1U) == 0) continue;
      ++out[bits].count;
      out[bits].centre += centre_of(place);
    }
  }
  return out;
}();

/// The labels of the 4^3 voxels around a corner, x fastest; kExterior where a label does not meet
/// the corner.
class WideCube {
 public:
  WideCube(const StartLabels& labels, Index3 corner) {
    Octant meeting = voxels_around(labels.shape, corner);
    std::sort(meeting.begin(), meeting.end());
    const auto end = std::unique(meeting.begin(), meeting.end());
    const std::span<const Label> met(meeting.begin(), end);
    if (met.size() == 2) two_ = LabelPair{met[0], met[1]};
    const Index3 first = corner - Index3{kWide, kWide, kWide};
    const Box3& box = labels.original.box;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const auto y = static_cast<std::int64_t>(row % 4), z = static_cast<std::int64_t>(row / 4);
      const auto at = static_cast<std::size_t>(box.offset(first + Index3{0, y, z}));
      rows_[row] = only(met, labels.original.labels.data() + at);
    }
  }

  /// Adds up the faces of each pair of labels.
  [[nodiscard]] std::vector<PairFaces> faces() const {
    std::vector<PairFaces> out;
    if (two_) {
      const PairFaces faces = faces_of_two(*two_);
      if (faces.count > 0) out.push_back(faces);
      return out;
    }
    each_row([&](std::size_t row, unsigned axis, unsigned faces) {
      for (; faces != 0; faces &= faces - 1) {
        const auto x = static_cast<std::size_t>(std::countr_zero(faces));
        add(4 * row + x, axis, out);
      }
    });
    return out;
  }

 private:
  /// Labels of four voxels; kExterior is the number with all bits.
  static LaneInts only(std::span<const Label> met, const Label* row) {
    LaneInts labels;
    std::memcpy(&labels, row, sizeof labels);
    LaneInts meets{};
    for (const Label label : met) meets |= labels == static_cast<std::int32_t>(label);
    return labels | ~meets;
  }

  /// Calls visit(row, axis, faces) with one bit for each face above a voxel of the row, if there
  /// are some.
  template <class Visit>
  void each_row(Visit visit) const {
    for (unsigned axis = 0; axis < 3; ++axis) {
      for (std::size_t row = 0; row < rows_.size(); ++row) {
        const bool is_last = axis > 0 && (row >> 2 * (axis - 1) & 3U) == 3;
        if (is_last) continue;
        const unsigned faces = faces_above(row, axis);
        if (faces != 0) visit(row, axis, faces);
      }
    }
  }

  /// Adds up the faces of a row at once, where all are between the same labels.
  [[nodiscard]] PairFaces faces_of_two(LabelPair labels) const {
    PairFaces out{.labels = labels};
    each_row([&](std::size_t row, unsigned axis, unsigned faces) {
      const unsigned up = faces & lane_bits(rows_[row] == static_cast<std::int32_t>(labels.low));
      const std::int64_t count = kBitSums[faces].count;
      out.count += count;
      out.normal = out.normal + axis_vector(axis, 2 * kBitSums[up].count - count);
      out.centre =
          out.centre + axis_vector(axis, count) +
          Index3{kBitSums[faces].centre, count * centre_of(row % 4), count * centre_of(row / 4)};
    });
    return out;
  }

  /// Returns one bit for each voxel of the row whose label and that of the next voxel along the
  /// axis meet the corner and are not one.
  [[nodiscard]] unsigned faces_above(std::size_t row, unsigned axis) const {
    const LaneInts here = rows_[row];
    const LaneInts above = axis == 0 ? __builtin_shufflevector(here, here, 1, 2, 3, 3)
                                     : rows_[row + (axis == 1 ? 1 : 4)];
    return lane_bits((here != above) & (here != -1) & (above != -1));
  }

  [[nodiscard]] Label label(std::size_t voxel) const {
    return static_cast<Label>(rows_[voxel / 4][voxel % 4]);
  }

  void add(std::size_t below, unsigned axis, std::vector<PairFaces>& out) const {
    const Label under = label(below), above = label(below + (std::size_t{1} << 2 * axis));
    const LabelPair pair = label_pair(under, above);
    auto at =
        std::find_if(out.begin(), out.end(), [&](const PairFaces& p) { return p.labels == pair; });
    if (at == out.end()) at = out.insert(at, {.labels = pair});
    const auto centre = [below](unsigned k) { return centre_of(below >> (2 * k) & 3U); };
    ++at->count;
    at->normal = at->normal + axis_vector(axis, under == pair.low ? 1 : -1);
    at->centre = at->centre + Index3{centre(0), centre(1), centre(2)} + axis_vector(axis);
  }

  std::array<LaneInts, 16> rows_;  ///< along x
  std::optional<LabelPair> two_;   ///< the labels that meet the corner, if they are two
};

/// Adds one plane, weighted by the length of the sum of the faces' normals; none where they cancel.
void add_sheet(const PairFaces& faces, const StartOptions& options, Quadric& q) {
  const Vec3 voxel = options.metric.voxel();
  const double to_mean = 0.5 / static_cast<double>(faces.count);
  const Vec3 centre =
      to_mean * Vec3(static_cast<double>(faces.centre.x), static_cast<double>(faces.centre.y),
                     static_cast<double>(faces.centre.z));
  const Vec3 faces_along{static_cast<double>(faces.normal.x), static_cast<double>(faces.normal.y),
                         static_cast<double>(faces.normal.z)};
  const double count = faces_along.norm();
  if (count == 0.0) return;
  // A voxel face's area is inverse to the voxel's edge across it.
  const Vec3 area = faces_along.cwiseQuotient(voxel);
  q.add_plane(area / area.norm(), centre.cwiseProduct(voxel), options.weights.plane * count);
}

}  // namespace

Quadric wide_quadric(const StartLabels& labels, Index3 corner, const StartOptions& options) {
  const Octant around = voxels_around(labels.shape, corner);
  const bool inner = std::count(around.begin(), around.end(), around[0]) == 8;
  Quadric q;
  if (!inner) {
    for (const PairFaces& p : WideCube(labels, corner).faces()) add_sheet(p, options, q);
  }
  q.add_point(inner ? options.weights.inner_point : options.weights.boundary_point);
  return q;
}

Quadric corner_quadric(const LabelBox& labels, Index3 corner, const QuadricWeights& weights) {
  const Octant around = voxels_around(labels, corner);
  Quadric q;
  bool inner = true;
  for (std::size_t i = 0; i < 8; ++i) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const std::size_t j = i | std::size_t{1} << axis;
      if (i == j || around[i] == around[j]) continue;
      inner = false;
      if (around[i] != kExterior && around[j] != kExterior) {
        q.add_axis_plane(static_cast<int>(axis), weights.plane);
      }
    }
  }
  q.add_point(inner ? weights.inner_point : weights.boundary_point);
  return q;
}

}  // namespace mw
