// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A triangle surface that loses detail, for looking at it from afar.
#pragma once

#include <array>
#include <cstdint>
#include <queue>
#include <vector>

#include "kernels/quadric/quadric.h"

namespace mw {

/// Contracts edges of a surface, cheapest first by error quadrics (Garland and Heckbert), while
/// each point stays within a distance of where it was at first.
///
/// A contraction maps triangles linearly: a point is moved by no more than the corners of its
/// triangle are.  So each vertex keeps how far any point that it stands for was moved in all, and
/// the surface that is left lies within the greatest of these of the first one, and the first one
/// of it.
///
/// Only edges of two triangles are contracted, and only where the links of their ends meet in
/// nothing but the link of the edge; so no hole is made or filled, and thin parts stay.  Vertices
/// at edges of another number of triangles stay where they are.  No triangle turns over.
///
/// The new vertex lies where its triangles enclose as much as those that they replace (Lindstrom
/// and Turk), so that a closed surface keeps its volume, and a thin tube its thickness.  Two kinds
/// of contractions do not keep it: those to a vertex that stays where it is, and those of triangles
/// whose normals all but cancel, so that no place tells their volume.
///
/// ENSURES: the same surface gives the same result.  Memory: some 250 bytes a triangle.
class SurfaceDecimator {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// REQUIRES: corners are below the number of vertices, which is below 2^32.
  SurfaceDecimator(const std::vector<Vec3>& vertices, std::vector<Triangle> triangles);

  /// Contracts until no more edges can be.  bound is a length: how far from the first surface the
  /// rest may be, and the first one from it.  Cost: O(n log n).
  void decimate(double bound);

  /// What is left.
  struct Surface {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
  };
  [[nodiscard]] Surface surface() const;
  [[nodiscard]] std::size_t triangle_count() const { return left_; }

 private:
  struct Vertex {
    Vec3 place = Vec3::Zero();
    Quadric quadric;        ///< relative to place
    double moved = 0.0;     ///< the most that a point was moved which it stands for
    std::uint32_t age = 0;  ///< counts changes
    bool is_alive = true;
    bool is_fixed = false;
    std::vector<std::uint32_t> triangles;
  };

  /// An edge as it was when its ends had these ages.
  struct Candidate {
    double cost = 0.0;
    std::uint32_t keep = 0;
    std::uint32_t drop = 0;
    std::uint32_t keep_age = 0;
    std::uint32_t drop_age = 0;
  };
  struct IsDearer {
    bool operator()(const Candidate& a, const Candidate& b) const;
  };

  /// The points x where normal.dot(x) is `at`.
  struct Plane {
    Vec3 normal = Vec3::Zero();
    double at = 0.0;
  };

  void find_quadrics();
  void find_fixed();
  void push(std::uint32_t a, std::uint32_t b);
  [[nodiscard]] bool is_current(const Candidate& c) const;
  [[nodiscard]] Quadric sum_of(std::uint32_t keep, std::uint32_t drop) const;
  [[nodiscard]] std::array<Vec3, 3> places_for(std::uint32_t keep, std::uint32_t drop,
                                               const Quadric& sum) const;
  [[nodiscard]] Plane volume_plane(std::uint32_t keep, std::uint32_t drop) const;
  [[nodiscard]] std::vector<std::uint32_t> edge_ends(std::uint32_t v) const;
  [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t v) const;
  [[nodiscard]] bool keeps_topology(std::uint32_t keep, std::uint32_t drop) const;
  [[nodiscard]] bool spans(std::uint32_t v, std::uint32_t other,
                           const std::vector<std::uint32_t>& two) const;
  [[nodiscard]] double moved_to(const Vec3& place, std::uint32_t keep, std::uint32_t drop) const;
  [[nodiscard]] bool keeps_sides(std::uint32_t v, std::uint32_t other, const Vec3& place) const;
  void contract(std::uint32_t keep, std::uint32_t drop, const Vec3& place, double moved);

  std::vector<Vertex> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<bool> is_gone_;  ///< by triangle
  std::size_t left_;
  std::priority_queue<Candidate, std::vector<Candidate>, IsDearer> queue_;
};

}  // namespace mw
