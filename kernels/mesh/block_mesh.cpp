// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Merges blocks into one, with rows of its own.
#include "kernels/mesh/block_mesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "kernels/core/assert.h"

namespace mw {
namespace {

/// Returns a list with room for those of all blocks, which are long, so that it need not grow.
template <typename Item>
std::vector<Item> room_for(std::span<const BlockMesh> blocks, std::vector<Item> BlockMesh::*list) {
  std::size_t size = 0;
  for (const BlockMesh& b : blocks) size += (b.*list).size();
  std::vector<Item> out;
  out.reserve(size);
  return out;
}

std::vector<BlockVertex> merged_vertices(std::span<const BlockMesh> blocks) {
  std::vector<BlockVertex> all = room_for(blocks, &BlockMesh::vertices);
  for (const BlockMesh& b : blocks) all.insert(all.end(), b.vertices.begin(), b.vertices.end());
  std::sort(all.begin(), all.end(),
            [](const BlockVertex& a, const BlockVertex& b) { return a.id < b.id; });
  const auto same_id = [](const BlockVertex& a, const BlockVertex& b) {
    MW_ASSERT(a.id != b.id || a == b);
    return a.id == b.id;
  };
  all.erase(std::unique(all.begin(), all.end(), same_id), all.end());
  return all;
}

/// The window's row of each vertex of a block; both lists ascend by id.
std::vector<std::uint32_t> window_rows(const BlockMesh& block,
                                       std::span<const BlockVertex> vertices) {
  std::vector<std::uint32_t> row(block.vertices.size());
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    while (vertices[next].id != block.vertices[i].id) ++next;
    row[i] = next;
  }
  return row;
}

std::uint32_t first_vertex(const BlockTet& t) {
  return t.vertices[0];
}

std::uint32_t first_vertex(const BlockSample& s) {
  return s.triangle[0];
}

/// Numbers that order like items of one first vertex, two of 32 bits in each.
using Rest = std::array<std::uint64_t, 2>;

std::uint64_t two(std::uint32_t high, std::uint32_t low) {
  return std::uint64_t{high} << 32 | low;
}

bool is_before(const BlockTet& s, const BlockTet& t) {
  const Rest a{two(s.vertices[1], s.vertices[2]), two(s.vertices[3], s.label)};
  const Rest b{two(t.vertices[1], t.vertices[2]), two(t.vertices[3], t.label)};
  return a[0] != b[0] ? a[0] < b[0] : a[1] < b[1];
}

bool is_before(const BlockSample& s, const BlockSample& t) {
  const Rest a{two(s.triangle[1], s.triangle[2]), s.side};
  const Rest b{two(t.triangle[1], t.triangle[2]), t.side};
  if (a[0] != b[0]) return a[0] < b[0];
  return a[1] != b[1] ? a[1] < b[1] : s.samples < t.samples;
}

/// Sorts by counting first vertices, then inside the small groups.
template <typename Item>
void sort_rows(std::vector<Item>& items, std::size_t vertices) {
  std::vector<std::uint32_t> end(vertices + 1, 0);
  for (const Item& i : items) ++end[first_vertex(i) + 1];
  for (std::size_t v = 0; v < vertices; ++v) end[v + 1] += end[v];
  std::vector<Item> sorted(items.size());
  for (const Item& i : items) sorted[end[first_vertex(i)]++] = i;
  auto group = sorted.begin();
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(end[v]);
    std::sort(group, last, [](const Item& a, const Item& b) { return is_before(a, b); });
    group = last;
  }
  items = std::move(sorted);
}

/// Joins samples of the same face on the same triangle.  REQUIRES: sorted.
void join_faces(std::vector<BlockSample>& sorted) {
  std::size_t kept = 0;
  for (const BlockSample& s : sorted) {
    BlockSample* const last = kept == 0 ? nullptr : &sorted[kept - 1];
    if (last != nullptr && last->triangle == s.triangle && last->side == s.side &&
        on_same_face(last->samples, s.samples)) {
      last->samples |= s.samples;
    } else {
      sorted[kept++] = s;
    }
  }
  sorted.resize(kept);
}

}  // namespace

void make_canonical(std::vector<BlockSample>& samples, std::size_t vertices) {
  sort_rows(samples, vertices);
  join_faces(samples);
}

BlockMesh merge_blocks(std::vector<BlockMesh> blocks) {
  BlockMesh out;
  out.vertices = merged_vertices(blocks);
  out.tets = room_for(blocks, &BlockMesh::tets);
  out.samples = room_for(blocks, &BlockMesh::samples);
  for (BlockMesh& b : blocks) {
    const BlockMesh block = std::move(b);  // its memory goes with it
    const std::vector<std::uint32_t> row = window_rows(block, out.vertices);
    for (BlockTet t : block.tets) {
      for (std::uint32_t& v : t.vertices) v = row[v];
      out.tets.push_back(t);
    }
    for (BlockSample s : block.samples) {
      for (std::uint32_t& v : s.triangle) v = row[v];
      out.samples.push_back(s);
    }
  }
  sort_rows(out.tets, out.vertices.size());
  sort_rows(out.samples, out.vertices.size());
  return out;
}

}  // namespace mw
