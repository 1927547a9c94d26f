// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The interface triangles at a vertex: how they meet each other and their neighbours, and curve.
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kernels/core/lanes.h"
#include "kernels/core/metric.h"
#include "kernels/distance/interface_fan.h"
#include "kernels/mesh/tet_mesh.h"
#include "kernels/topology/edge_ring.h"

namespace mw {

/// Bends whose 1 - cosine is below this, some 14 degrees, cost nothing, because curved surfaces
/// have them (bench/parameters.md, "Constants").
inline constexpr double kFreeBend = 0.03;
/// The cosine of a sharp bend, 60 degrees.
inline constexpr double kSharpCosine = 0.5;

/// How far a bend goes beyond what is free, by the cosine of the angle between the normals.
[[nodiscard]] inline double bend_excess(double cosine) {
  return std::max(0.0, 1.0 - cosine - kFreeBend);
}

/// Energy of a bend, which is the square of the excess.  It is 0 up to 14 degrees and about 4 at
/// 180, and it grows steeply where a surface turns back on itself.
[[nodiscard]] inline double bend_energy(double cosine) {
  const double excess = bend_excess(cosine);
  return excess * excess;
}

/// Energy of the bend between two normals of any length, from their dot product and the product of
/// their squared lengths; 0 when one is zero.  Most bends are free, which takes no root to see.
[[nodiscard]] inline double bend_energy(double product, double squares) {
  constexpr double kSurelyFree = 1.0 - 0.999 * kFreeBend;
  if (product > 0.0 && product * product >= kSurelyFree * kSurelyFree * squares) return 0.0;
  return squares > 0.0 ? bend_energy(product / std::sqrt(squares)) : 0.0;
}

/// Cosine between two normals of any length; 1 when one of them is zero.
[[nodiscard]] inline double cosine_between(const Vec3& m, const Vec3& n) {
  const double squares = m.squaredNorm() * n.squaredNorm();
  return squares > 0.0 ? m.dot(n) / std::sqrt(squares) : 1.0;
}

/// Triangle (v, a, b) between labels low < high; the normal of (v, a, b) points to high.
struct SurfaceTriangle {
  LocalVertex a = 0;
  LocalVertex b = 0;
  Label low = 0;
  Label high = 0;
  Vec3 to_a;  ///< from v, metric units
  Vec3 to_b;

  [[nodiscard]] bool is_between(Label l, Label h) const { return low == l && high == h; }
  [[nodiscard]] bool has(LocalVertex w) const { return a == w || b == w; }
  /// Twice the area times the unit normal, when v moves by x.
  [[nodiscard]] Vec3 normal(const Vec3& x) const { return (to_a - x).cross(to_b - x); }
};

/// A normal of any length.
struct SurfaceNormal {
  Vec3 vector;
  double square = 0.0;  ///< squared length
};

/// Two triangles at v that share an edge at v, are the only two of their labels there, and continue
/// each other, so that they run through the edge in opposite directions.
struct Spoke {
  std::uint32_t first = 0;  ///< rows of triangles
  std::uint32_t second = 0;
};

/// The edge opposite v of a triangle, where exactly two triangles of its labels meet, as at a
/// spoke.
struct Rim {
  std::uint32_t triangle = 0;  ///< row of the one at v
  Vec3 normal;                 ///< unit normal of the other, from low to high
};

/// The interface triangles at a vertex, as they were when they were collected.
class SurfaceStar {
 public:
  /// Collects triangles without spokes and rims.  REQUIRES: v free.
  void collect_triangles(const TetMesh& mesh, const Metric& metric, LocalVertex v);
  /// Collects triangles and spokes.  REQUIRES: v free.
  void collect(const TetMesh& mesh, const Metric& metric, LocalVertex v);
  /// Collects the rims of the star that was collected last, where all tets around are loaded.
  void collect_rims(const TetMesh& mesh, const Metric& metric);
  /// Collects only the rims of triangles for which wanted[row] is not 0.
  void collect_rims(const TetMesh& mesh, const Metric& metric,
                    std::span<const std::uint8_t> wanted);

  /// Becomes what is left of the stars of two vertices when both become one vertex, at `move` from
  /// the first and `other_move` from the other: triangles that have both vanish.
  /// REQUIRES: rims of both were collected.
  void merge(const SurfaceStar& star, const Vec3& move, const SurfaceStar& other,
             const Vec3& other_move);

  /// Writes the normals of all triangles, when v moves by x, to `out`.
  void normals_at(const Vec3& x, std::vector<SurfaceNormal>& out) const;
  /// The sum of bend energies (bend_energy()) of spokes and rims, when v moves by x.
  [[nodiscard]] double bends_at(const Vec3& x) const;
  /// Computes this sum from the normals that normals_at() wrote.
  [[nodiscard]] double bends(std::span<const SurfaceNormal> normals) const;

  [[nodiscard]] LocalVertex vertex() const { return vertex_; }
  /// The fan that it was collected from.
  [[nodiscard]] std::span<const FanTriangle> fan() const { return found_; }
  [[nodiscard]] const std::vector<SurfaceTriangle>& triangles() const { return triangles_; }
  [[nodiscard]] const std::vector<Spoke>& spokes() const { return spokes_; }
  [[nodiscard]] const std::vector<Rim>& rims() const { return rims_; }

 private:
  /// Four triangles; where there is none, low and high are the same label.
  struct CornerLanes {
    StoredInts a{}, b{}, low{}, high{};

    /// One bit for each triangle that has vertex w and lies between these labels.  REQUIRES: l < h.
    [[nodiscard]] unsigned of_triangles_at(LocalVertex w, Label l, Label h) const;
  };

  void gather_corners();
  void add_without(LocalVertex vanishing, const SurfaceStar& star, const Vec3& move);
  void find_spokes();
  void find_rim(const TetMesh& mesh, const Metric& metric, std::uint32_t row);
  [[nodiscard]] std::optional<LocalVertex> across(const TetMesh& mesh, const SurfaceTriangle& t);

  LocalVertex vertex_ = 0;
  InterfaceFan fan_;
  std::vector<FanTriangle> found_;
  std::vector<SurfaceTriangle> triangles_;
  std::vector<Spoke> spokes_;
  std::vector<Rim> rims_;
  std::vector<CornerLanes> corners_;  ///< scratch of find_spokes()
  EdgeRing ring_;
  mutable std::vector<SurfaceNormal> normals_;  ///< scratch
};

/// The curvature of threads one voxel thick, 1 / voxel (bench/parameters.md, "Constants").
inline constexpr double kMaxCurvature = 4.0;

/// Mean curvature of interfaces (twice its usual value, 1 / length), where it can be told: at free
/// vertices between two labels, off the box.  Positive where the smaller label is convex.
class CurvatureField {
 public:
  /// Measures all vertices at once, as they are.  Values are cut at kMaxCurvature.
  void measure(const TetMesh& mesh, const Metric& metric);

  [[nodiscard]] std::optional<double> at(LocalVertex v) const;

 private:
  SurfaceStar star_;
  std::vector<double> curvature_;
};

}  // namespace mw
