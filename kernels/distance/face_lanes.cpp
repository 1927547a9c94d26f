// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The formulas of kernels/core/face_sample.h on four faces at a time.
#include "kernels/distance/face_lanes.h"

namespace mw {
namespace {

using LaneWords = std::uint64_t __attribute__((vector_size(kLanes * sizeof(std::uint64_t))));

/// The lower voxels and the axes of four faces.
struct Unpacked {
  LaneInts x, y, z;
  LaneInts axis;
};

MW_LANES LaneInts field(const LaneWords& words, int shift, std::uint64_t mask) {
  return __builtin_convertvector(words >> shift & mask, LaneInts);
}

MW_LANES Unpacked unpack(const FaceGroup& faces) {
  constexpr auto kCoordinate = static_cast<std::uint64_t>(kMaxSampledVoxels - 1);
  LaneWords words;
  std::memcpy(&words, faces.samples.data(), sizeof words);
  return {field(words, 6, kCoordinate), field(words, 25, kCoordinate),
          field(words, 44, kCoordinate), field(words, 4, 3)};
}

/// Marks the faces whose lower voxel has the label, on any side.
MW_LANES LaneMask is_label(const Unpacked& faces, const LabelBox& labels, Label label) {
  const Index3 shape = labels.box.shape(), lo = labels.box.lo;
  const LaneInts rows =
      (faces.z - static_cast<std::int32_t>(lo.z)) * static_cast<std::int32_t>(shape.y) +
      (faces.y - static_cast<std::int32_t>(lo.y));
  const LaneInts places =
      rows * static_cast<std::int32_t>(shape.x) + (faces.x - static_cast<std::int32_t>(lo.x));
  const Label* all = labels.labels.data();
  const LaneMask found{all[places[0]], all[places[1]], all[places[2]], all[places[3]]};
  return (found & static_cast<std::int64_t>(kFirstSide - 1)) == static_cast<std::int64_t>(label);
}

/// Sums of the samples of some quarters: of their coordinates along the face's two axes, in voxels
/// from its lowest corner, and their number.
struct QuarterSums {
  double first = 0.0;
  double second = 0.0;
  double count = 0.0;
};

constexpr std::array<QuarterSums, kAllQuarters + 1> kQuarterSums = [] {
  std::array<QuarterSums, kAllQuarters + 1> out{};
  for (unsigned bits = 0; bits <= kAllQuarters; ++bits) {
    for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
      if ((bits >> quarter & 1U) == 0) continue;
      out[bits].first += 0.25 + 0.5 * (quarter & 1U);
      out[bits].second += 0.25 + 0.5 * (quarter >> 1 & 1U);
      out[bits].count += 1.0;
    }
  }
  return out;
}();

/// The three sums, lane by lane.
struct QuarterLanes {
  Lanes first, second, count;
};

MW_LANES QuarterLanes sums_of(const FaceGroup& faces) {
  constexpr QuarterSums kWhole = kQuarterSums[kAllQuarters];
  QuarterLanes out{lanes(kWhole.first), lanes(kWhole.second), lanes(kWhole.count)};
  const FaceSamples all = faces.samples[0] & faces.samples[1] & faces.samples[2] & faces.samples[3];
  if (quarters_of(all) == kAllQuarters) return out;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const QuarterSums& sums = kQuarterSums[quarters_of(faces.samples[k])];
    out.first[k] = sums.first;
    out.second[k] = sums.second;
    out.count[k] = sums.count;
  }
  return out;
}

/// All sums are exact, so that only the division rounds.
MW_WIDE void find_pieces(const FaceGroup& faces, const LabelBox& labels, Label low,
                         PieceGroup& out) {
  const Unpacked f = unpack(faces);
  const QuarterLanes sums = sums_of(faces);
  const Lanes one = lanes(1.0), &n = sums.count;
  const Lanes x = to_lanes(f.x), y = to_lanes(f.y), z = to_lanes(f.z);
  store((n * x + by_axis(f.axis, n, sums.first, sums.first)) / n, out.middles[0]);
  store((n * y + by_axis(f.axis, sums.first, n, sums.second)) / n, out.middles[1]);
  store((n * z + by_axis(f.axis, sums.second, sums.second, n)) / n, out.middles[2]);
  store(n, out.quarters);
  store(is_label(f, labels, low) ? one : -one, out.signs);
  std::memcpy(out.axes.data(), &f.axis, sizeof f.axis);
}

// More than five parameters: an innermost loop, which is compiled for several processors.
MW_WIDE unsigned find_centres(const FaceGroup& faces, const LabelBox& labels, Label low,
                              const Vec3& normal, double min_cosine, PointLanes& points) {
  const Unpacked f = unpack(faces);
  const Lanes on = lanes(1.0), off = lanes(0.5);
  store(to_lanes(f.x) + by_axis(f.axis, on, off, off), points[0]);
  store(to_lanes(f.y) + by_axis(f.axis, off, on, off), points[1]);
  store(to_lanes(f.z) + by_axis(f.axis, off, off, on), points[2]);
  const Lanes along = by_axis(f.axis, lanes(normal[0]), lanes(normal[1]), lanes(normal[2]));
  const Lanes cosine = is_label(f, labels, low) ? along : -along;
  return lane_bits(__builtin_convertvector(cosine >= min_cosine, LaneInts));
}

}  // namespace

PieceGroup pieces_of(const FaceGroup& faces, const LabelBox& labels, Label low) {
  PieceGroup out;
  out.size = faces.size;
  find_pieces(faces, labels, low, out);
  return out;
}

FaceCentres centres_of(const FaceGroup& faces, const LabelBox& labels, Label low,
                       const Vec3& unit_normal, double min_cosine) {
  FaceCentres out;
  const unsigned all = (1U << faces.size) - 1U;
  out.looking = all & find_centres(faces, labels, low, unit_normal, min_cosine, out.points);
  return out;
}

}  // namespace mw
