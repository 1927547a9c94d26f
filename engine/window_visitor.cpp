// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Gather, simplify, optimise, scatter.
#include "engine/window_visitor.h"

#include <algorithm>

#include "engine/stopwatch.h"

namespace mw::engine {
namespace {

constexpr int kMaxLevel = 3;

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

}  // namespace

WindowVisitor::WindowVisitor(const io::DenseVolume& volume, const MeshSettings& settings,
                             const WindowGrid& grid, BlockStore& store, RunReport& report)
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

void WindowVisitor::visit(Index3 window) {
  Stopwatch watch;
  const std::vector<Index3> blocks = grid_.blocks_of(window);
  std::vector<std::optional<BlockMesh>> stored = store_.take(window);
  std::vector<BlockMesh> content;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    content.push_back(stored[i] ? std::move(*stored[i]) : start(blocks[i]));
  }
  watch.lap(report_.start_seconds);
  WindowContent window_content = gather(content, grid_.volume());
  content.clear();
  watch.lap(report_.exchange_seconds);
  work_on(window_content);
  watch.restart();
  store_.commit(window, scatter(window_content, grid_, window));
  watch.lap(report_.exchange_seconds);
  ++report_.windows;
}

void WindowVisitor::work_on(WindowContent& content) {
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

BlockMesh WindowVisitor::start(Index3 block) const {
  const Box3 box = grid_.block_box(block);
  const std::int64_t halo = start_halo(start_.max_level);
  const Index3 around{halo, halo, halo};
  const LabelBox labels = read_labels(volume_, {box.lo - around, box.hi + around});
  return graded_start(labels, box, grid_.volume(), start_);
}

}  // namespace mw::engine
