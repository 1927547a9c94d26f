// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts come eight by eight; each node has its place among the ten by the part that names it.
#include "io/mesh/grouped/curved_parts.h"

#include <algorithm>
#include <utility>

#include "io/file/errors.h"
#include "kernels/core/tet_nodes.h"
#include "kernels/core/vector3.h"

namespace mw::io {

CurvedParts::CurvedParts(ScratchMesh& parts) : parts_(parts), tets_(parts.folder()) {
  std::array<std::uint64_t, 10> rows{};
  parts.each_tet_batch([&](const TetBatch& batch) {
    for (std::size_t t = 0; t < batch.tets.size(); ++t) {
      const std::size_t part = (batch.first + t) % kTetParts.size();
      for (std::size_t k = 0; k < 4; ++k) rows[kTetParts[part][k]] = batch.tets[t][k];
      if (part + 1 == kTetParts.size()) tets_.append(rows);
    }
  });
}

KeptRows CurvedParts::corner_rows() {
  KeptRows out(parts_.vertex_count());
  for (const bool are_corners : {false, true}) {
    for (std::uint64_t t = 0; t < tets_.size(); ++t) {
      const auto rows = tets_[t];
      for (std::size_t i = are_corners ? 0 : 4; i < (are_corners ? 4U : 10U); ++i) {
        if (rows[i] >= parts_.vertex_count()) {
          throw Error(ErrorKind::kInput,
                      text("a tet names vertex ", rows[i], " of ", parts_.vertex_count()));
        }
        are_corners ? out.keep(rows[i]) : out.middle(rows[i]);
      }
    }
  }
  out.number();
  return out;
}

ScratchMesh CurvedParts::corners() {
  const KeptRows kept = corner_rows();
  ScratchMesh out(parts_.folder());
  out.header() = parts_.header();
  std::uint64_t row = 0;
  parts_.each_vertex_batch([&](std::span<const Position> batch) {
    for (const Position& p : batch) {
      if (kept.stays(row++)) out.add_vertices(std::span(&p, 1));
    }
  });
  const std::size_t width = parts_.header().values.size();
  parts_.each_tet_batch([&](const TetBatch& batch) {
    for (std::size_t t = 0; t < batch.tets.size(); ++t) {
      if ((batch.first + t) % kTetParts.size() != 0) continue;
      const auto rows = tets_[(batch.first + t) / kTetParts.size()];
      const TetRows tet{kept[rows[0]], kept[rows[1]], kept[rows[2]], kept[rows[3]]};
      out.add_tets(std::span(&tet, 1), batch.labels.subspan(t, 1));
      out.add_values(batch.values.subspan(t * width, width));
    }
  });
  return out;
}

SixPlaces CurvedParts::middles(std::uint64_t tet) {
  const auto rows = tets_[tet];
  std::array<Position, 10> at{};
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = parts_.vertex(rows[i]);
  if (volume6(at[0], at[1], at[2], at[3]) < 0) {
    // Corners 2 and 3 change places.
    std::swap(at[5], at[8]);
    std::swap(at[6], at[7]);
  }
  SixPlaces out{};
  std::copy(at.begin() + 4, at.end(), out.begin());
  return out;
}

}  // namespace mw::io
