// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Faces clipped to columns of voxels.
#include "kernels/sample/tet_overlap.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/core/tet_nodes.h"
#include "kernels/core/vector3.h"

namespace mw {
namespace {

constexpr std::size_t kX = 0, kY = 1, kZ = 2;

/// A convex, flat polygon.  Each clip adds one corner at most.  A triangle gets six at most from
/// the clips to the slab, to the column and to the planes across it, which are parallel.
class Polygon {
 public:
  static constexpr std::size_t kMostCorners = 16;

  void add(const ImagePoint& corner) {
    if (size_ < kMostCorners) corners_[size_++] = corner;
  }
  [[nodiscard]] bool is_empty() const { return size_ < 3; }
  [[nodiscard]] std::span<const ImagePoint> corners() const { return {corners_.data(), size_}; }
  [[nodiscard]] double least(std::size_t axis) const {
    double out = corners_[0][axis];
    for (const ImagePoint& p : corners()) out = std::min(out, p[axis]);
    return out;
  }
  [[nodiscard]] double most(std::size_t axis) const {
    double out = corners_[0][axis];
    for (const ImagePoint& p : corners()) out = std::max(out, p[axis]);
    return out;
  }

 private:
  std::array<ImagePoint, kMostCorners> corners_;
  std::size_t size_ = 0;
};

enum class Keep { kBelow, kAbove };

/// The part on one side of the plane where the coordinate is `bound`.
Polygon clipped(const Polygon& polygon, std::size_t axis, double bound, Keep keep) {
  const auto is_kept = [&](const ImagePoint& p) {
    return keep == Keep::kAbove ? p[axis] >= bound : p[axis] <= bound;
  };
  Polygon out;
  const auto corners = polygon.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ImagePoint& a = corners[i];
    const ImagePoint& b = corners[i + 1 == corners.size() ? 0 : i + 1];
    if (is_kept(a)) out.add(a);
    if (is_kept(a) == is_kept(b)) continue;
    const double share = (bound - a[axis]) / (b[axis] - a[axis]);
    ImagePoint cut;
    for (std::size_t k = 0; k < 3; ++k) cut[k] = a[k] + share * (b[k] - a[k]);
    cut[axis] = bound;
    out.add(cut);
  }
  return out;
}

Polygon between(const Polygon& polygon, std::size_t axis, double lo, double hi) {
  if (polygon.least(axis) >= lo && polygon.most(axis) <= hi) return polygon;
  const Polygon above = clipped(polygon, axis, lo, Keep::kAbove);
  return above.is_empty() ? above : clipped(above, axis, hi, Keep::kBelow);
}

/// Area of the projection along x, and the integral of x - from over it; both have the sign of the
/// polygon's normal along x.
struct Integrals {
  double area = 0;
  double moment = 0;
};

Integrals integrals(const Polygon& polygon, double from) {
  Integrals out;
  const auto corners = polygon.corners();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const ImagePoint &a = corners[0], &b = corners[i - 1], &c = corners[i];
    const double area = ((b[kY] - a[kY]) * (c[kZ] - a[kZ]) - (c[kY] - a[kY]) * (b[kZ] - a[kZ])) / 2;
    out.area += area;
    out.moment += area * ((a[kX] - from) + (b[kX] - from) + (c[kX] - from)) / 3;
  }
  return out;
}

/// Adds to volumes[i] the integral over the polygon of x - (first + i), held within 0 and 1, which
/// is what lies in that voxel and below the polygon along x.
void add_below(Polygon rest, double first, std::span<double> volumes) {
  if (rest.least(kX) < first) rest = clipped(rest, kX, first, Keep::kAbove);
  for (std::size_t i = 0; i < volumes.size() && !rest.is_empty(); ++i) {
    const double lo = first + static_cast<double>(i), hi = lo + 1;
    if (rest.least(kX) >= hi) {
      volumes[i] += integrals(rest, hi).area;
      continue;
    }
    const Polygon above = rest.most(kX) <= hi ? Polygon() : clipped(rest, kX, hi, Keep::kAbove);
    const Polygon band = rest.most(kX) <= hi ? rest : clipped(rest, kX, hi, Keep::kBelow);
    volumes[i] += integrals(band, lo).moment + integrals(above, hi).area;
    rest = above;
  }
}

