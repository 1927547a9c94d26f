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

/// The vertices of all blocks, and the row there of each vertex of a block.
struct MergedVertices {
  std::vector<BlockVertex> vertices;
  std::vector<std::vector<std::uint32_t>> rows;  ///< by block
};

/// Merges lists that ascend by id.
MergedVertices merged_vertices(std::span<const BlockMesh> blocks) {
  MergedVertices out{room_for(blocks, &BlockMesh::vertices), {}};
  for (const BlockMesh& b : blocks) out.rows.emplace_back().reserve(b.vertices.size());
  const auto next_of = [&](std::size_t block) -> const BlockVertex* {
    const auto& list = blocks[block].vertices;
    const std::size_t at = out.rows[block].size();
    return at < list.size() ? &list[at] : nullptr;
  };
  for (;;) {
    const BlockVertex* least = nullptr;
    for (std::size_t block = 0; block < blocks.size(); ++block) {
      const BlockVertex* const v = next_of(block);
      if (v != nullptr && (least == nullptr || v->id < least->id)) least = v;
    }
    if (least == nullptr) return out;
    const auto row = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.push_back(*least);
    for (std::size_t block = 0; block < blocks.size(); ++block) {
      const BlockVertex* const v = next_of(block);
      if (v == nullptr || v->id != least->id) continue;
      MW_ASSERT(*v == *least);
      out.rows[block].push_back(row);
    }
  }
}

std::uint32_t first_vertex(const BlockTet& t) {
  return t.vertices[0];
}

std::uint32_t first_vertex(const BlockSample& s) {
  return s.triangle[0];
}

BlockTet with_rows(BlockTet tet, std::span<const std::uint32_t> row) {
  for (std::uint32_t& v : tet.vertices) v = row[v];
  return tet;
}

BlockSample with_rows(BlockSample sample, std::span<const std::uint32_t> row) {
  for (std::uint32_t& v : sample.triangle) v = row[v];
  return sample;
}

/// Merges lists that ascend, and do so with the rows of the merged vertices, too.
template <typename Item>
std::vector<Item> merged(std::span<const BlockMesh> blocks, std::vector<Item> BlockMesh::*list,
                         const MergedVertices& all) {
  std::vector<Item> out = room_for(blocks, list);
  std::vector<std::size_t> next(blocks.size(), 0);
  for (std::uint32_t v = 0; v < all.vertices.size(); ++v) {
    const auto begin = static_cast<std::ptrdiff_t>(out.size());
    int lists = 0;
    for (std::size_t block = 0; block < blocks.size(); ++block) {
      const std::vector<Item>& items = blocks[block].*list;
      const std::vector<std::uint32_t>& row = all.rows[block];
      const std::size_t first = next[block];
      std::size_t& i = next[block];
      for (; i < items.size() && row[first_vertex(items[i])] == v; ++i) {
        out.push_back(with_rows(items[i], row));
      }
      if (i > first) ++lists;
    }
    if (lists > 1) std::sort(out.begin() + begin, out.end());
  }
  return out;
}

/// Sorts by counting first vertices, then inside the small groups.
void sort_rows(std::vector<BlockSample>& items, std::size_t vertices) {
  std::vector<std::uint32_t> end(vertices + 1, 0);
  for (const BlockSample& i : items) ++end[first_vertex(i) + 1];
  for (std::size_t v = 0; v < vertices; ++v) end[v + 1] += end[v];
  std::vector<BlockSample> sorted(items.size());
  for (const BlockSample& i : items) sorted[end[first_vertex(i)]++] = i;
  auto group = sorted.begin();
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(end[v]);
    std::sort(group, last);
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
  MergedVertices all = merged_vertices(blocks);
  for (BlockMesh& b : blocks) b.vertices = {};
  BlockMesh out;
  out.tets = merged(blocks, &BlockMesh::tets, all);
  for (BlockMesh& b : blocks) b.tets = {};
  out.samples = merged(blocks, &BlockMesh::samples, all);
  out.vertices = std::move(all.vertices);
  return out;
}

}  // namespace mw
