// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tets of ten nodes: their edges, and the eight straight tets that stand for a curved one.
#pragma once

#include <array>
#include <cstddef>

namespace mw {

/// The six edges of a tet by its corners, in the order of VTK's, Abaqus' and FEBio's ten nodes:
/// node 4 + e is the middle of edge e.
inline constexpr std::array<std::array<std::size_t, 2>, 6> kTetEdges{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// The straight tets between the ten nodes of a tet, positive where it is straight and positive:
/// one at each corner, which has that corner's number in it, and four around the edge between the
/// middles of the edges 2 0 and 1 3.  Triangles are cut alike from both of their sides.
inline constexpr std::array<std::array<std::size_t, 4>, 8> kTetParts{{{0, 4, 6, 7},
                                                                      {4, 1, 5, 8},
                                                                      {6, 5, 2, 9},
                                                                      {7, 8, 9, 3},
                                                                      {6, 8, 4, 5},
                                                                      {6, 8, 5, 9},
                                                                      {6, 8, 9, 7},
                                                                      {6, 8, 7, 4}}};

}  // namespace mw
