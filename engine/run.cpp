// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The main job: march over the volume, then finish.
#include "engine/run.h"

#include <memory>

#include "engine/block_store.h"
#include "engine/stopwatch.h"
#include "engine/window.h"
#include "engine/window_visitor.h"

namespace mw::engine {
namespace {

/// The blocks of a march, each made of the eight that the march before left in its place.
std::unique_ptr<BlockStore> regroup(BlockStore& before, Index3 blocks_before, Index3 blocks) {
  auto store = std::make_unique<MemoryBlockStore>(blocks);
  each_index(blocks, [&](Index3 b) {
    std::vector<BlockMesh> parts;
    each_index(Index3{2, 2, 2}, [&](Index3 i) {
      const Index3 part{2 * b.x + i.x, 2 * b.y + i.y, 2 * b.z + i.z};
      if (!Box3{{0, 0, 0}, blocks_before}.contains(part)) return;
      parts.push_back(before.take(part).value());
    });
    store->put(b, merge(parts));
  });
  return store;
}

/// One grid a march.  A vertex near a block plane is free in half as many windows, so it stays
/// denser there; the next march has other planes and heals that.
std::vector<WindowGrid> march_grids(Index3 shape, const MeshSettings& settings) {
  std::vector<WindowGrid> grids;
  int window = settings.window;
  for (int i = 0; i < settings.marches && window <= kMaxWindow; ++i, window *= 2) {
    grids.emplace_back(shape, window);
  }
  return grids;
}

}  // namespace

RunReport mesh_volume(const io::DenseVolume& volume, const MeshSettings& settings,
                      io::MeshSink& sink, const RunHooks& hooks) {
  check(settings);
  RunReport report;
  Stopwatch preparing;
  const PreparedLabels labels(volume, settings);
  preparing.lap(report.prepare_seconds);
  const Metric metric(volume.info().spacing);
  const std::vector<WindowGrid> grids = march_grids(volume.info().shape, settings);
  std::uint64_t total = 0;
  for (const WindowGrid& g : grids) total += static_cast<std::uint64_t>(g.windows().product());
  std::unique_ptr<BlockStore> store = std::make_unique<MemoryBlockStore>(grids[0].blocks());
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const WindowGrid& grid = grids[i];
    if (i > 0) store = regroup(*store, grids[i - 1].blocks(), grid.blocks());
    WindowVisitor visitor(labels, metric, settings, grid, *store, report);
    const VisitWindow visit = [&](Index3 window) {
      visitor.visit(window);
      if (hooks.progress) hooks.progress(report.windows, total);
    };
    if (hooks.pick) {
      march(grid, visit, hooks.pick);
    } else {
      march(grid, visit);
    }
  }
  Stopwatch watch;
  StoredBlocks blocks(*store);
  const FinishedMesh finished = finish(blocks, grids.back(), volume, sink, hooks.output);
  watch.lap(report.output_seconds);
  report.vertices = finished.vertices;
  report.tets = finished.tets;
  report.quality = finished.quality;
  return report;
}

}  // namespace mw::engine
