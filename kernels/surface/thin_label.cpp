// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tries all cubes, and counts voxels, by rows of bits.
#include "kernels/surface/thin_label.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <numeric>

#include "kernels/core/index.h"
#include "kernels/core/lanes.h"

namespace mw {
namespace {

Index3 nearest_corner(Point place) {
  const auto nearest = [](std::int32_t units) {
    return (std::int64_t{units} + kUnitsPerVoxel / 2) / kUnitsPerVoxel;
  };
  return {nearest(place.x), nearest(place.y), nearest(place.z)};
}

/// Which of `count` voxels of a row have the label, one bit for each.
[[gnu::always_inline]] inline unsigned bits_of_row(const Label* row, std::size_t count,
                                                   Label label) {
  unsigned out = 0;
  if (count < kLanes) {
    for (std::size_t i = 0; i < count; ++i) {
      out |= (without_side(row[i]) == label ? 1U : 0U) << i;
    }
    return out;
  }
  for (std::size_t i = 0; i < count; i += kLanes) {
    const std::size_t first = std::min(i, count - kLanes);
    LaneInts four;
    std::memcpy(&four, row + first, sizeof four);
    four &= static_cast<std::int32_t>(without_side(kExterior));
    out |= lane_bits(four == static_cast<std::int32_t>(label)) << first;
  }
  return out;
}

/// The voxels of a label in the cube that reaches kReach voxels away from a corner, row by row
/// along x.
template <std::int64_t kReach>
class LabelRows {
 public:
  static constexpr std::size_t kSize = 2 * kReach;

  LabelRows(const LabelBox& labels, Index3 corner, Label label) {
    constexpr Index3 around{kReach, kReach, kReach};
    const Box3 cube{corner - around, corner + around}, box = intersection(cube, labels.box);
    if (is_empty(box)) return;
    const auto count = static_cast<std::size_t>(box.hi.x - box.lo.x);
    const Index3 n = labels.box.shape();
    const Label* plane = labels.labels.data() + labels.box.offset(box.lo);
    for (std::int64_t z = box.lo.z; z < box.hi.z; ++z, plane += n.y * n.x) {
      const Label* row = plane;
      for (std::int64_t y = box.lo.y; y < box.hi.y; ++y, row += n.x) {
        rows_[static_cast<std::size_t>(z - cube.lo.z)][static_cast<std::size_t>(y - cube.lo.y)] =
            count == kSize ? bits_of_row(row, kSize, label)
                           : bits_of_row(row, count, label) << (box.lo.x - cube.lo.x);
      }
    }
  }

  /// Returns one bit for each voxel of a row.
  [[nodiscard]] unsigned at(std::size_t z, std::size_t y) const { return rows_[z][y]; }

  /// True if no cube of 2^3 voxels has the label alone.
  [[nodiscard]] bool are_without_cubes() const {
    for (std::size_t z = 0; z + 1 < kSize; ++z) {
      unsigned pair = rows_[z][0] & rows_[z + 1][0];
      for (std::size_t y = 1; y < kSize; ++y) {
        const unsigned next = rows_[z][y] & rows_[z + 1][y], both = pair & next;
        if ((both & both >> 1U) != 0) return false;
        pair = next;
      }
    }
    return true;
  }

 private:
  std::array<std::array<unsigned, kSize>, kSize> rows_{};
};

/// How many voxels away from a corner its surroundings reach.
constexpr std::int64_t kAround = 4;

/// The voxels of a label around a corner.
struct Surroundings {
  int voxels = 0;
  std::array<unsigned, 3> layers{};  ///< a bit for each layer across an axis that has some

