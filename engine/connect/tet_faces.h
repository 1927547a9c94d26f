// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Some tets of a mesh, their vertices numbered among themselves, and the faces that they share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "io/mesh/mesh_sink.h"

namespace mw::engine {

/// The corners of tets as small numbers.
struct LocalTets {
  /// By tet: numbers of its corners, in the order of the corners' rows.
  std::vector<std::array<std::uint32_t, 4>> corners;
  std::vector<std::uint64_t> rows;  ///< by number
};

/// Rows that follow one another.
struct RowSpan {
  std::uint64_t first = 0;
  std::uint32_t count = 0;
};

/// Numbers the corners of tets.  The rows of the span come first, in their order, whether tets have
/// them or not.  Cost: linear.  Memory: 16 bytes a tet, 8 a vertex, and a table of at most 40 bytes
/// a tet meanwhile.
[[nodiscard]] LocalTets local_tets(std::span<const io::TetRows> tets, RowSpan first = {});

/// By tet and corner: the last tet before it that has the face opposite to the corner, or kNoTet.
using EarlierTets = std::vector<std::array<std::uint32_t, 4>>;
inline constexpr std::uint32_t kNoTet = ~std::uint32_t{0};

/// Finds the faces that tets share, of those that have a corner with a number below `asked`.
/// Cost: linear.  Memory: 16 bytes a tet, and a table of at most 40 bytes a tet meanwhile.
[[nodiscard]] EarlierTets earlier_tets(const LocalTets& tets, std::uint32_t asked = kNoTet);

}  // namespace mw::engine
