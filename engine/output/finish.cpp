// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Two passes over the final blocks: count, then write.
#include "engine/output/finish.h"

#include <cstdlib>

#include "engine/output/interface_shape.h"
#include "engine/output/longest_edges.h"
#include "engine/output/remembered.h"
#include "engine/output/vertex_rows.h"
#include "engine/output/written_block.h"

namespace mw::engine {
namespace {

/// Second pass.
class Writer {
 public:
  Writer(VertexUses uses, const io::DenseVolume& volume, Index3 layers, io::MeshSink& sink,
         Remembered& remembered)
      : rows_(std::move(uses)),
        volume_(volume),
        layers_(layers),
        sink_(sink),
        remembered_(remembered) {}

  /// From now on edges are measured.
  void measure_edges() { edges_.emplace(volume_.table().size()); }

  void write(Index3 where, const BlockMesh& block, audit::QualityMeter* quality) {
    const std::vector<io::Position> positions = positions_of(block, volume_.info(), layers_);
    std::vector<io::TetRows> tets = oriented_tets(block, is_mirrored(volume_.info().space));
    if (quality != nullptr) {
      for (const auto& [a, b, c, d] : tets) {
        quality->add(positions[a], positions[b], positions[c], positions[d]);
      }
    }
    if (edges_) edges_->add(block.tets, positions);
    const std::vector<std::uint64_t> rows = write_vertices(where, block, positions);
    give_rows(tets, rows);
    sink_.write_tets(tets, raw_labels(block, volume_.table()));
  }

  [[nodiscard]] const VertexRows& rows() const { return rows_; }
  [[nodiscard]] const std::optional<LongestEdges>& edges() const { return edges_; }

 private:
  std::vector<std::uint64_t> write_vertices(Index3 where, const BlockMesh& block,
                                            const std::vector<io::Position>& positions) {
    remembered_.rows(Remembered::kBytesPerRow * (rows_.remembered() + block.vertices.size()));
    const std::uint64_t first_new = rows_.count();
    std::vector<std::uint64_t> rows = rows_.assign(where, block.vertices);
    std::vector<io::Position> added;
    for (std::size_t v = 0; v < rows.size(); ++v) {
      if (rows[v] >= first_new) added.push_back(positions[v]);
    }
    sink_.write_vertices(added);
    return rows;
  }

  VertexRows rows_;
  const io::DenseVolume& volume_;
  Index3 layers_;
  io::MeshSink& sink_;
  Remembered& remembered_;
  std::optional<LongestEdges> edges_;
};

io::VolumeInfo lattice_info(io::VolumeInfo info, Index3 layers) {
  const auto cut = [&](std::size_t axis, std::int64_t& voxels, std::int64_t parts) {
    voxels *= parts;
    info.space.spacing[axis] /= static_cast<double>(parts);
  };
  cut(0, info.shape.x, layers.x);
  cut(1, info.shape.y, layers.y);
  cut(2, info.shape.z, layers.z);
  return info;
}

/// The volumes of labels and the shape of their interfaces, on the way of the blocks to the writer.
class ShapeWatch {
 public:
  ShapeWatch(const WindowGrid& grid, const io::DenseVolume& volume, const LabelSelection& selection,
             Index3 layers, Remembered& remembered)
      : selection_(selection),
        interfaces_(grid, lattice_info(volume.info(), layers), selection,
                    [&](std::uint64_t bytes) { remembered.shape(bytes); }),
        volumes6_(volume.table().size()) {}

  /// REQUIRES: as InterfaceShape::add.
  void add(const BlockMesh& block) {
    interfaces_.add(block);
    const auto at = [&](std::uint32_t v) { return block.vertices[v].position; };
    for (const BlockTet& t : block.tets) {
      if (!selection_.keeps(t.label)) continue;
      const auto& [a, b, c, d] = t.vertices;
      volumes6_[t.label] += std::abs(volume6(at(a), at(b), at(c), at(d)));
    }
  }

  void report(FinishedMesh& out) {
    out.shape = interfaces_.report();
    out.label_volumes6 = std::move(volumes6_);
    out.max_shape_bytes = interfaces_.max_remembered();
  }

 private:
  const LabelSelection& selection_;
  InterfaceShape interfaces_;
  std::vector<Int128> volumes6_;
};

}  // namespace

FinishedMesh finish(FinalBlocks& blocks, const WindowGrid& grid, const io::DenseVolume& volume,
                    io::MeshSink& sink, const OutputOptions& options) {
  const LabelSelection selection(options.wanted, volume.table());
  FinishedMesh out;
  VertexUses uses(grid);
  for_each_index(grid.blocks(), [&](Index3 b) {
    BlockMesh block = blocks.load(b);
    selection.apply(block);
    uses.add(b, block.vertices);
    out.tets += block.tets.size();
  });
  sink.begin(header_of(volume, selection, out.tets, options.promises));
  Remembered remembered(options.hold);
  Writer writer(std::move(uses), volume, options.layers, sink, remembered);
  if (options.measure_edges) writer.measure_edges();
  audit::QualityMeter quality;
  std::optional<ShapeWatch> shape;
  if (options.measure_shape) shape.emplace(grid, volume, selection, options.layers, remembered);
  for_each_index(grid.blocks(), [&](Index3 b) {
    BlockMesh block = blocks.load(b);
    if (shape) shape->add(block);
    selection.apply(block);
    writer.write(b, block, options.measure_quality ? &quality : nullptr);
  });
  sink.finish();
  out.vertices = writer.rows().count();
  out.max_remembered = writer.rows().max_remembered();
  if (options.measure_quality) out.quality = quality.report();
  if (shape) shape->report(out);
  if (writer.edges()) out.longest_edges = writer.edges()->lengths();
  return out;
}

}  // namespace mw::engine