/// Polygons of a tet's faces.
using Faces = std::array<Polygon, 4>;

/// The whole numbers that the coordinates of the faces lie between; 0 and 0 if there is no face.
struct Extent {
  double lo = 0;
  double hi = 0;
};

Extent extent_of(const Faces& faces, std::size_t axis) {
  Extent out;
  bool is_first = true;
  for (const Polygon& face : faces) {
    if (face.is_empty()) continue;
    const double lo = std::floor(face.least(axis)), hi = std::ceil(face.most(axis));
    out.lo = is_first ? lo : std::min(out.lo, lo);
    out.hi = is_first ? hi : std::max(out.hi, hi);
    is_first = false;
  }
  return out;
}

Faces between(const Faces& faces, std::size_t axis, double lo) {
  Faces out;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!faces[f].is_empty()) out[f] = between(faces[f], axis, lo, lo + 1);
  }
  return out;
}

}  // namespace

TetOverlap::TetOverlap(const std::array<ImagePoint, 4>& corners) {
  constexpr double kFar = 0x1p40;  // beyond all images; whole numbers stay exact
  for (std::size_t k = 0; k < 3; ++k) {
    double least = corners[0][k];
    for (const ImagePoint& p : corners) least = std::min(least, p[k]);
    base_[k] = std::floor(std::clamp(least, -kFar, kFar));
  }
  for (std::size_t i = 0; i < 4; ++i) corners_[i] = minus(corners[i], base_);
  const double six = volume6(corners_[0], corners_[1], corners_[2], corners_[3]);
  if (six < 0) std::swap(corners_[2], corners_[3]);
  volume_ = std::abs(six) / 6;
}

Box3 TetOverlap::box(Index3 shape) const {
  const std::array<std::int64_t, 3> voxels{shape.x, shape.y, shape.z};
  std::array<std::int64_t, 3> lo{}, hi{};
  for (std::size_t k = 0; k < 3; ++k) {
    double most = corners_[0][k];
    for (const ImagePoint& p : corners_) most = std::max(most, p[k]);
    const auto inside = [&](double corner) {
      return static_cast<std::int64_t>(
          std::clamp(base_[k] + corner, 0.0, static_cast<double>(voxels[k])));
    };
    lo[k] = inside(0);
    hi[k] = inside(std::ceil(most));
  }
  return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
}

void TetOverlap::cut(const Box3& box,
                     const std::function<void(const CoveredRow& row)>& visit) const {
  const auto within = [&](const Faces& faces, std::size_t axis, std::int64_t lo, std::int64_t hi) {
    const Extent extent = extent_of(faces, axis);
    return Extent{std::max(extent.lo, static_cast<double>(lo) - base_[axis]),
                  std::min(extent.hi, static_cast<double>(hi) - base_[axis])};
  };
  const auto voxel = [&](std::size_t axis, double corner) {
    return static_cast<std::int64_t>(base_[axis] + corner);
  };
  Faces faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const std::size_t corner : kTetFacets[f]) faces[f].add(corners_[corner]);
  }
  std::vector<double> volumes;
  const Extent z_range = within(faces, kZ, box.lo.z, box.hi.z);
  for (double z = z_range.lo; z < z_range.hi; ++z) {
    const Faces slab = between(faces, kZ, z);
    const Extent y_range = within(slab, kY, box.lo.y, box.hi.y);
    for (double y = y_range.lo; y < y_range.hi; ++y) {
      const Faces column = between(slab, kY, y);
      const Extent x_range = within(column, kX, box.lo.x, box.hi.x);
      if (x_range.lo >= x_range.hi) continue;
      volumes.assign(static_cast<std::size_t>(x_range.hi - x_range.lo), 0.0);
      for (const Polygon& face : column) {
        if (!face.is_empty()) add_below(face, x_range.lo, volumes);
      }
      visit({{voxel(kX, x_range.lo), voxel(kY, y), voxel(kZ, z)}, volumes});
    }
  }
}

}  // namespace mw
