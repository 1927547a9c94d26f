// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Proof that new tets may replace old ones, patch by patch (kernels/odt/README.md).
#pragma once

#include <span>

#include "kernels/odt/window_plc.h"

namespace mw {

struct ReplacementStats {
  std::uint64_t patches = 0;     ///< parts of the window that a triangulation made anew
  std::uint64_t unproved = 0;    ///< patches that were refused because the proof failed
  std::uint64_t unimproved = 0;  ///< patches that were proved, but refused for their shape

  ReplacementStats& operator+=(const ReplacementStats& other);
};

/// A window's tets after a replacement.
struct Replacement {
  std::vector<LocalTet> tets;      ///< all, kept and new; rows of added points follow the mesh's
  std::vector<std::uint8_t> used;  ///< for each added point, whether a tet uses it
  ReplacementStats stats;
};

/// Replaces what can be proved; everything else keeps its tets.
///
/// A patch is a set of old tets and the new ones in their place: a class of the relation that joins
/// old neighbours across a triangle that no new tet has, new neighbours across one that no old tet
/// has, and an old with a new tet on the same side of a triangle that both have.  Patches are
/// bounded by triangles that old and new tets share on the same side, so they can be replaced one
/// by one.  A patch is replaced when
/// - each new tet is exactly positive, on the lattice, and of the old tets' region;
/// - each triangle of its tets lies between two new tets and in no old one, or between two old tets
///   of one region and in no new one, or has old and new tets on the same sides, as all triangles
///   between regions and on the hull must;
/// - each vertex of the old tets is in a new one;
/// - the worst new tet is no worse than the worst old one, or not below the quality floor.
/// Then old and new tets have one boundary, as chains, and all are positive, so that they cover the
/// same points, once.  So labels stay the same point sets, interfaces the same triangles (whose
/// samples of the distance bound stay valid), and every Steiner point lies strictly inside.
///
/// REQUIRES: content as window_plc() made it from mesh; one lattice point, or none, for each added
///           point of the triangulation.
[[nodiscard]] Replacement replace_proved(const TetMesh& mesh, const Metric& metric,
                                         const RegionTets& content,
                                         std::span<const std::optional<Point>> added,
                                         const Triangulation& made, double quality_floor);

}  // namespace mw
