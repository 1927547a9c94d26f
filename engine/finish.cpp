// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Two passes over the final blocks: count, then write.
#include "engine/finish.h"

#include "engine/vertex_rows.h"

namespace mw::engine {
namespace {

// Entries of VertexRows, and a second list while one is merged.
constexpr std::uint64_t kBytesPerRemembered = 32;
constexpr std::uint64_t kHoldStepBytes = 1 << 20;

/// One division a coordinate, so that corners of the volume's voxels stay whole numbers.
io::Position physical(Point p, const io::VolumeInfo& info, Index3 layers) {
  const auto in_voxels = [](std::int32_t units, std::int64_t of_voxel) {
    return static_cast<double>(units) / static_cast<double>(of_voxel * kUnitsPerVoxel);
  };
  const std::array<double, 3> corner{in_voxels(p.x, layers.x), in_voxels(p.y, layers.y),
                                     in_voxels(p.z, layers.z)};
  io::Position out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = info.origin[i] + info.spacing[i] * corner[i];
  return out;
}

std::vector<io::Position> positions_of(const BlockMesh& block, const io::VolumeInfo& info,
                                       Index3 layers) {
  std::vector<io::Position> out;
  out.reserve(block.vertices.size());
  for (const BlockVertex& v : block.vertices) {
    out.push_back(physical(v.position, info, layers));
  }
  return out;
}

/// The block's tets, positively oriented, rows being those of the block.
std::vector<io::TetRows> oriented_tets(const BlockMesh& block) {
  std::vector<io::TetRows> out;
  out.reserve(block.tets.size());
  const auto at = [&](std::uint32_t v) { return block.vertices[v].position; };
  for (const BlockTet& t : block.tets) {
    auto [a, b, c, d] = t.vertices;
    if (volume6(at(a), at(b), at(c), at(d)) < 0) std::swap(c, d);
    out.push_back({a, b, c, d});
  }
  return out;
}

/// Second pass.
class Writer {
 public:
  Writer(VertexUses uses, const io::DenseVolume& volume, io::MeshSink& sink,
         const OutputOptions& options)
      : rows_(std::move(uses)),
        volume_(volume),
        layers_(options.layers),
        sink_(sink),
        hold_(options.hold) {}

  void write(Index3 where, const BlockMesh& block, audit::QualityMeter* quality) {
    const std::vector<io::Position> positions = positions_of(block, volume_.info(), layers_);
    std::vector<io::TetRows> tets = oriented_tets(block);
    if (quality != nullptr) {
      for (const auto& [a, b, c, d] : tets) {
        quality->add(positions[a], positions[b], positions[c], positions[d]);
      }
    }
    const std::vector<std::uint64_t> rows = write_vertices(where, block, positions);
    std::vector<RawLabel> labels;
    labels.reserve(tets.size());
    for (const BlockTet& t : block.tets) labels.push_back(volume_.table().raw(t.label));
    for (io::TetRows& tet : tets) {
      for (std::uint64_t& v : tet) v = rows[v];
    }
    sink_.write_tets(tets, labels);
  }

  [[nodiscard]] const VertexRows& rows() const { return rows_; }

 private:
  std::vector<std::uint64_t> write_vertices(Index3 where, const BlockMesh& block,
                                            const std::vector<io::Position>& positions) {
    hold(block.vertices.size());
    const std::uint64_t first_new = rows_.count();
    std::vector<std::uint64_t> rows = rows_.assign(where, block.vertices);
    std::vector<io::Position> added;
    for (std::size_t v = 0; v < rows.size(); ++v) {
      if (rows[v] >= first_new) added.push_back(positions[v]);
    }
    sink_.write_vertices(added);
    return rows;
  }

  /// Before so many vertices more are remembered.
  void hold(std::size_t more) {
    const std::uint64_t bytes = kBytesPerRemembered * (rows_.remembered() + more);
    if (!hold_ || bytes <= held_) return;
    held_ = bytes + kHoldStepBytes;
    hold_(held_);
  }

  VertexRows rows_;
  const io::DenseVolume& volume_;
  Index3 layers_;
  io::MeshSink& sink_;
  HoldMemory hold_;
  std::uint64_t held_ = 0;
};

}  // namespace

FinishedMesh finish(FinalBlocks& blocks, const WindowGrid& grid, const io::DenseVolume& volume,
                    io::MeshSink& sink, const OutputOptions& options) {
  const LabelSelection selection(options.wanted, volume.table());
  const auto load = [&](Index3 where) {
    BlockMesh block = blocks.load(where);
    selection.apply(block);
    return block;
  };
  FinishedMesh out;
  VertexUses uses(grid);
  each_index(grid.blocks(), [&](Index3 b) {
    const BlockMesh block = load(b);
    uses.add(b, block.vertices);
    out.tets += block.tets.size();
  });
  sink.begin({.tets = out.tets, .labels_signed = volume.table().is_signed()});
  Writer writer(std::move(uses), volume, sink, options);
  audit::QualityMeter quality;
  each_index(grid.blocks(), [&](Index3 b) {
    writer.write(b, load(b), options.measure_quality ? &quality : nullptr);
  });
  sink.finish();
  out.vertices = writer.rows().count();
  out.most_remembered = writer.rows().most_remembered();
  if (options.measure_quality) out.quality = quality.report();
  return out;
}

}  // namespace mw::engine
