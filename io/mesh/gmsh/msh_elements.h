// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Element types of .msh files.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>

namespace mw::io {

inline constexpr std::int32_t kMshTriangle3 = 2;
inline constexpr std::int32_t kMshTet4 = 4;
inline constexpr std::int32_t kMshPrism6 = 6;
inline constexpr std::int32_t kMshTriangle6 = 9;
inline constexpr std::int32_t kMshTet10 = 11;

/// The number of nodes of each element type from 0 on, as Gmsh's manual numbers them: lines,
/// triangles, quadrangles, tets, hexahedra, prisms, pyramids and points of orders up to 5.
inline constexpr std::array<std::uint8_t, 32> kMshNodes{0,  2,  3,  4,  4, 8, 6,  5,  3,  6, 9,
                                                        10, 27, 18, 14, 1, 8, 20, 15, 13, 9, 10,
                                                        12, 15, 15, 21, 4, 5, 6,  20, 35, 56};

/// Returns how many nodes an element of the type has, or 0 for types not known here.
[[nodiscard]] inline std::uint64_t msh_nodes_of(std::int64_t type) {
  constexpr std::int64_t kHexahedron64 = 92, kHexahedron125 = 93;
  if (type == kHexahedron64) return 64;
  if (type == kHexahedron125) return 125;
  return type > 0 && type < std::ssize(kMshNodes) ? kMshNodes[static_cast<std::size_t>(type)] : 0;
}

/// True for tets of any order, whose first four nodes are their corners.
[[nodiscard]] inline bool is_msh_tet(std::int64_t type) {
  constexpr std::int64_t kTet20 = 29, kTet56 = 31;
  return type == kMshTet4 || type == kMshTet10 || (type >= kTet20 && type <= kTet56);
}

}  // namespace mw::io
