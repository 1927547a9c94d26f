// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One external sort of positions.
#include "io/mesh/merged_vertices.h"

#include <algorithm>

#include "io/mesh/tet_record.h"

namespace mw::io {

void DoubledVertices::add(std::span<const Position> positions) {
  for (const Position& p : positions) {
    positions_.add({sortable(p[0]), sortable(p[1]), sortable(p[2]), rows_++});
  }
}

void DoubledVertices::find() {
  std::array<std::uint64_t, 4> first{};
  bool has_first = false;
  positions_.each([&](const std::array<std::uint64_t, 4>& vertex) {
    const bool is_double =
        has_first && std::equal(vertex.begin(), vertex.begin() + 3, first.begin());
    if (is_double) {
      doubles_.emplace_back(vertex[3], first[3]);
    } else {
      first = vertex;
      has_first = true;
    }
  });
  std::sort(doubles_.begin(), doubles_.end());
}

std::uint64_t DoubledVertices::first(std::uint64_t row) const {
  const auto at =
      std::lower_bound(doubles_.begin(), doubles_.end(), std::pair(row, std::uint64_t{0}));
  return at != doubles_.end() && at->first == row ? at->second : row;
}

std::uint64_t DoubledVertices::rank(std::uint64_t row) const {
  const auto at =
      std::lower_bound(doubles_.begin(), doubles_.end(), std::pair(row, std::uint64_t{0}));
  return row - static_cast<std::uint64_t>(at - doubles_.begin());
}

void MergedVertices::begin(const MeshHeader& header) {
  if (header.record.has_doubles) waiting_.emplace(folder_);
  MeshHeader told = header;
  told.values.clear();  // they are not passed on
  below_.begin(told);
}

void MergedVertices::write_vertices(std::span<const Position> positions) {
  between_();
  if (!waiting_) return below_.write_vertices(positions);
  waiting_->doubles.add(positions);
  waiting_->positions.append(std::as_bytes(positions));
}

void MergedVertices::write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) {
  between_();
  if (!waiting_) return below_.write_tets(tets, labels);
  append_tets(waiting_->tets, tets, labels);
}

void MergedVertices::finish() {
  if (waiting_) {
    waiting_->doubles.find();
    pass_vertices();
    pass_tets();
  }
  below_.finish();
}

void MergedVertices::pass_vertices() {
  std::uint64_t row = 0;
  waiting_->positions.each_batch<Position>([&](std::span<const Position> batch) {
    between_();
    std::vector<Position> firsts;
    for (const Position& p : batch) {
      if (waiting_->doubles.first(row) == row) firsts.push_back(p);
      ++row;
    }
    below_.write_vertices(firsts);
  });
}

void MergedVertices::pass_tets() {
  const DoubledVertices& doubles = waiting_->doubles;
  waiting_->tets.each_batch([&](std::span<const TetRecord> batch) {
    between_();
    std::vector<TetRows> tets;
    std::vector<RawLabel> labels;
    for (const TetRecord& record : batch) {
      TetRows& rows = tets.emplace_back();
      for (std::size_t i = 0; i < 4; ++i) rows[i] = doubles.rank(doubles.first(record[i]));
      labels.push_back(record[4]);
    }
    below_.write_tets(tets, labels);
  });
}

}  // namespace mw::io
