// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lists of rows by home block, which live as long as they are asked for.
#include "engine/output/vertex_rows.h"

#include <algorithm>
#include <map>

#include "kernels/core/sort_distinct.h"

namespace mw::engine {

VertexUses::VertexUses(const WindowGrid& grid)
    : blocks_(grid.blocks()), last_line_(static_cast<std::size_t>(blocks_.y * blocks_.z)) {
  // The first block is cut off only along axes where it is the only one.
  const Index3 first = grid.block_box({0, 0, 0}).shape();
  block_shape_ = {first.x * kUnitsPerVoxel, first.y * kUnitsPerVoxel, first.z * kUnitsPerVoxel};
}

Index3 VertexUses::home(Point p) const {
  return {std::min(p.x / block_shape_.x, blocks_.x - 1),
          std::min(p.y / block_shape_.y, blocks_.y - 1),
          std::min(p.z / block_shape_.z, blocks_.z - 1)};
}

std::vector<std::size_t> VertexUses::lines_of(std::span<const BlockVertex> vertices) const {
  std::vector<std::size_t> out;
  out.reserve(vertices.size());
  for (const BlockVertex& v : vertices) out.push_back(line(home(v.position)));
  sort_distinct(out);
  return out;
}

void VertexUses::add(Index3 block, std::span<const std::size_t> lines) {
  for (const std::size_t l : lines) last_line_[l] = std::max(last_line_[l], line(block));
}

VertexRows::VertexRows(VertexUses uses)
    : uses_(std::move(uses)), lines_to_forget_(uses_.last_lines().size()) {
  for (std::size_t line = 0; line < lines_to_forget_.size(); ++line) {
    lines_to_forget_[uses_.last_lines()[line]].push_back(line);
  }
}

std::vector<std::uint64_t> VertexRows::assign(Index3 block, std::span<const BlockVertex> vertices) {
  std::vector<std::uint64_t> rows;
  rows.reserve(vertices.size());
  std::map<std::size_t, Home> added;
  for (const BlockVertex& v : vertices) {
    const std::size_t home = raster(uses_.home(v.position), uses_.blocks());
    if (const Entry* known = find(home, v.id)) {
      rows.push_back(known->row);
    } else {
      added[home].push_back({v.id, count_});
      rows.push_back(count_++);
    }
  }
  for (const auto& [home, entries] : added) remember(home, entries);
  max_remembered_ = std::max(max_remembered_, remembered_);
  if (block.x + 1 == uses_.blocks().x) forget_after(uses_.line(block));
  return rows;
}

const VertexRows::Entry* VertexRows::find(std::size_t home, VertexId id) const {
  const auto index = homes_.find(home);
  if (index == homes_.end()) return nullptr;
  const Home& entries = index->second;
  const auto entry =
      std::lower_bound(entries.begin(), entries.end(), id,
                       [](const Entry& a, VertexId wanted) { return a.id < wanted; });
  return entry != entries.end() && entry->id == id ? &*entry : nullptr;
}

void VertexRows::remember(std::size_t home, const Home& added) {
  Home& known = homes_[home];
  Home all(known.size() + added.size());
  std::merge(known.begin(), known.end(), added.begin(), added.end(), all.begin(),
             [](const Entry& a, const Entry& b) { return a.id < b.id; });
  known = std::move(all);
  remembered_ += added.size();
}

void VertexRows::forget_after(std::size_t line) {
  const auto width = static_cast<std::size_t>(uses_.blocks().x);
  for (const std::size_t over : lines_to_forget_[line]) {
    for (std::size_t home = over * width; home < (over + 1) * width; ++home) {
      const auto index = homes_.find(home);
      if (index == homes_.end()) continue;
      remembered_ -= index->second.size();
      homes_.erase(index);
    }
  }
}

}  // namespace mw::engine
