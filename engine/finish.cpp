// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Global rows for vertices, then tets in block order.
#include "engine/finish.h"

#include <algorithm>

namespace mw::engine {
namespace {

struct FinalVertex {
  VertexId id = 0;
  Point position;
};

std::vector<FinalVertex> unique_vertices(const std::vector<BlockMesh>& blocks) {
  std::vector<FinalVertex> all;
  for (const BlockMesh& b : blocks) {
    for (const BlockVertex& v : b.vertices) all.push_back({v.id, v.position});
  }
  std::sort(all.begin(), all.end(),
            [](const FinalVertex& a, const FinalVertex& b) { return a.id < b.id; });
  all.erase(std::unique(all.begin(), all.end(),
                        [](const FinalVertex& a, const FinalVertex& b) { return a.id == b.id; }),
            all.end());
  return all;
}

io::Position physical(Point p, const io::VolumeInfo& info) {
  const std::array<double, 3> corner{static_cast<double>(p.x) / kUnitsPerVoxel,
                                     static_cast<double>(p.y) / kUnitsPerVoxel,
                                     static_cast<double>(p.z) / kUnitsPerVoxel};
  io::Position out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = info.origin[i] + info.spacing[i] * corner[i];
  return out;
}

void write_block(const BlockMesh& block, const std::vector<FinalVertex>& vertices,
                 const io::LabelTable& table, io::MeshSink& sink) {
  std::vector<std::uint64_t> rows;
  std::vector<Point> positions;
  for (const BlockVertex& v : block.vertices) {
    const auto found =
        std::lower_bound(vertices.begin(), vertices.end(), v.id,
                         [](const FinalVertex& a, VertexId id) { return a.id < id; });
    rows.push_back(static_cast<std::uint64_t>(found - vertices.begin()));
    positions.push_back(v.position);
  }
  std::vector<io::TetRows> tets;
  std::vector<RawLabel> labels;
  for (const BlockTet& t : block.tets) {
    auto [a, b, c, d] = t.vertices;
    if (volume6(positions[a], positions[b], positions[c], positions[d]) < 0) std::swap(c, d);
    tets.push_back({rows[a], rows[b], rows[c], rows[d]});
    labels.push_back(table.raw(t.label));
  }
  sink.write_tets(tets, labels);
}

}  // namespace

FinishedMesh finish(const BlockStore& store, const WindowGrid& grid, const io::DenseVolume& volume,
                    io::MeshSink& sink) {
  std::vector<BlockMesh> blocks;
  FinishedMesh out;
  each_index(grid.blocks(), [&](Index3 b) {
    blocks.push_back(store.load(b));
    out.tets += blocks.back().tets.size();
  });
  const std::vector<FinalVertex> vertices = unique_vertices(blocks);
  out.vertices = vertices.size();
  sink.begin({out.vertices, out.tets, volume.table().is_signed()});
  std::vector<io::Position> positions;
  positions.reserve(vertices.size());
  for (const FinalVertex& v : vertices) positions.push_back(physical(v.position, volume.info()));
  sink.write_vertices(positions);
  for (const BlockMesh& b : blocks) write_block(b, vertices, volume.table(), sink);
  sink.finish();
  return out;
}

}  // namespace mw::engine
