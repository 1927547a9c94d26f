// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Rows of meshes in temporary files: tets, and coordinates as integers, for sorts to compare.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "io/file/scratch/packed_scratch.h"
#include "io/mesh/mesh_sink.h"

namespace mw::io {

/// Returns an integer that orders like the double; -0.0 is as 0.0, and NaN has a place, too.
[[nodiscard]] inline std::uint64_t sortable(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x);
  return (bits >> 63) != 0 ? ~bits : bits | std::uint64_t{1} << 63;
}

/// Four rows and the label of a tet.
using TetRecord = std::array<std::uint64_t, 5>;

/// Appends a TetRecord for each tet.  REQUIRES: tets.size() == labels.size().
inline void append_tets(PackedRecords<TetRecord>& file, std::span<const TetRows> tets,
                        std::span<const RawLabel> labels) {
  for (std::size_t i = 0; i < tets.size(); ++i) {
    const auto [a, b, c, d] = tets[i];
    file.append({a, b, c, d, labels[i]});
  }
}

}  // namespace mw::io
