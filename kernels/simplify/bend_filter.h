// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Refuses contractions that fold an interface.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "kernels/simplify/contraction.h"
#include "kernels/surface/surface_star.h"

namespace mw {

/// Judges contractions of two boundary vertices by the bend energies (kernels/surface/bend.h) of
/// the interface triangles around.  A fold is better not made, because smoothing takes it out only
/// where shapes and the distance bound let it.
class BendFilter {
 public:
  /// Keeps references.
  BendFilter(const TetMesh& mesh, const Metric& metric) : mesh_(mesh), metric_(metric) {}

  /// False when the surviving star would bend by more than a share of what both stars bend at
  /// present, plus what is free; and when the interface triangles at both ends lie in one plane
  /// across an axis, which the survivor would leave.
  [[nodiscard]] bool stays_smooth(const Contraction& c);

  /// The interface triangles at an end of the contraction that was judged last.
  [[nodiscard]] std::span<const FanTriangle> fan(LocalVertex end) const;

 private:
  /// A star with its rims, as it was when the mesh had changed `at` - 1 times.
  struct Gathered {
    SurfaceStar star;
    std::optional<double> bends;  ///< bend energy of the star, once it was asked for
    std::uint64_t at = 0;         ///< TetMesh::changes() + 1; 0 when nothing is gathered
    [[nodiscard]] bool is(LocalVertex v, std::uint64_t now) const {
      return star.vertex() == v && at == now;
    }
  };

  [[nodiscard]] bool leaves_plane(const Contraction& c, std::span<const FanTriangle> keep,
                                  std::span<const FanTriangle> drop) const;
  [[nodiscard]] Gathered& star_of(LocalVertex v, LocalVertex other);
  [[nodiscard]] static double present_bends(Gathered& g);

  const TetMesh& mesh_;
  const Metric& metric_;
  std::array<Gathered, 2> gathered_;
  SurfaceStar merged_;
};

}  // namespace mw
