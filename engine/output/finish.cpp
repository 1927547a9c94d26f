// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Two passes over the final blocks: count, then write.
#include "engine/output/finish.h"

#include "engine/output/block_figures.h"
#include "engine/output/interface_shape.h"
#include "engine/output/remembered.h"
#include "engine/output/vertex_rows.h"
#include "engine/output/written_block.h"

namespace mw::engine {
namespace {

/// Second pass.
class Writer {
 public:
  Writer(VertexUses uses, const io::DenseVolume& volume, const OutputOptions& options,
         io::MeshSink& sink, Remembered& remembered)
      : rows_(std::move(uses)),
        volume_(volume),
        layers_(options.layers),
        sink_(sink),
        remembered_(remembered),
        figures_(options, volume.table().size()),
        values_(options.values) {}

  void write(Index3 where, const BlockMesh& block) {
    const std::vector<io::Position> positions = positions_of(block, volume_.info(), layers_);
    std::vector<io::TetRows> tets = oriented_tets(block, is_mirrored(volume_.info().space));
    figures_.add(block, positions, tets, tets_);
    tets_ += tets.size();
    const std::vector<double> values = values_of(positions, tets);
    const std::vector<std::uint64_t> rows = write_vertices(where, block, positions);
    give_rows(tets, rows);
    sink_.write_tets(tets, raw_labels(block, volume_.table()));
    if (values_ != nullptr) sink_.write_values(values);
  }

  void report(FinishedMesh& out) {
    out.vertices = rows_.count();
    out.max_remembered = rows_.max_remembered();
    figures_.report(out);
  }

 private:
  std::vector<double> values_of(std::span<const io::Position> positions,
                                std::span<const io::TetRows> tets) {
    if (values_ == nullptr) return {};
    const auto hold = [&](std::uint64_t bytes) { remembered_.values(bytes); };
    return values_->of(positions, tets, hold);
  }

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
  BlockFigures figures_;
  CellValues* values_;
  std::uint64_t tets_ = 0;  ///< so far
};

/// Exact: four times a barycentre is the sum of the corners.
std::uint64_t tets_within(const BlockMesh& block, const Box3& box) {
  const auto is_between = [](std::int64_t sum, std::int64_t lo, std::int64_t hi) {
    constexpr std::int64_t kScale = std::int64_t{4} * kUnitsPerVoxel;
    return sum >= lo * kScale && sum < hi * kScale;
  };
  std::uint64_t out = 0;
  for (const BlockTet& tet : block.tets) {
    Index3 sum;
    for (const std::uint32_t row : tet.vertices) {
      const Point p = block.vertices[row].position;
      sum = sum + Index3{p.x, p.y, p.z};
    }
    const bool is_within = is_between(sum.x, box.lo.x, box.hi.x) &&
                           is_between(sum.y, box.lo.y, box.hi.y) &&
                           is_between(sum.z, box.lo.z, box.hi.z);
    out += is_within ? 1 : 0;
  }
  return out;
}

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

}  // namespace

FinishedMesh finish(const FinalMesh& mesh, io::MeshSink& sink, const OutputOptions& options) {
  const auto& [blocks, grid, volume] = mesh;
  const LabelSelection selection(options.wanted, volume.table());
  FinishedMesh out;
  VertexUses uses(grid);
  for_each_index(grid.blocks(), [&](Index3 b) {
    BlockMesh block = blocks.load(b);
    selection.apply(block);
    uses.add(b, block.vertices);
    out.tets += block.tets.size();
    if (options.within) out.tets_within += tets_within(block, *options.within);
  });
  io::MeshHeader header = header_of(volume, selection, out.tets, options.promises);
  if (options.values != nullptr) header.values = options.values->names();
  sink.begin(header);
  Remembered remembered(options.hold);
  Writer writer(std::move(uses), volume, options, sink, remembered);
  std::optional<InterfaceShape> shape;
  if (options.measure_shape) {
    shape.emplace(grid, lattice_info(volume.info(), options.layers), selection,
                  [&](std::uint64_t bytes) { remembered.shape(bytes); });
  }
  for_each_index(grid.blocks(), [&](Index3 b) {
    BlockMesh block = blocks.load(b);
    if (shape) shape->add(block);
    selection.apply(block);
    writer.write(b, block);
  });
  sink.finish();
  writer.report(out);
  if (!shape) return out;
  out.shape = shape->report();
  out.max_shape_bytes = shape->max_remembered();
  return out;
}

}  // namespace mw::engine
