// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which corners of facets at a vertex are one vertex of a surface that is a manifold.
#pragma once

#include <functional>
#include <map>

#include "io/surface/surface.h"

namespace mw::io {

using EdgeRows = std::array<std::uint64_t, 2>;  ///< rows of the mesh, ascending

/// Stands for a facet that is missing.
inline constexpr std::uint64_t kNoCorner = ~std::uint64_t{0};

/// Two facets that belong together at an edge, each named by its third corner: `forward` runs along
/// the edge as its rows ascend, and `backward` runs back.  At the rim of an open shell one of them
/// may be missing.
struct Strand {
  std::uint64_t forward = kNoCorner;
  std::uint64_t backward = kNoCorner;
};

using EdgeStrands = std::map<EdgeRows, std::vector<Strand>>;

/// Returns the edges along which two facets of the shell run the same way.  Facets belong together
/// where tets of the label inside that share triangles lead around the edge from one to the other.
/// REQUIRES: all parts have the same label inside.
/// Memory: 16 MiB, a bitmap of 1 MiB and some 100 bytes for each facet at such an edge.
[[nodiscard]] EdgeStrands find_strands(const SurfaceSource& source, const ShellPlan& plan);

/// A corner of a facet, which has the number 3 * number of the facet in the shell + place in the
/// facet.  Corners of one row of the mesh are one vertex when they have the same sheet.
struct SheetCorner {
  std::uint64_t row = 0;
  std::uint64_t sheet = 0;
  std::uint64_t corner = 0;
};

/// Calls visit on every corner of the shell, in no order to rely on.
///
/// Corners are in one sheet when facets that share edges lead around the vertex from one to the
/// other.  Where more than two facets share an edge, two that bound the same fan of tets of the
/// label inside are neighbours (find_strands).  If two pairs of facets then shared both ends of the
/// edge as vertices, it would be one edge of four facets; such pairs change partners, which gives
/// each pair vertices of its own at both ends.
/// ENSURES: With these vertices, each edge has at most two facets, in opposite directions, and the
/// facets at each vertex form one fan, which is closed where the shell is.
/// REQUIRES: all parts have the same label inside.
/// Memory: that of find_strands, 16 MiB, and 100 bytes for each facet at a vertex of such an edge.
void each_sheet_corner(const SurfaceSource& source, const ShellPlan& plan,
                       const std::function<void(const SheetCorner&)>& visit);

}  // namespace mw::io
