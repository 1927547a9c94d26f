// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lines along z through the triangles of one tet.
#include "kernels/audit/partition/overlap.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "kernels/audit/partition/orientation.h"

namespace mw::audit {
namespace {

/// Where a line goes through a column: not on the lattice of 1/1024 voxel, and on no simple slope.
constexpr double kAtX = 0.41421356237309503;
constexpr double kAtY = 0.7320508075688772;
/// In voxels; rounding may put crossings that are nearer in the wrong order.
constexpr double kNear = 1e-6;

/// True if the line is in one tet at most, and in none at its end.
bool is_sound(std::span<const LineCrossing> line) {
  int inside = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    inside += line[i].enters;
    const bool is_last = i + 1 == line.size();
    if (!is_last && line[i + 1].z - line[i].z < kNear) continue;
    if (inside < 0 || inside > 1) return false;
  }
  return inside == 0;
}

class LineFinder {
 public:
  LineFinder(const MeshStars& stars, const Frame& frame, Index3 shape)
      : stars_(stars), frame_(frame), shape_(shape) {}

  std::vector<LineCrossing> run() {
    for_each_face(stars_, [&](const MeshFace& face) {
      if (face.sides.size() == 1) cross_lines(face);
    });
    return std::move(crossings_);
  }

 private:
  /// Twice the area of the triangle p, q, (x, y), seen along z.
  static double area2(const Position& p, const Position& q, double x, double y) {
    return (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
  }

  /// Returns 1 when the triangle's tet is on the side where z grows, -1 when it is on the other.
  [[nodiscard]] int side_of_tet(const MeshFace& face, double area) const {
    const auto& [a, b, c] = face.vertices;
    const auto& at = stars_.mesh().vertices;
    const TetRow& tet = stars_.mesh().tets[face.sides[0].tet];
    const Position& apex = at[tet[apex_of(tet, face.vertices)]];
    return orientation(at[a], at[b], at[c], apex) * (area > 0 ? 1 : -1);
  }

  void cross_lines(const MeshFace& face) {
    const auto& [a, b, c] = face.vertices;
    const auto& at = stars_.mesh().vertices;
    const std::array<Position, 3> p{frame_.in_voxels(at[a]), frame_.in_voxels(at[b]),
                                    frame_.in_voxels(at[c])};
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

  /// Finds the columns whose lines are between the least and largest coordinate, and some more.
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

  const MeshStars& stars_;
  Frame frame_;
  Index3 shape_;
  std::vector<LineCrossing> crossings_;
};

}  // namespace

std::vector<LineCrossing> line_crossings(const MeshStars& stars, const Frame& frame, Index3 shape) {
  return LineFinder(stars, frame, shape).run();
}

void OverlapCheck::add(const LineCrossing& crossing) {
  if (!line_.empty() && line_.front().column != crossing.column) end_line();
  line_.push_back(crossing);
}

void OverlapCheck::end_line() {
  if (line_.empty()) return;
  ++lines_;
  const std::uint64_t column = line_.front().column;
  const auto width = static_cast<std::uint64_t>(shape_.x);
  if (!is_sound(line_)) {
    crowded_.add([&] {
      return "voxel column " + std::to_string(column % width) + "," +
             std::to_string(column / width);
    });
  }
  line_.clear();
}

Check OverlapCheck::verdict() {
  end_line();
  return {"P2 overlap", crowded_.count() == 0,
          std::to_string(lines_) + " lines through the mesh; " + crowded_.text()};
}

}  // namespace mw::audit
