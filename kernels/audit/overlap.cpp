// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lines along z through the triangles of one tet.
#include "kernels/audit/overlap.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "kernels/audit/orientation.h"

namespace mw::audit {
namespace {

/// Where a line goes through a column: not on the lattice of 1/1024 voxel, nor on a simple slope.
constexpr double kAtX = 0.41421356237309503;
constexpr double kAtY = 0.7320508075688772;
/// Voxels; crossings that are nearer may be in the wrong order by rounding.
constexpr double kNear = 1e-6;

struct Crossing {
  std::uint64_t column = 0;
  double z = 0;
  int enters = 0;  ///< tets that begin there, less those that end
};

class OverlapAudit {
 public:
  OverlapAudit(const MeshStars& stars, const Frame& frame, Index3 shape)
      : stars_(stars), frame_(frame), shape_(shape) {}

  Check run() {
    visit_faces(stars_, [&](const MeshFace& face) {
      if (face.sides.size() == 1) cross_lines(face);
    });
    std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
      return std::tie(a.column, a.z) < std::tie(b.column, b.z);
    });
    Offenders crowded("lines along z through two tets at once");
    std::uint64_t lines = 0;
    for (std::size_t begin = 0, end = 0; begin < crossings_.size(); begin = end, ++lines) {
      const std::uint64_t column = crossings_[begin].column;
      while (end < crossings_.size() && crossings_[end].column == column) ++end;
      if (is_sound(begin, end)) continue;
      const auto width = static_cast<std::uint64_t>(shape_.x);
      crowded.add([&] {
        return "voxel column " + std::to_string(column % width) + "," +
               std::to_string(column / width);
      });
    }
    return {"P2 overlap", crowded.count() == 0,
            std::to_string(lines) + " lines through the mesh; " + crowded.text()};
  }

 private:
  [[nodiscard]] Position in_voxels(std::uint32_t vertex) const {
    Position out = stars_.mesh().vertices[vertex];
    for (std::size_t k = 0; k < 3; ++k) out[k] = (out[k] - frame_.origin[k]) / frame_.spacing[k];
    return out;
  }

  /// Twice the area of the triangle p, q, (x, y), seen along z.
  static double area2(const Position& p, const Position& q, double x, double y) {
    return (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
  }

  /// 1 when the triangle's tet is on the side where z grows.
  [[nodiscard]] int side_of_tet(const MeshFace& face, double area) const {
    const auto& [a, b, c] = face.vertices;
    const auto& at = stars_.mesh().vertices;
    for (const std::uint64_t v : stars_.mesh().tets[face.sides[0].tet]) {
      if (v == a || v == b || v == c) continue;
      return orientation(at[a], at[b], at[c], at[v]) * (area > 0 ? 1 : -1);
    }
    return 0;
  }

  void cross_lines(const MeshFace& face) {
    const std::array<Position, 3> p{in_voxels(face.vertices[0]), in_voxels(face.vertices[1]),
                                    in_voxels(face.vertices[2])};
    const double area = area2(p[0], p[1], p[2][0], p[2][1]);
    if (area == 0) return;
    const int enters = side_of_tet(face, area);
    const auto [x0, x1] = columns(p, 0, kAtX, shape_.x);
    const auto [y0, y1] = columns(p, 1, kAtY, shape_.y);
    for (std::int64_t y = y0; y < y1; ++y) {
      for (std::int64_t x = x0; x < x1; ++x) {
        cross_line(p, area, x, y, enters);
      }
    }
  }

  /// Columns whose lines are between the least and the largest coordinate, and some more.
  static std::pair<std::int64_t, std::int64_t> columns(const std::array<Position, 3>& p,
                                                       std::size_t axis, double at,
                                                       std::int64_t count) {
    const auto last = static_cast<double>(count);
    const auto [lo, hi] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
    return {static_cast<std::int64_t>(std::clamp(std::floor(lo - at), 0.0, last)),
            static_cast<std::int64_t>(std::clamp(std::ceil(hi - at) + 1, 0.0, last))};
  }

  /// Vertices ascend, so that triangles with a common edge agree on which side of it the line is.
  void cross_line(const std::array<Position, 3>& p, double area, std::int64_t x, std::int64_t y,
                  int enters) {
    const double at_x = static_cast<double>(x) + kAtX, at_y = static_cast<double>(y) + kAtY;
    const double ab = area2(p[0], p[1], at_x, at_y);
    const double bc = area2(p[1], p[2], at_x, at_y);
    const double ac = area2(p[0], p[2], at_x, at_y);
    if ((ab >= 0) != (bc >= 0) || (ab >= 0) == (ac >= 0)) return;
    const double z =
        p[0][2] + (p[1][2] - p[0][2]) * (-ac / area) + (p[2][2] - p[0][2]) * (ab / area);
    crossings_.push_back({static_cast<std::uint64_t>(y * shape_.x + x), z, enters});
  }

  [[nodiscard]] bool is_sound(std::size_t begin, std::size_t end) const {
    int inside = 0;
    for (std::size_t i = begin; i < end; ++i) {
      inside += crossings_[i].enters;
      const bool is_last = i + 1 == end;
      if (!is_last && crossings_[i + 1].z - crossings_[i].z < kNear) continue;
      if (inside < 0 || inside > 1) return false;
    }
    return inside == 0;
  }

  const MeshStars& stars_;
  Frame frame_;
  Index3 shape_;
  std::vector<Crossing> crossings_;
};

}  // namespace

Check check_overlap(const MeshStars& stars, const Frame& frame, Index3 shape) {
  return OverlapAudit(stars, frame, shape).run();
}

}  // namespace mw::audit
