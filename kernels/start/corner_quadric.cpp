// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Planes of the interface voxel faces at a corner, and its point term.
#include "kernels/start/corner_quadric.h"

#include <algorithm>

#include "kernels/core/index.h"
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

/// The labels of the 4^3 voxels around a corner, x fastest; kExterior where a label does not meet
/// the corner.
class WideCube {
 public:
  WideCube(const StartLabels& labels, Index3 corner) {
    const Octant around = voxels_around(labels.shape, corner);
    std::size_t i = 0;
    for_each_index(Box3{corner - Index3{kWide, kWide, kWide}, corner + Index3{kWide, kWide, kWide}},
                   [&](Index3 v) {
                     const Label l = labels.original.at(v);
                     const bool meets = std::find(around.begin(), around.end(), l) != around.end();
                     labels_[i++] = meets ? l : kExterior;
                   });
  }

  /// Adds up the faces of each pair of labels.
  [[nodiscard]] std::vector<PairFaces> faces() const {
    std::vector<PairFaces> out;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const std::size_t step = std::size_t{1} << (2 * axis);
      for (std::size_t i = 0; i < labels_.size(); ++i) {
        const bool last = (i >> (2 * axis) & 3U) == 3;
        if (last || labels_[i] == kExterior) continue;
        const Label above = labels_[i + step];
        if (above == labels_[i] || above == kExterior) continue;
        add(i, axis, above, out);
      }
    }
    return out;
  }

 private:
  void add(std::size_t below, unsigned axis, Label above, std::vector<PairFaces>& out) const {
    const LabelPair pair = label_pair(labels_[below], above);
    auto at =
        std::find_if(out.begin(), out.end(), [&](const PairFaces& p) { return p.labels == pair; });
    if (at == out.end()) at = out.insert(at, {.labels = pair});
    const auto centre = [below](unsigned k) {
      return 2 * (static_cast<std::int64_t>(below >> (2 * k) & 3U) - kWide) + 1;
    };
    ++at->count;
    at->normal = at->normal + axis_vector(axis, labels_[below] == pair.low ? 1 : -1);
    at->centre = at->centre + Index3{centre(0), centre(1), centre(2)} + axis_vector(axis);
  }

  std::array<Label, 64> labels_;
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
