// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tets by their nodes: the facets of four, the edges on which ten lie, and the eight straight tets
// that stand for a curved one.
#pragma once

#include <array>
#include <cstddef>

namespace mw {

/// The corners of the facet opposite to each corner of a positive tet, normal outwards.
inline constexpr std::array<std::array<std::size_t, 3>, 4> kTetFacets{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// The six edges of a tet by its corners, in the order of VTK's, Abaqus' and FEBio's ten nodes:
/// node 4 + e is the middle of edge e.
inline constexpr std::array<std::array<std::size_t, 2>, 6> kTetEdges{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// The straight tets between the ten nodes of a tet; they are positive if it is straight and
/// positive.  Part i, for i from 0 to 3, is at corner i, and four parts lie around the line between
/// the middles of the edges 2 0 and 1 3.  Both tets at a triangle cut it in the same way.
inline constexpr std::array<std::array<std::size_t, 4>, 8> kTetParts{{{0, 4, 6, 7},
                                                                      {4, 1, 5, 8},
                                                                      {6, 5, 2, 9},
                                                                      {7, 8, 9, 3},
                                                                      {6, 8, 4, 5},
                                                                      {6, 8, 5, 9},
                                                                      {6, 8, 9, 7},
                                                                      {6, 8, 7, 4}}};

}  // namespace mw
