// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Speed of the kernels on one window of a synthetic polycrystal: coarsening, start mesh,
// contraction, sweeps.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "engine/system/crew.h"
#include "kernels/optimise/optimise.h"
#include "kernels/simplify/simplify.h"
#include "kernels/start/coarsen/coarsen.h"
#include "kernels/start/graded_start.h"
#include "kernels/synth/synth.h"
#include "tests/kernels/start/cells/level_maps.h"

namespace mw {
namespace {

constexpr std::int64_t kEdge = 32;
constexpr Index3 kShape{kEdge, kEdge, kEdge};
constexpr Box3 kBlock{{0, 0, 0}, kShape};

LabelBox grains(std::int64_t halo = kStartHalo) {
  std::vector<RawLabel> raw(static_cast<std::size_t>(kBlock.voxels()));
  synth_slab({.kind = SynthKind::kVoronoi, .shape = kShape, .labels = 40, .seed = 1}, 0, kEdge,
             raw);
  LabelBox out{{{-halo, -halo, -halo}, {kEdge + halo, kEdge + halo, kEdge + halo}}, {}};
  out.labels.assign(static_cast<std::size_t>(out.box.voxels()), kExterior);
  for (Index3 v; v.z < kEdge; ++v.z) {
    for (v.y = 0; v.y < kEdge; ++v.y) {
      for (v.x = 0; v.x < kEdge; ++v.x) {
        out.labels[static_cast<std::size_t>(out.box.offset(v))] =
            static_cast<Label>(raw[static_cast<std::size_t>(kBlock.offset(v))]);
      }
    }
  }
  return out;
}

LevelMap levels(const LabelBox& all) {
  return test::level_map(kShape, [&](const Box3& box) {
    LabelBox out{box, {}};
    for_each_index(
        box, [&](Index3 v) { out.labels.push_back(all.box.contains(v) ? all.at(v) : kExterior); });
    return out;
  });
}

TetMesh window(int max_level) {
  const LabelBox labels = grains();
  const BlockMesh start = graded_start({.shape = labels, .original = labels}, levels(labels),
                                       kBlock, kShape, {.max_level = max_level});
  constexpr auto kFar = static_cast<std::int32_t>(kEdge * kUnitsPerVoxel);
  return TetMesh(start.vertices, start.tets, {kFar, kFar, kFar});
}

void start_mesh(benchmark::State& state) {
  const int level = static_cast<int>(state.range(0));
  const LabelBox labels = grains();
  const LevelMap map = levels(labels);
  for (auto _ : state) {
    benchmark::DoNotOptimize(graded_start({.shape = labels, .original = labels}, map, kBlock,
                                          kShape, {.max_level = level}));
  }
  state.SetItemsProcessed(state.iterations() * kBlock.voxels());
}
BENCHMARK(start_mesh)->Arg(0)->Arg(3)->Unit(benchmark::kMillisecond);

/// Items are voxels.
void coarsening(benchmark::State& state) {
  const LabelBox labels = grains(kCoarsenHalo);
  for (auto _ : state) {
    LabelBox coarse = labels;
    benchmark::DoNotOptimize(coarsen(labels, coarse, kBlock, {.within = {{0, 0, 0}, kShape}}, 1.5));
  }
  state.SetItemsProcessed(state.iterations() * kBlock.voxels());
}
BENCHMARK(coarsening)->Unit(benchmark::kMillisecond);

/// Items are contractions.
void contraction(benchmark::State& state) {
  const TetMesh start = window(static_cast<int>(state.range(0)));
  std::uint64_t contracted = 0;
  for (auto _ : state) {
    TetMesh mesh = start;
    contracted += simplify(mesh, Metric(), {}).contracted;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(contracted));
}
BENCHMARK(contraction)->Arg(0)->Arg(3)->Unit(benchmark::kMillisecond);

/// simplify() of one dense window by the clock; the argument is the number of seeding threads, 0
/// the loop without oneTBB.  Items are contractions.
void seeding(benchmark::State& state) {
  const auto threads = static_cast<std::size_t>(state.range(0));
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  std::max<std::size_t>(threads, 1));
  tbb::task_arena arena(std::max(static_cast<int>(threads), 1));
  SimplifyOptions options;
  if (threads != 0) options.seeding = engine::tbb_for;
  const TetMesh start = window(0);
  std::uint64_t contracted = 0;
  for (auto _ : state) {
    TetMesh mesh = start;
    arena.execute([&] { contracted += simplify(mesh, Metric(), options).contracted; });
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(contracted));
}
BENCHMARK(seeding)->Arg(0)->Arg(1)->Arg(2)->Arg(4)->UseRealTime()->Unit(benchmark::kMillisecond);

/// Items are flips and moves.
void sweep(benchmark::State& state) {
  TetMesh simplified = window(3);
  simplify(simplified, Metric(), {});
  std::uint64_t steps = 0;
  for (auto _ : state) {
    TetMesh mesh = simplified;
    const OptimiseStats stats = optimise(mesh, Metric(), {});
    steps += stats.flips + stats.moves;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(steps));
}
BENCHMARK(sweep)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mw
