// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Curved tets become straight ones as they are read, and nodes go that no corner needs.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "io/mesh/mesh_data.h"
#include "io/mesh/mesh_sink.h"
#include "kernels/core/tet_nodes.h"

namespace mw::io {

/// Which rows of vertices stay, and what their numbers are when the others are gone.
/// Where middles of edges are dropped, all of them are given first, then all corners of tets.
/// Memory: a quarter of a byte for each row.  REQUIRES (all members): row < rows.
class KeptRows {
 public:
  /// All rows stay until they are dropped.
  explicit KeptRows(std::uint64_t rows = 0) { grow(rows); }
  /// No row stays until it is kept.
  [[nodiscard]] static KeptRows none(std::uint64_t rows) {
    KeptRows out;
    out.words_.assign(rows / 64 + 1, 0);
    return out;
  }

  /// Sets the number of rows.  REQUIRES: there are no fewer than before.
  void grow(std::uint64_t rows) { words_.resize(rows / 64 + 1, ~std::uint64_t{0}); }
  void middle(std::uint64_t row) {
    words_[row / 64] &= ~bit(row);
    any_ = true;
  }
  /// True if there were middles; without them all rows stay as they are.
  [[nodiscard]] bool any() const { return any_; }
  void keep(std::uint64_t row) { words_[row / 64] |= bit(row); }
  /// Numbers the rows that stay.  To be called after the last change.
  void number() {
    before_.assign(words_.size(), 0);
    for (std::size_t i = 1; i < words_.size(); ++i) {
      before_[i] = before_[i - 1] + static_cast<std::uint64_t>(std::popcount(words_[i - 1]));
    }
  }

  /// Returns how many rows stay.  REQUIRES: number().
  [[nodiscard]] std::uint64_t count() const {
    return before_.back() + static_cast<std::uint64_t>(std::popcount(words_.back()));
  }
  [[nodiscard]] bool stays(std::uint64_t row) const { return (words_[row / 64] & bit(row)) != 0; }
  /// Returns the new number of a row: how many rows before it stay.  REQUIRES: number().
  [[nodiscard]] std::uint64_t operator[](std::uint64_t row) const {
    const std::uint64_t lower = words_[row / 64] & (bit(row) - 1);
    return before_[row / 64] + static_cast<std::uint64_t>(std::popcount(lower));
  }

 private:
  [[nodiscard]] static std::uint64_t bit(std::uint64_t row) { return std::uint64_t{1} << row % 64; }

  std::vector<std::uint64_t> words_;   ///< a bit for each row, set where it stays
  std::vector<std::uint64_t> before_;  ///< by word, how many rows before it stay
  bool any_ = false;
};

/// Takes the middles out of a mesh whose tets name their corners.
/// middles has been given all of them.  REQUIRES: tets name existing vertices.
inline void drop_middles(MeshData& mesh, KeptRows& middles) {
  if (!middles.any()) return;
  for (const TetRows& tet : mesh.tets) {
    for (const std::uint64_t row : tet) middles.keep(row);
  }
  middles.number();
  for (TetRows& tet : mesh.tets) {
    for (std::uint64_t& row : tet) row = middles[row];
  }
  std::size_t kept = 0;
  for (std::size_t row = 0; row < mesh.vertices.size(); ++row) {
    if (middles.stays(row)) mesh.vertices[kept++] = mesh.vertices[row];
  }
  mesh.vertices.resize(kept);
}

/// Adds the straight parts of a curved tet; rows are the rows of its ten nodes.
inline void add_parts(std::span<const std::uint64_t, 10> rows, std::vector<TetRows>& out) {
  for (const auto& part : kTetParts) {
    out.push_back({rows[part[0]], rows[part[1]], rows[part[2]], rows[part[3]]});
  }
}

}  // namespace mw::io
