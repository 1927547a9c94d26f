// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Planes of the interface voxel faces at a corner, and its point term.
#include "kernels/lattice/corner_quadric.h"

#include <algorithm>

#include "kernels/core/each_index.h"
#include "kernels/lattice/cell_faces.h"

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
  Label low = 0;
  Label high = 0;
  std::int64_t count = 0;
  Index3 normal;
  Index3 centre;
};

class FacesByPair {
 public:
  /// The face between `below` and `above` along the axis, centred at `centre`.
  void add(Label below, Label above, unsigned axis, Index3 centre) {
    const auto [low, high] = std::minmax(below, above);
    auto at = std::find_if(
        pairs_.begin(), pairs_.end(),
        [&, l = low, h = high](const PairFaces& p) { return p.low == l && p.high == h; });
    if (at == pairs_.end()) at = pairs_.insert(at, {low, high, 0, {}, {}});
    ++at->count;
    at->normal = at->normal + axis_vector(axis, below == low ? 1 : -1);
    at->centre = at->centre + centre;
  }
  [[nodiscard]] const std::vector<PairFaces>& pairs() const { return pairs_; }

 private:
  std::vector<PairFaces> pairs_;
};

/// One plane; a sheet whose sides face each other has none, and is held at its centre instead.
void add_sheet(const PairFaces& faces, const QuadricWeights& weights, Quadric& q) {
  const double to_mean = 0.5 / static_cast<double>(faces.count);
  const Vec3 centre{static_cast<double>(faces.centre.x) * to_mean,
                    static_cast<double>(faces.centre.y) * to_mean,
                    static_cast<double>(faces.centre.z) * to_mean};
  const Vec3 normal{static_cast<double>(faces.normal.x), static_cast<double>(faces.normal.y),
                    static_cast<double>(faces.normal.z)};
  const double length = normal.norm();
  if (length > 0.0) q.add_plane(normal / length, centre, weights.plane * length);
}

}  // namespace

Quadric wide_quadric(const StartLabels& labels, Index3 corner, const QuadricWeights& weights) {
  const Octant around = voxels_around(labels.shape, corner);
  const auto meets = [&around](Label l) {
    return l != kExterior && std::find(around.begin(), around.end(), l) != around.end();
  };
  FacesByPair faces;
  const Index3 reach{kWide, kWide, kWide};
  each_index(Box3{Index3{0, 0, 0} - reach, reach}, [&](Index3 i) {
    const Label below = labels.original.at(corner + i);
    if (!meets(below)) return;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const Index3 j = i + axis_vector(axis);
      if (j.x == kWide || j.y == kWide || j.z == kWide) continue;
      const Label above = labels.original.at(corner + j);
      if (above == below || !meets(above)) continue;
      faces.add(below, above, axis, i + j + Index3{1, 1, 1});
    }
  });
  Quadric q;
  for (const PairFaces& p : faces.pairs()) add_sheet(p, weights, q);
  const bool inner = std::count(around.begin(), around.end(), around[0]) == 8;
  q.add_point(inner ? weights.inner_point : weights.boundary_point);
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