  /// True if there are some in every layer across some axis.
  [[nodiscard]] bool go_through() const {
    constexpr unsigned kAll = (1U << 2 * kAround) - 1;
    return std::any_of(layers.begin(), layers.end(), [](unsigned some) { return some == kAll; });
  }
  /// True if none are in the outermost layer.
  [[nodiscard]] bool are_inside() const {
    constexpr unsigned kOutermost = 1U | 1U << (2 * kAround - 1);
    return std::none_of(layers.begin(), layers.end(),
                        [](unsigned some) { return (some & kOutermost) != 0; });
  }
  /// True if all are in one layer across some axis.
  [[nodiscard]] bool are_flat() const {
    return std::any_of(layers.begin(), layers.end(),
                       [](unsigned some) { return std::has_single_bit(some); });
  }
};

Surroundings look_around(const LabelRows<kAround>& rows) {
  constexpr std::size_t kSize = LabelRows<kAround>::kSize;
  Surroundings out;
  for (std::size_t z = 0; z < kSize; ++z) {
    std::uint64_t of_layer = 0;
    for (std::size_t y = 0; y < kSize; ++y) {
      const unsigned found = rows.at(z, y);
      of_layer |= std::uint64_t{found} << (kSize * y);
      out.layers[0] |= found;
      out.layers[1] |= (found != 0 ? 1U : 0U) << y;
    }
    out.voxels += std::popcount(of_layer);
    out.layers[2] |= (of_layer != 0 ? 1U : 0U) << z;
  }
  return out;
}

/// Counts the edges between voxels at which two of the four voxels have the label, and touch by
/// this edge alone.
int count_touches(const LabelRows<kAround>& rows) {
  constexpr std::size_t kLast = LabelRows<kAround>::kSize - 1;
  const auto touches = [](unsigned a, unsigned b, unsigned c, unsigned d) {
    return std::popcount((a & d & ~b & ~c) | (b & c & ~a & ~d));
  };
  int sum = 0;
  for (std::size_t z = 0; z <= kLast; ++z) {
    for (std::size_t y = 0; y <= kLast; ++y) {
      const unsigned row = rows.at(z, y);
      const auto along_x = [&](unsigned next) {
        constexpr unsigned kAllButLast = (1U << kLast) - 1;
        return touches(row & kAllButLast, row >> 1U, next & kAllButLast, next >> 1U);
      };
      if (y < kLast) sum += along_x(rows.at(z, y + 1));
      if (z < kLast) sum += along_x(rows.at(z + 1, y));
      if (y == kLast || z == kLast) continue;
      sum += touches(row, rows.at(z, y + 1), rows.at(z + 1, y), rows.at(z + 1, y + 1));
    }
  }
  return sum;
}

/// The 8^3 voxels around a corner, one bit for each, layer by layer.
using Layers = std::array<std::uint64_t, 2 * kAround>;
constexpr std::uint64_t kFirstOfRows = 0x0101010101010101, kLastOfRows = kFirstOfRows << 7U;

/// Adds to a part what it touches by faces.  Returns whether there was any.
bool grow(const Layers& all, Layers& part) {
  const Layers before = part;
  for (std::size_t z = 0; z < part.size(); ++z) {
    const std::uint64_t own = before[z];
    const std::uint64_t in_layer =
        own | (own << 1U & ~kFirstOfRows) | (own >> 1U & ~kLastOfRows) | own << 8U | own >> 8U;
    const std::uint64_t below = z > 0 ? before[z - 1] : 0;
    const std::uint64_t above = z + 1 < part.size() ? before[z + 1] : 0;
    part[z] = (in_layer | below | above) & all[z];
  }
  return part != before;
}

/// True if none of these voxels is an outermost one.
bool are_inside(const Layers& part) {
  constexpr std::uint64_t kRim = kFirstOfRows | kLastOfRows | 0xff | std::uint64_t{0xff} << 56U;
  std::uint64_t any = 0;
  for (const std::uint64_t layer : part) any |= layer;
  return (any & kRim) == 0 && part.front() == 0 && part.back() == 0;
}

}  // namespace

std::optional<ThinLabel> thin_label_at(const LabelBox& labels, Point place, Label label) {
  constexpr std::int64_t kReachOfThin = 2, kReachOfSheet = 5;
  constexpr int kLeastOfSheet = 56, kLeastOfTouches = 16, kMostOfThread = 20, kMostOfSmall = 3;
  const Index3 corner = nearest_corner(place);
  if (!LabelRows<kReachOfThin>(labels, corner, label).are_without_cubes()) return std::nullopt;
  const LabelRows<kAround> near(labels, corner, label);
  const Surroundings around = look_around(near);
  const bool is_sheet = around.voxels >= kLeastOfSheet && !around.are_flat() &&
                        near.are_without_cubes() &&
                        LabelRows<kReachOfSheet>(labels, corner, label).are_without_cubes();
  return ThinLabel{
      .is_sheet = is_sheet,
      .is_held = is_sheet && count_touches(near) >= kLeastOfTouches,
      .is_thread = around.voxels <= kMostOfThread && around.go_through(),
      .is_speck = around.are_inside(),
      .is_small = around.voxels <= kMostOfSmall && !around.go_through(),
  };
}
int voxels_of_part(const LabelBox& labels, Point place, Label label) {
  const Index3 corner = nearest_corner(place), lo = corner - Index3{kAround, kAround, kAround};
  const LabelRows<kAround> rows(labels, corner, label);
  Layers all{}, part{};
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t kSize = LabelRows<kAround>::kSize;
  for_each_index(Box3{{0, 0, 0}, {kSize, kSize, kSize}}, [&](Index3 i) {
    const auto y = static_cast<std::size_t>(i.y), z = static_cast<std::size_t>(i.z);
    if ((rows.at(z, y) >> i.x & 1U) == 0) return;
    const std::uint64_t bit = std::uint64_t{1} << (i.x + kSize * i.y);
    all[z] |= bit;
    const Index3 v = lo + i;
    const auto square = [](std::int64_t voxel, std::int32_t units) {
      const std::int64_t off = voxel * kUnitsPerVoxel + kUnitsPerVoxel / 2 - units;
      return off * off;
    };
    const std::int64_t away = square(v.x, place.x) + square(v.y, place.y) + square(v.z, place.z);
    if (away >= least) return;
    least = away;
    part = {};
    part[z] = bit;
  });
  while (grow(all, part)) {
  }
  if (!are_inside(part)) return 0;
  return std::accumulate(part.begin(), part.end(), 0,
                         [](int sum, std::uint64_t layer) { return sum + std::popcount(layer); });
}

}  // namespace mw
