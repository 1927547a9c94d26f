// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A row of centres is cut by the four planes of a tet.
#include "kernels/audit/partition/centres.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/core/lattice.h"
#include "kernels/core/tet_nodes.h"

namespace mw::audit {
namespace {

/// In units of the lattice, from the volume's first corner.
using CentrePoint = std::array<std::int64_t, 3>;
using CentreTet = std::array<CentrePoint, 4>;

/// Voxels from lo on; no more than hi.
struct CentreRange {
  std::int64_t lo = 0;
  std::int64_t hi = -1;
};

/// Farther vertices are taken to this distance, so that products fit 128 bits.
constexpr double kMostUnits = static_cast<double>(std::int64_t{1} << 40);

std::int64_t floor_ratio(std::int64_t a, std::int64_t b) {
  return a / b - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0);
}
std::int64_t ceil_ratio(std::int64_t a, std::int64_t b) {
  return -floor_ratio(-a, b);
}

/// Returns the voxels whose centres have coordinates from lo to hi; a voxel has `units`.
CentreRange centres_between(std::int64_t lo, std::int64_t hi, std::int64_t units,
                            std::int64_t voxels) {
  return {std::max<std::int64_t>(ceil_ratio(2 * lo - units, 2 * units), 0),
          std::min(floor_ratio(2 * hi - units, 2 * units), voxels - 1)};
}

/// The side of a plane through a facet on which the tet is.  Int holds products of three extents.
template <class Int>
class InnerSide {
 public:
  /// `inwards` is -1 for a normal that points out of the tet.
  InnerSide(const CentrePoint& a, const CentrePoint& b, const CentrePoint& c, int inwards)
      : at_(a) {
    std::array<Int, 3> p{}, q{};
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = static_cast<Int>(b[k] - a[k]);
      q[k] = static_cast<Int>(c[k] - a[k]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      normal_[k] = inwards * (p[i] * q[j] - p[j] * q[i]);
    }
    const auto first = std::find_if(normal_.begin(), normal_.end(), [](Int n) { return n != 0; });
    least_ = first != normal_.end() && *first > 0 ? 0 : 1;
  }

  /// Cuts off the voxels of a row that are outside.  The centre of the row's voxel 0 is `first`,
  /// and `units` are from one to the next.
  void cut(const CentrePoint& first, std::int64_t units, CentreRange& row) const {
    Int there = -least_;
    for (std::size_t k = 0; k < 3; ++k) there += normal_[k] * static_cast<Int>(first[k] - at_[k]);
    // A row of one voxel is as short as the tet, so that products of more steps fit in others.
    const Int step = row.hi == 0 ? 0 : normal_[0] * static_cast<Int>(units);
    const bool has_lo = there + step * row.lo >= 0, has_hi = there + step * row.hi >= 0;
    if (!has_lo && !has_hi) {
      row.hi = row.lo - 1;
    } else if (!has_lo) {
      row.lo = static_cast<std::int64_t>((step - 1 - there) / step);
    } else if (!has_hi) {
      row.hi = static_cast<std::int64_t>(there / -step);
    }
  }

 private:
  CentrePoint at_;
  std::array<Int, 3> normal_{};
  Int least_ = 0;  ///< what a point must reach: 0 where a point of the plane counts as inside
};

class CentreFinder {
 public:
  CentreFinder(Index3 shape, Index3 layers)
      : shape_(shape),
        units_{kUnitsPerVoxel * layers.x, kUnitsPerVoxel * layers.y, kUnitsPerVoxel * layers.z} {}

  [[nodiscard]] CentrePoint point(const Position& in_voxels) const {
    CentrePoint out{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double units = in_voxels[k] * static_cast<double>(units_[k]);
      out[k] =
          static_cast<std::int64_t>(std::nearbyint(std::clamp(units, -kMostUnits, kMostUnits)));
    }
    return out;
  }

