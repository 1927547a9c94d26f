// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where the copies of a vertex go in formats whose readers join equal places.
#pragma once

#include <map>
#include <vector>

#include "io/surface/surface.h"

namespace mw::io {

/// One of the vertices that a shell has in the place of one row of the mesh.
struct VertexCopy {
  std::uint64_t row = 0;
  std::vector<std::uint64_t> corners;  ///< those of SheetCorner with this vertex, ascending
};

/// By number of the vertex in the surface; the copies of a row have numbers one after the other.
using VertexCopies = std::map<std::uint64_t, VertexCopy>;

/// Returns a place of its own for each copy, whose corners make one fan (each_sheet_corner()).
///
/// A fan of directions from a vertex bounds a part of the label there, and nothing else of its
/// surface there may be inside: then the copy goes into that part, where the fan is moved away from
/// all others.  If the part has other fans as well, the fan bounds a hole in it, and the copy goes
/// into the hole.  The way is the sum of the fan's normals, each times its triangle's angle, which
/// by the divergence theorem points to the centroid of the directions in the part, or in the hole
/// (turned): into it, wherever it is convex.  Where it is not, fans may still cut each other by as
/// much as they were moved.
/// The step is a 256th of the least height above the vertex of the triangles, and of tets of a part
/// that moves as a whole.  So a normal turns by less than 1 degree, and no tet is inverted: four
/// corners that move change a volume by 4/256 at most, three an area by 3/256.  Only where copies
/// would round to one place in 32 bits the step is up to 64 times as long.
/// REQUIRES: all parts of the shell have the same label inside.
/// Memory: some 500 bytes for each tet of the label at one of the rows.
[[nodiscard]] std::map<std::uint64_t, Position> places_apart(const SurfaceSource& source,
                                                             const ShellPlan& plan,
                                                             const VertexCopies& copies);

}  // namespace mw::io
