// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The main job: march over the volume, then finish.
#include "engine/run.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "engine/block_store.h"
#include "engine/finish.h"
#include "engine/window.h"
#include "kernels/lattice/graded_start.h"

namespace mw::engine {
namespace {

constexpr int kMaxWindow = 256;
constexpr int kMaxLevel = 3;
constexpr int kMaxMarches = 4;
constexpr double kMaxDistance = 16.0;

class Stopwatch {
 public:
  /// Adds the time since the last call (or construction) to `seconds`.
  void lap(double& seconds) {
    const auto now = std::chrono::steady_clock::now();
    seconds += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  void restart() { last_ = std::chrono::steady_clock::now(); }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Labels of a box that may reach outside the volume.
LabelBox read_labels(const io::DenseVolume& volume, const Box3& box) {
  const Index3 shape = volume.info().shape;
  LabelBox out{box, {}};
  out.labels.assign(static_cast<std::size_t>(out.box.voxels()), kExterior);
  const Box3 inside{
      {std::max<std::int64_t>(out.box.lo.x, 0), std::max<std::int64_t>(out.box.lo.y, 0),
       std::max<std::int64_t>(out.box.lo.z, 0)},
      {std::min(out.box.hi.x, shape.x), std::min(out.box.hi.y, shape.y),
       std::min(out.box.hi.z, shape.z)}};
  std::vector<Label> read(static_cast<std::size_t>(inside.voxels()));
  volume.read(inside, read);
  auto row = read.begin();
  for (Index3 v = inside.lo; v.z < inside.hi.z; ++v.z) {
    for (v.y = inside.lo.y; v.y < inside.hi.y; ++v.y) {
      v.x = inside.lo.x;
      const auto end = row + inside.shape().x;
      std::copy(row, end, out.labels.begin() + out.box.offset(v));
      row = end;
    }
  }
  return out;
}

/// The largest cells of the octree: blocks must start at multiples of their size.
int max_level(int window) {
  const int block = window / 2;
  int level = 0;
  while (level < kMaxLevel && block % (2 << level) == 0) ++level;
  return level;
}

/// The blocks of a march, each made of the eight that the march before left in its place.
std::unique_ptr<BlockStore> regroup(BlockStore& before, Index3 blocks_before, Index3 blocks) {
  auto store = std::make_unique<MemoryBlockStore>(blocks);
  each_index(blocks, [&](Index3 b) {
    std::vector<BlockMesh> parts;
    each_index({2, 2, 2}, [&](Index3 i) {
      const Index3 part{2 * b.x + i.x, 2 * b.y + i.y, 2 * b.z + i.z};
      if (!Box3{{0, 0, 0}, blocks_before}.contains(part)) return;
      parts.push_back(before.take(part).value());
    });
    store->put(b, merge(parts));
  });
  return store;
}

/// Visits windows: gathers blocks, runs the kernels, scatters.
class WindowVisitor {
 public:
  WindowVisitor(const io::DenseVolume& volume, const MeshSettings& settings, const WindowGrid& grid,
                BlockStore& store, RunReport& report)
      : volume_(volume),
        grid_(grid),
        store_(store),
        report_(report),
        metric_(volume.info().spacing),
        start_{.max_level = settings.start == StartMesh::kOctree ? max_level(settings.window) : 0,
               .with_samples = settings.max_distance.has_value()},
        simplify_{.quality_floor = settings.quality_floor, .edge_variance = settings.edge_variance},
        optimise_{.sweeps = settings.optimise ? 1 : 0, .quality_floor = settings.quality_floor},
        max_distance_(settings.max_distance) {}

  void visit(Index3 window) {
    Stopwatch watch;
    const std::vector<Index3> blocks = grid_.blocks_of(window);
    std::vector<BlockMesh> content;
    for (Index3 b : blocks) content.push_back(take(b));
    watch.lap(report_.start_seconds);
    WindowContent window_content = gather(content, grid_.volume());
    watch.lap(report_.exchange_seconds);
    work_on(window_content);
    watch.restart();
    content = scatter(window_content, grid_, window);
    for (std::size_t i = 0; i < blocks.size(); ++i) store_.put(blocks[i], std::move(content[i]));
    watch.lap(report_.exchange_seconds);
    ++report_.windows;
  }

 private:
  void work_on(WindowContent& content) {
    LabelBox labels;
    std::optional<DistanceGuard> guard;
    if (max_distance_) {
      const std::int64_t halo = LabelReach::search_reach(*max_distance_);
      labels = read_labels(volume_, voxels_around(content.mesh, halo));
      guard.emplace(labels, grid_.volume(), *max_distance_, content.samples);
    }
    DistanceGuard* const keep_distance = guard ? &*guard : nullptr;
    Stopwatch watch;
    report_.simplify += simplify(content.mesh, metric_, simplify_, keep_distance);
    watch.lap(report_.simplify_seconds);
    report_.optimise += optimise(content.mesh, metric_, optimise_, keep_distance);
    watch.lap(report_.optimise_seconds);
  }

  BlockMesh take(Index3 block) {
    if (auto stored = store_.take(block)) return std::move(*stored);
    const Box3 box = grid_.block_box(block);
    const std::int64_t halo = start_halo(start_.max_level);
    const Index3 around{halo, halo, halo};
    const LabelBox labels = read_labels(volume_, {box.lo - around, box.hi + around});
    return graded_start(labels, box, grid_.volume(), start_);
  }

  const io::DenseVolume& volume_;
  const WindowGrid& grid_;
  BlockStore& store_;
  RunReport& report_;
  Metric metric_;
  StartOptions start_;
  SimplifyOptions simplify_;
  OptimiseOptions optimise_;
  std::optional<double> max_distance_;
};

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

[[noreturn]] void refuse(const std::string& setting, const std::string& allowed) {
  throw Error(ErrorKind::kUsage, setting + " must be " + allowed);
}

}  // namespace

void check(const MeshSettings& s) {
  if (s.window < 4 || s.window > kMaxWindow || s.window % 2 != 0) {
    refuse("window", "an even number from 4 to " + std::to_string(kMaxWindow));
  }
  if (s.marches < 1 || s.marches > kMaxMarches) {
    refuse("marches", "from 1 to " + std::to_string(kMaxMarches));
  }
  if (!(s.quality_floor >= 0.0 && s.quality_floor <= 0.5)) {
    refuse("quality-floor", "from 0 to 0.5");
  }
  if (s.edge_variance && !(*s.edge_variance > 0.0)) {
    refuse("edge-variance", "positive, or none");
  }
  if (s.max_distance &&
      !(*s.max_distance >= DistanceGuard::least_distance() && *s.max_distance <= kMaxDistance)) {
    refuse("max-distance", "from 0.71 to 16 voxels, or none (the samples are 0.71 voxels apart)");
  }
}

RunReport mesh_volume(const io::DenseVolume& volume, const MeshSettings& settings,
                      io::MeshSink& sink, const RunHooks& hooks) {
  check(settings);
  RunReport report;
  const std::vector<WindowGrid> grids = march_grids(volume.info().shape, settings);
  std::uint64_t total = 0;
  for (const WindowGrid& g : grids) total += static_cast<std::uint64_t>(g.windows().product());
  std::unique_ptr<BlockStore> store = std::make_unique<MemoryBlockStore>(grids[0].blocks());
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const WindowGrid& grid = grids[i];
    if (i > 0) store = regroup(*store, grids[i - 1].blocks(), grid.blocks());
    WindowVisitor visitor(volume, settings, grid, *store, report);
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
  const FinishedMesh finished = finish(*store, grids.back(), volume, sink);
  watch.lap(report.output_seconds);
  report.vertices = finished.vertices;
  report.tets = finished.tets;
  return report;
}

}  // namespace mw::engine
