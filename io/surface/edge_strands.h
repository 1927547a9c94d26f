// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Edges of a shell that more than two facets share, and which of these facets belong together.
#pragma once

#include <map>

#include "io/surface/shell_facets.h"

namespace mw::io {

using EdgeRows = std::array<std::uint64_t, 2>;  ///< rows of the mesh, ascending

/// No facet.
inline constexpr std::uint64_t kNoCorner = ~std::uint64_t{0};

/// Two facets at an edge that belong together, each named by its third corner: the one that runs
/// along the edge as its rows ascend, and the one that runs back.  At the rim of an open shell one
/// of them may be missing.
struct Strand {
  std::uint64_t forward = kNoCorner;
  std::uint64_t backward = kNoCorner;
};

using EdgeStrands = std::map<EdgeRows, std::vector<Strand>>;

/// The edges along which two facets of the shell run the same way.  Facets belong together where
/// tets of the label inside that share triangles lead around the edge from one to the other.
/// REQUIRES: all parts have the same label inside.
/// Memory: 16 MiB, a bitmap of 1 MiB and some 100 bytes for each facet at such an edge.
[[nodiscard]] EdgeStrands find_strands(const SurfaceSource& source, const ShellPlan& plan);

}  // namespace mw::io
