// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Shapes of all tets at a vertex, wherever the vertex is put: gathered once, evaluated often; and
// radius ratios of several tets at once.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "kernels/core/lanes.h"
#include "kernels/core/lattice.h"
#include "kernels/core/metric.h"
#include "kernels/mesh/tet_mesh.h"

namespace mw {

/// The least radius ratio of the real tets at v, and the sum of their energies.
struct StarShape {
  double worst = 1.0;
  double energy = 0.0;
};

/// A function of the position of v, with its derivatives.
struct StarTerms {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

enum class StarVerdict { kGood, kInverted, kLowQuality, kTooLong };

/// Whether tets are positive, in whole numbers; not known where they are large.
enum class ExactSigns { kPositive, kNotPositive, kUnknown };

/// The real tets at a vertex v as they were when it was collected.  Positions of v are offsets from
/// where it was then, in metric units.
/// The energy of a tet of radius ratio r is 1 / r, so that every tet counts, bad ones most; it is
/// infinite for r <= 0.  (Raising only the worst tet of a star, as max-min optimisation does,
/// leaves the mean radius ratio 0.05 to 0.1 lower at the same mesh size.)
/// Results do not depend on the processor.
class StarBatch {
 public:
  /// Keeps a reference: REQUIRES that the mesh does not change until the last question.  (Tets are
  /// gathered when they are asked for, as most contractions are refused by the first few.)
  void collect(const TetMesh& mesh, const Metric& metric, LocalVertex v);

  [[nodiscard]] StarShape shape_at(const Vec3& x);

  /// The sum of energies, which is infinite when a tet is below `min`.  Where it exceeds `enough`,
  /// a lower bound of it above `enough` may be returned.
  [[nodiscard]] double energy_at(const Vec3& x, double min, double enough);

  /// The sum of s^3 / v^2, s the sum of a tet's six squared edges and v its volume (times 6): a
  /// convex function of the position wherever all tets are positive, least for regular tets, and
  /// free of square roots.
  [[nodiscard]] StarTerms terms_at(const Vec3& x);

  /// Sets `out` to where the neighbours of v lie that are nearer to it than `radius`: each once, in
  /// the order of the tets.
  void find_near(double radius, std::vector<Vec3>& out);

  /// Whether all tets without the vertex `without` reach radius ratio `floor`, up to rounding in
  /// the last digits; inverted ones are found only up to rounding.  The tets that failed last are
  /// looked at first, because they are likely to fail again, and the first fault found is returned.
  [[nodiscard]] StarVerdict judge_at(const Vec3& x, LocalVertex without, double floor);

  /// Whether all tets without the vertex `without` are exactly positive, with v at an offset in
  /// lattice units from where it was.  Tets of less than 64 voxels are small enough for a verdict.
  [[nodiscard]] ExactSigns signs_at(Point x, LocalVertex without);

  /// Four tets; what is beyond the last one repeats it.
  struct Group {
    Group() {}                          // filled at once, so zeros are not needed
    std::array<StoredInts, 9> corners;  ///< x, y, z of a, b, c from v, in lattice units
    std::array<StoredInts, 3> rows;     ///< rows of a, b, c; (v, a, b, c) is positive
  };

 private:
  bool gather_group();
  void gather_all();
  [[nodiscard]] std::size_t used_lanes(std::size_t group) const {
    return std::min(kLanes, size_ - group * kLanes);
  }

  const TetMesh* mesh_ = nullptr;
  Vec3 unit_ = Vec3::Zero();  ///< edges of a lattice unit
  LocalVertex vertex_ = 0;
  std::size_t next_ = 0;  ///< triangle of the star to be gathered
  std::vector<Group> groups_;
  std::size_t size_ = 0;     ///< tets gathered
  std::size_t suspect_ = 0;  ///< the group that failed last
};

/// Up to four tets, each by its edges from one vertex to the other three.
struct TetLanes {
  std::array<StoredInts, 9> edges{};  ///< x, y, z of a, b, c, in lattice units

  void set(std::size_t lane, Point v, Point a, Point b, Point c) {
    std::size_t i = 0;
    for (const Point p : {a, b, c}) {
      edges[i++][lane] = p.x - v.x;
      edges[i++][lane] = p.y - v.y;
      edges[i++][lane] = p.z - v.z;
    }
  }
};

/// Returns one bit for each tet that does not reach the radius ratio `floor`, by the verdict of
/// reaches_ratio() (kernels/quality/quality.h), and any bit for lanes that were not set.
[[nodiscard]] unsigned below_ratio(const TetLanes& tets, const Metric& metric, double floor);

/// Returns radius_ratio() (kernels/quality/quality.h) of each tet, to the last bit, and any number
/// for lanes that were not set.
[[nodiscard]] StoredLanes radius_ratios(const TetLanes& tets, const Metric& metric);

}  // namespace mw