  void add(const CentreTet& tet, Label label) {
    CentrePoint lo = tet[0], hi = tet[0];
    for (const CentrePoint& p : tet) {
      for (std::size_t k = 0; k < 3; ++k) {
        lo[k] = std::min(lo[k], p[k]);
        hi[k] = std::max(hi[k], p[k]);
      }
    }
    const std::array<std::int64_t, 3> voxels{shape_.x, shape_.y, shape_.z};
    std::array<CentreRange, 3> ranges{};
    std::int64_t extent = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      ranges[k] = centres_between(lo[k], hi[k], units_[k], voxels[k]);
      if (ranges[k].lo > ranges[k].hi) return;
      extent = std::max(extent, hi[k] - lo[k]);
    }
    extent <= kMaxTetExtent ? find<std::int64_t>(tet, ranges, label)
                            : find<Int128>(tet, ranges, label);
  }

  [[nodiscard]] std::vector<CentreRun> take() { return std::move(runs_); }

 private:
  template <class Int>
  void find(const CentreTet& tet, const std::array<CentreRange, 3>& ranges, Label label) {
    const int sign = sign_of<Int>(tet);
    if (sign == 0) return;
    const auto side = [&](std::size_t f) {
      return InnerSide<Int>(tet[kTetFacets[f][0]], tet[kTetFacets[f][1]], tet[kTetFacets[f][2]],
                            -sign);
    };
    const std::array<InnerSide<Int>, 4> sides{side(0), side(1), side(2), side(3)};
    for (std::int64_t z = ranges[2].lo; z <= ranges[2].hi; ++z) {
      for (std::int64_t y = ranges[1].lo; y <= ranges[1].hi; ++y) {
        CentreRange row{0, ranges[0].hi - ranges[0].lo};
        const CentrePoint first = centre({ranges[0].lo, y, z});
        for (std::size_t f = 0; f < 4 && row.lo <= row.hi; ++f) sides[f].cut(first, units_[0], row);
        if (row.lo > row.hi) continue;
        runs_.push_back({place({ranges[0].lo + row.lo, y, z}),
                         static_cast<std::uint32_t>(row.hi - row.lo + 1), label});
      }
    }
  }

  template <class Int>
  static int sign_of(const CentreTet& tet) {
    std::array<std::array<Int, 3>, 3> e{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) e[i][k] = static_cast<Int>(tet[i + 1][k] - tet[0][k]);
    }
    const Int det = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
                    e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
                    e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    return det > 0 ? 1 : det < 0 ? -1 : 0;
  }

  [[nodiscard]] CentrePoint centre(Index3 v) const {
    return {v.x * units_[0] + units_[0] / 2, v.y * units_[1] + units_[1] / 2,
            v.z * units_[2] + units_[2] / 2};
  }
  [[nodiscard]] std::uint64_t place(Index3 v) const {
    return static_cast<std::uint64_t>((v.z * shape_.y + v.y) * shape_.x + v.x);
  }

  Index3 shape_;
  std::array<std::int64_t, 3> units_;  ///< of a voxel's edges
  std::vector<CentreRun> runs_;
};

}  // namespace

std::vector<CentreRun> centre_runs(const MeshTile& tile, std::size_t label_count,
                                   const Frame& frame, Index3 shape, Index3 layers) {
  CentreFinder finder(shape, layers);
  const AuditMesh& mesh = tile.mesh;
  std::vector<CentrePoint> points;
  points.reserve(mesh.vertices.size());
  for (const Position& p : mesh.vertices) points.push_back(finder.point(frame.in_voxels(p)));
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (mesh.labels[t] >= label_count || !tile.owns_tet(t)) continue;
    const auto& [a, b, c, d] = mesh.tets[t];
    finder.add({points[a], points[b], points[c], points[d]}, mesh.labels[t]);
  }
  return finder.take();
}

std::vector<Label> centre_labels(std::span<const CentreRun> runs, const Box3& box, Index3 shape) {
  std::vector<Label> out(static_cast<std::size_t>(box.voxels()), kLeftOut);
  for (const CentreRun& run : runs) {
    const Box3 part = intersection(voxels_of(run, shape), box);
    if (is_empty(part)) continue;
    const auto begin = out.begin() + box.offset(part.lo);
    for (auto at = begin; at != begin + part.shape().x; ++at) *at = std::min(*at, run.label);
  }
  return out;
}

}  // namespace mw::audit
