// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Runs of one label along 13 directions.
#include "kernels/size/thickness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "kernels/core/assert.h"
#include "kernels/core/index.h"

namespace mw {
namespace {

/// The 13 of the 26 neighbours that come later in x-fastest order.
constexpr std::array<Index3, 13> kDirections{{{1, 0, 0},
                                              {-1, 1, 0},
                                              {0, 1, 0},
                                              {1, 1, 0},
                                              {-1, -1, 1},
                                              {0, -1, 1},
                                              {1, -1, 1},
                                              {-1, 0, 1},
                                              {0, 0, 1},
                                              {1, 0, 1},
                                              {-1, 1, 1},
                                              {0, 1, 1},
                                              {1, 1, 1}}};

/// How much nearer a side may be along another direction.
constexpr double kNearest = 0.85;
/// kBeside steps away from the middle of a part, and kAlong steps from there along its thickness,
/// sides may be kFarther voxels farther away.
constexpr std::int64_t kBeside = 4, kAlong = 3;
constexpr double kFarther = 0.75;
/// Directions with a smaller cosine (more than 41 degrees) lead along a part and not through it.
constexpr double kThrough = 0.75;
constexpr float kNotThin = std::numeric_limits<float>::infinity();
constexpr std::uint8_t kOutOfReach = kThinReach + 1;  ///< no side within reach

class Thickness {
 public:
  Thickness(const LabelBox& labels, const Box3& asked, const Metric& metric)
      : labels_(labels),
        asked_(asked),
        around_(grown(asked, kBeside + kAlong)),
        metric_(metric),
        before_(labels.labels.size()),
        behind_(labels.labels.size()),
        nearest_(size(around_), kNotThin),
        thickness_(size(asked), kNotThin) {
    for (const Index3 d : kDirections) {
      find_runs(d);
      for_each(around_,
               [&](Index3 /*v*/, std::size_t i, std::size_t in) { take_nearest(d, i, in); });
    }
    for (const Index3 d : kDirections) {
      find_runs(d);
      const std::vector<Index3> steps = steps_beside(d);
      for_each(asked_, [&](Index3 v, std::size_t i, std::size_t in) {
        if (is_middle(d, v, in) && !grows(steps, v)) {
          const double thickness = (before_[in] + behind_[in] + 1) * length(d);
          thickness_[i] = std::min(thickness_[i], static_cast<float>(thickness));
        }
      });
    }
  }

  /// Infinity where the voxel is not in the middle of a thin part.  REQUIRES: it was asked for.
  [[nodiscard]] float at(Index3 voxel) const {
    return thickness_[static_cast<std::size_t>(asked_.offset(voxel))];
  }

 private:
  static std::size_t size(const Box3& box) { return static_cast<std::size_t>(box.voxels()); }

  template <class Visit>
  void for_each(const Box3& box, Visit visit) const {
    std::size_t i = 0;
    for_each_index(
        box, [&](Index3 v) { visit(v, i++, static_cast<std::size_t>(labels_.box.offset(v))); });
  }

  /// The steps from a voxel to those beside it in the part whose thickness is along d.
  static std::vector<Index3> steps_beside(Index3 d) {
    const auto product = [](Index3 a, Index3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    std::vector<Index3> out;
    for (const Index3 e : kDirections) {
      const double lengths = std::sqrt(static_cast<double>(product(d, d) * product(e, e)));
      if (std::abs(static_cast<double>(product(d, e))) >= kThrough * lengths) continue;
      for (std::int64_t k = -kAlong; k <= kAlong; ++k) {
        const Index3 along{k * d.x, k * d.y, k * d.z};
        const Index3 beside{kBeside * e.x, kBeside * e.y, kBeside * e.z};
        out.push_back(along + beside);
        out.push_back(along - beside);
      }
    }
    return out;
  }

  [[nodiscard]] double length(Index3 d) const {
    const Vec3 edges = metric_.voxel();
    return Vec3(edges[0] * static_cast<double>(d.x), edges[1] * static_cast<double>(d.y),
                edges[2] * static_cast<double>(d.z))
        .norm();
  }

  /// Counts the voxels of its label that come before and behind each voxel along d.
  void find_runs(Index3 d) {
    const Index3 shape = labels_.box.shape();
    const std::int64_t step = (d.z * shape.y + d.y) * shape.x + d.x;
    const Box3 all{{0, 0, 0}, shape};
    const auto run = [&](std::vector<std::uint8_t>& runs, Index3 v, std::int64_t i,
                         std::int64_t sign) {
      const Index3 other{v.x + sign * d.x, v.y + sign * d.y, v.z + sign * d.z};
      const auto here = static_cast<std::size_t>(i),
                 there = static_cast<std::size_t>(i + sign * step);
      if (!all.contains(other)) {
        runs[here] = kOutOfReach;
      } else if (labels_.labels[here] != labels_.labels[there]) {
        runs[here] = 0;
      } else {
        runs[here] =
            std::min<std::uint8_t>(kOutOfReach, static_cast<std::uint8_t>(runs[there] + 1));
      }
    };
    std::int64_t i = 0;
    for_each_index(shape, [&](Index3 v) { run(before_, v, i++, -1); });
    const Index3 last = shape - Index3{1, 1, 1};
    for_each_index(shape, [&](Index3 v) { run(behind_, last - v, --i, 1); });
  }

  /// Lowers nearest_ to the distance from the middle of the voxel to the nearer side along d.
  void take_nearest(Index3 d, std::size_t i, std::size_t in) {
    const std::uint8_t run = std::min(before_[in], behind_[in]);
    if (run == kOutOfReach) return;
    nearest_[i] = std::min(nearest_[i], static_cast<float>((run + 0.5) * length(d)));
  }

  [[nodiscard]] float nearest_at(Index3 v) const {
    return nearest_[static_cast<std::size_t>(around_.offset(v))];
  }

  [[nodiscard]] bool is_middle(Index3 d, Index3 v, std::size_t in) const {
    const int before = before_[in], behind = behind_[in];
    const double steps = std::sqrt(static_cast<double>(d.x * d.x + d.y * d.y + d.z * d.z));
    if (std::max(before, behind) * steps > kThinReach || std::abs(before - behind) > 1)
      return false;
    const double half = (std::min(before, behind) + 0.5) * length(d);
    return static_cast<double>(nearest_at(v)) >= kNearest * half;
  }

  /// Whether the label is thicker beside the voxel.
  [[nodiscard]] bool grows(const std::vector<Index3>& steps, Index3 v) const {
    const double farthest =
        static_cast<double>(nearest_at(v)) + kFarther * metric_.voxel().minCoeff();
    return std::ranges::any_of(steps, [&](Index3 step) {
      return labels_.at(v + step) == labels_.at(v) &&
             static_cast<double>(nearest_at(v + step)) > farthest;
    });
  }

  const LabelBox& labels_;
  Box3 asked_;
  Box3 around_;
  const Metric& metric_;
  std::vector<std::uint8_t> before_, behind_;
  std::vector<float> nearest_;
  std::vector<float> thickness_;
};

}  // namespace

void for_each_thin_voxel(const LabelBox& labels, const Box3& asked, const Metric& metric,
                         const std::function<void(Index3 voxel, double thickness)>& found) {
  MW_ASSERT(intersection(grown(asked, kThinHalo), labels.box) == grown(asked, kThinHalo));
  const Thickness thickness(labels, asked, metric);
  for_each_index(asked, [&](Index3 v) {
    const float own = thickness.at(v);
    if (own != kNotThin && labels.at(v) != kExterior) found(v, static_cast<double>(own));
  });
}

}  // namespace mw
