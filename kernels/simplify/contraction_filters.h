// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Geometric filters of a contraction: exact positivity, radius ratio floor, edge length variance,
// and no folds of interfaces.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kernels/quality/star_batch.h"
#include "kernels/simplify/contraction.h"
#include "kernels/simplify/simplify.h"
#include "kernels/surface/surface_star.h"

namespace mw {

/// Judges the tets that contractions would leave around the surviving vertex.
class ShapeFilter {
 public:
  /// Keeps references.  The mesh may change only by contractions that were found good here.
  ShapeFilter(const TetMesh& mesh, const Metric& metric, const SimplifyOptions& options);

  /// A contraction is good if all tets are exactly positive and reach the radius ratio asked for,
  /// or, where present ones do not reach quality_floor, that of the worst.  Positivity gives the
  /// link condition of the whole mesh, and lets contractions of Cases 1 and 2 keep every region as
  /// a point set (kernels/topology/README.md, "Positive tets share only the ring").
  /// Cost: O(stars); less when one of the ends is that of the last call; no allocation.
  [[nodiscard]] StarVerdict judge(const Contraction& c);

 private:
  struct Gathered {
    LocalVertex vertex = 0;
    std::uint64_t at = 0;  ///< TetMesh::changes() + 1; 0 when nothing is gathered
    StarBatch star;
  };

  [[nodiscard]] bool is_gathered(LocalVertex v) const;
  [[nodiscard]] StarBatch& star_of(LocalVertex v, LocalVertex other);
  [[nodiscard]] double floor_for(const Contraction& c) const;
  [[nodiscard]] StarVerdict judge_shape(LocalVertex v, LocalVertex other, Point x, double floor);
  [[nodiscard]] StarVerdict judge_signs(LocalVertex v, LocalVertex other, Point x);
  [[nodiscard]] StarVerdict judge(const Contraction& c, double floor);
  void mark_poor(const Contraction& c);

  const TetMesh& mesh_;
  const Metric& metric_;
  const SimplifyOptions& options_;
  std::array<Gathered, 2> gathered_;
  /// Marks vertices that had a tet below quality_floor at some time; only they try the fallback.
  std::vector<std::uint8_t> poor_;
};

/// Judges contractions of two boundary vertices by the bend energies
/// (kernels/surface/surface_star.h) of the interface triangles around.  A fold is better not made,
/// because smoothing takes it out only where shapes and the distance bound let it.
class BendFilter {
 public:
  /// Keeps references.  With `labels`, those of the input, less is allowed on held sheets.
  BendFilter(const TetMesh& mesh, const Metric& metric, const LabelBox* labels = nullptr)
      : mesh_(mesh), metric_(metric), labels_(labels) {}

  /// False when the surviving star would bend by more than a share of what both stars bend at
  /// present, plus what is free, both of which are less on held sheets (thin_label_at()); and when
  /// the interface triangles at both ends lie in one plane across an axis, which the survivor would
  /// leave.
  [[nodiscard]] bool stays_smooth(const Contraction& c);

  /// The interface triangles at an end of the contraction that was judged last.
  [[nodiscard]] std::span<const FanTriangle> fan(LocalVertex end) const;

 private:
  /// A star with its rims, as it was when the mesh had changed `at` - 1 times.
  struct Gathered {
    SurfaceStar star;
    std::optional<double> bends;  ///< bend energy of the star, once it was asked for
    std::optional<bool> is_held;  ///< a label is a held sheet there, once that was asked for
    std::uint64_t at = 0;         ///< TetMesh::changes() + 1; 0 when nothing is gathered
    [[nodiscard]] bool is(LocalVertex v, std::uint64_t now) const {
      return star.vertex() == v && at == now;
    }
  };

  [[nodiscard]] bool leaves_plane(const Contraction& c, std::span<const FanTriangle> keep,
                                  std::span<const FanTriangle> drop) const;
  [[nodiscard]] Gathered& star_of(LocalVertex v, LocalVertex other);
  [[nodiscard]] static double present_bends(Gathered& g);
  [[nodiscard]] bool is_held_at(Gathered& g);

  const TetMesh& mesh_;
  const Metric& metric_;
  const LabelBox* labels_;
  std::array<Gathered, 2> gathered_;
  SurfaceStar merged_;
  std::vector<Label> around_;  ///< scratch; labels at a vertex
};

}  // namespace mw
