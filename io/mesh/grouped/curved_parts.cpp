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
CurvedParts::CurvedParts(const std::filesystem::path& folder, std::size_t values)
    : vertices_(folder), tets_(folder), values_(folder), columns_(values) {}

void CurvedParts::add_vertices(std::span<const Position> positions) {
  for (const Position& p : positions) vertices_.append(p);
}

void CurvedParts::add(std::span<const TetRows> parts, std::span<const RawLabel> labels) {
  batch_ = parts_;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t number = parts_++ % kTetParts.size();
    for (std::size_t k = 0; k < parts[i].size(); ++k) {
      next_.rows[kTetParts[number][k]] = parts[i][k];
    }
    next_.label = labels[i];
    if (number + 1 == kTetParts.size()) tets_.append(next_);
  }
}

void CurvedParts::add_values(std::span<const double> rows) {
  for (std::size_t at = 0; at < rows.size(); at += columns_) {
    if ((batch_ + at / columns_) % kTetParts.size() != 0) continue;
    values_.append(std::as_bytes(rows.subspan(at, columns_)));
  }
}

KeptRows CurvedParts::corners() {
  KeptRows out(vertices_.size());
  for (const bool are_corners : {false, true}) {
    for (std::uint64_t t = 0; t < tets_.size(); ++t) {
      const Tet tet = tets_[t];
      for (std::size_t i = are_corners ? 0 : 4; i < (are_corners ? 4U : 10U); ++i) {
        if (tet.rows[i] >= vertices_.size()) {
          throw Error(ErrorKind::kInput,
                      text("a tet names vertex ", tet.rows[i], " of ", vertices_.size()));
        }
        are_corners ? out.keep(tet.rows[i]) : out.middle(tet.rows[i]);
      }
    }
  }
  out.number();
  return out;
}

void CurvedParts::join(MeshSink& sink) {
  is_joined_ = true;
  const KeptRows kept = corners();
  write_corners(kept, sink);
  write_tets(kept, sink);
}

void CurvedParts::write_corners(const KeptRows& kept, MeshSink& sink) {
  constexpr std::size_t kBatchRows = 4096;
  std::vector<Position> batch;
  for (std::uint64_t v = 0; v < vertices_.size(); ++v) {
    if (kept.stays(v)) batch.push_back(vertices_[v]);
    if (batch.size() < kBatchRows && v + 1 < vertices_.size()) continue;
    sink.write_vertices(batch);
    batch.clear();
  }
}

void CurvedParts::write_tets(const KeptRows& kept, MeshSink& sink) {
  std::vector<double> row(columns_);
  for (std::uint64_t t = 0; t < tets_.size(); ++t) {
    const Tet tet = tets_[t];
    TetRows corners{};
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = kept[tet.rows[i]];
    sink.write_tets(std::span(&corners, 1), std::span(&tet.label, 1));
    if (row.empty()) continue;
    values_.read_at(t * row.size() * sizeof(double), std::as_writable_bytes(std::span(row)));
    sink.write_values(row);
  }
}

SixPlaces CurvedParts::middles(std::uint64_t tet) {
  const Tet nodes = tets_[tet];
  std::array<Position, 10> at{};
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = vertices_[nodes.rows[i]];
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
