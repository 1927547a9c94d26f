// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Two passes over the final blocks: count, then write.
#include "engine/output/finish.h"

#include "engine/output/remembered.h"
#include "engine/output/score_surface.h"
#include "engine/output/vertex_rows.h"
#include "engine/output/written_block.h"

namespace mw::engine {
namespace {

/// The result is exact: four times a barycentre is the sum of the corners.
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

/// What the first pass counts in a block.
struct Counts {
  std::vector<std::size_t> lines;  ///< see VertexUses
  std::uint64_t tets = 0;
  std::uint64_t tets_within = 0;
};

/// Makes the first pass.  Returns the lines of blocks that use vertices.
VertexUses count(const FinalMesh& mesh, const LabelSelection& selection,
                 const OutputOptions& options, FinishedMesh& out) {
  VertexUses uses(mesh.grid);
  const Index3 blocks = mesh.grid.blocks();
  each_in_order<Counts>(
      options.work, static_cast<std::size_t>(blocks.product()),
      [&](std::size_t i) {
        BlockMesh block = mesh.blocks.load(index_at(i, blocks));
        selection.apply(block);
        return Counts{uses.lines_of(block.vertices), block.tets.size(),
                      options.within ? tets_within(block, *options.within) : 0};
      },
      [&](std::size_t i, Counts&& of_block) {
        uses.add(index_at(i, blocks), of_block.lines);
        out.tets += of_block.tets;
        out.tets_within += of_block.tets_within;
      });
  return uses;
}

/// Makes the second pass.
class SecondPass {
 public:
  SecondPass(const FinalMesh& mesh, const LabelSelection& selection, VertexUses uses,
             io::MeshSink& sink, const OutputOptions& options)
      : mesh_(mesh),
        selection_(selection),
        rows_(std::move(uses)),
        sink_(sink),
        options_(options),
        remembered_(options.hold) {}

  /// Thread safety: may be called while write() runs.
  [[nodiscard]] WrittenBlock make(Index3 where) const {
    BlockMesh block = mesh_.blocks.load(where);
    block.samples = {};  // frees memory for what is made next
    selection_.apply(block);
    return written_block(std::move(block), mesh_.volume, options_.layers);
  }

  void write(Index3 where, WrittenBlock&& made) {
    auto& [block, positions, tets, labels] = made;
    const std::vector<std::uint64_t> rows = write_vertices(where, block, positions);
    give_rows(tets, rows);
    sink_.write_tets(tets, labels);
  }

  void report(FinishedMesh& out) {
    out.vertices = rows_.count();
    out.max_remembered = rows_.max_remembered();
  }

 private:
  std::vector<std::uint64_t> write_vertices(Index3 where, const BlockMesh& block,
                                            const std::vector<io::Position>& positions) {
    remembered_.grow(Remembered::kBytesPerRow * (rows_.remembered() + block.vertices.size()));
    const std::uint64_t first_new = rows_.count();
    std::vector<std::uint64_t> rows = rows_.assign(where, block.vertices);
    std::vector<io::Position> added;
    for (std::size_t v = 0; v < rows.size(); ++v) {
      if (rows[v] >= first_new) added.push_back(positions[v]);
    }
    sink_.write_vertices(added);
    return rows;
  }

  const FinalMesh& mesh_;
  const LabelSelection& selection_;
  VertexRows rows_;
  io::MeshSink& sink_;
  const OutputOptions& options_;
  Remembered remembered_;
};

}  // namespace

FinishedMesh finish(const FinalMesh& mesh, io::MeshSink& sink, const OutputOptions& options) {
  const LabelSelection selection(options.wanted, mesh.volume.table());
  FinishedMesh out;
  VertexUses uses = count(mesh, selection, options, out);
  io::MeshHeader header = header_of(mesh.volume, selection, out.tets, options.promises);
  std::optional<ScoreSurface> surface;
  if (mesh.volume.raw().scores() != nullptr) {
    surface.emplace(mesh.volume);
    header.interface_place = [&surface](const io::Position& near, RawLabel one, RawLabel other) {
      return surface->nearest(near, one, other);
    };
  }
  sink.begin(header);
  SecondPass pass(mesh, selection, std::move(uses), sink, options);
  const Index3 blocks = mesh.grid.blocks();
  each_in_order<WrittenBlock>(
      options.work, static_cast<std::size_t>(blocks.product()),
      [&](std::size_t i) { return pass.make(index_at(i, blocks)); },
      [&](std::size_t i, WrittenBlock&& made) {
        pass.write(index_at(i, blocks), std::move(made));
      });
  sink.finish();
  pass.report(out);
  return out;
}

}  // namespace mw::engine
