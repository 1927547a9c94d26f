// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The main job: march over the volume, then finish.
#include "engine/run.h"

#include <memory>
#include <mutex>

#include "engine/block_store.h"
#include "engine/march/timed_visit.h"
#include "engine/stopwatch.h"
#include "engine/window.h"

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

double seconds_between(Visited::Time a, Visited::Time b) {
  return std::chrono::duration<double>(b - a).count();
}

std::uint64_t count_windows(const std::vector<WindowGrid>& grids) {
  std::uint64_t total = 0;
  for (const WindowGrid& g : grids) total += static_cast<std::uint64_t>(g.windows().product());
  return total;
}

/// The marches of a run: who is told of what, and what all visits add up to.
class Marches {
 public:
  Marches(const RunHooks& hooks, std::uint64_t total) : hooks_(hooks), total_(total) {}

  void run(int march_number, const WindowOrder& order, const WindowVisitor& visitor) {
    const VisitWindow visit = [&](Index3 window) {
      if (hooks_.before_visit) hooks_.before_visit(window);
      add(visitor.visit(window));
    };
    const OnVisited tell = [&](const Visited& v) { note(march_number, v); };
    if (hooks_.pick) {
      const VisitWindow visit_and_tell = [&](Index3 w) { tell(timed_visit(visit, w, 0)); };
      march_by_choice(order, visit_and_tell, hooks_.pick);
    } else {
      march(order, visit, {.threads = hooks_.threads, .visited = tell});
    }
  }

  [[nodiscard]] const VisitStats& stats() const { return stats_; }

 private:
  void add(const VisitStats& visit) {
    const std::lock_guard lock(mutex_);
    stats_ += visit;
  }

  void note(int march_number, const Visited& v) {
    if (hooks_.trace) {
      hooks_.trace({.march = march_number,
                    .window = v.window,
                    .start_seconds = seconds_between(begin_, v.start),
                    .end_seconds = seconds_between(begin_, v.end),
                    .cpu_seconds = v.cpu_seconds,
                    .slot = v.slot});
    }
    ++done_;
    if (hooks_.progress) hooks_.progress(done_, total_);
  }

  const RunHooks& hooks_;
  std::uint64_t total_;
  std::uint64_t done_ = 0;
  Visited::Time begin_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  VisitStats stats_;
};

}  // namespace

RunReport mesh_volume(const io::DenseVolume& volume, const MeshSettings& settings,
                      io::MeshSink& sink, const RunHooks& hooks) {
  check(settings);
  Stopwatch watch;
  const PreparedLabels labels(volume, settings);
  double prepare_seconds = 0.0;
  watch.lap(prepare_seconds);
  const Metric metric(volume.info().spacing);
  const std::vector<WindowGrid> grids = march_grids(volume.info().shape, settings);
  Marches marches(hooks, count_windows(grids));
  std::unique_ptr<BlockStore> store = std::make_unique<MemoryBlockStore>(grids[0].blocks());
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const WindowGrid& grid = grids[i];
    if (i > 0) store = regroup(*store, grids[i - 1].blocks(), grid.blocks());
    const WindowVisitor visitor(labels, metric, settings, grid, *store);
    marches.run(static_cast<int>(i), WindowOrder(grid, settings.order), visitor);
  }
  RunReport report{marches.stats()};
  report.threads = hooks.pick ? 1 : thread_count(hooks.threads);
  report.prepare_seconds = prepare_seconds;
  watch.restart();
  StoredBlocks blocks(*store);
  const FinishedMesh finished = finish(blocks, grids.back(), volume, sink, hooks.output);
  watch.lap(report.output_seconds);
  report.vertices = finished.vertices;
  report.tets = finished.tets;
  report.quality = finished.quality;
  return report;
}

}  // namespace mw::engine
