// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The main job: march over the volume, then finish.
#include "engine/run.h"

#include <memory>

#include "engine/finish.h"
#include "engine/stopwatch.h"
#include "engine/store/run_identity.h"
#include "engine/store/workdir.h"
#include "engine/window_memory.h"
#include "engine/window_visitor.h"

namespace mw::engine {
namespace {

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

std::unique_ptr<Workdir> open_workdir(const io::VolumeInfo& volume, const MeshSettings& settings,
                                      const StoreOptions& options) {
  if (options.workdir.empty()) return nullptr;
  return std::make_unique<Workdir>(options.workdir, options.resume,
                                   options.identity + identity_text(volume, settings));
}

/// Tells at once the least that works for the first march.  What a later window takes depends on
/// what earlier ones leave.
void require_least(const RunLayout& layout, const io::DenseVolume& volume, MemoryBudget& budget) {
  (void)budget.reserve(Purpose::kWindows, program_bytes(volume) + index_bytes(layout) +
                                              start_window_bytes(layout.grid(0)));
}

void march_all(const RunLayout& layout, const io::DenseVolume& volume, const MeshSettings& settings,
               RunStore& store, const RunHooks& hooks, RunReport& report) {
  const std::uint64_t done_before = store.facts().resumed_windows;
  for (std::uint32_t i = 0; i < layout.marches(); ++i) {
    const WindowGrid& grid = layout.grid(i);
    BlockStore& blocks = store.march(i);
    WindowVisitor visitor(volume, settings, grid, blocks, report);
    const VisitWindow visit = [&](Index3 window) {
      if (blocks.is_done(window)) return;
      // Alone in flight, it is admitted or this throws.
      (void)blocks.admit(window, window_bytes(grid, window, blocks));
      visitor.visit(window);
      if (hooks.progress) hooks.progress(done_before + report.windows, layout.windows());
    };
    if (hooks.pick) {
      march(grid, visit, hooks.pick);
    } else {
      march(grid, visit);
    }
  }
}

void write_mesh(const RunLayout& layout, RunStore& store, const io::DenseVolume& volume,
                io::MeshSink& sink, RunReport& report) {
  Stopwatch watch;
  const std::uint32_t last = layout.marches() - 1;
  const FinishedMesh finished = finish(store.march(last), layout.grid(last), volume, sink);
  watch.lap(report.output_seconds);
  report.vertices = finished.vertices;
  report.tets = finished.tets;
}

/// After an error: what can be saved is, and the first error stays the one that is told.
void keep_work(RunStore& store, Workdir* workdir, const StoreOptions& options) {
  if (workdir == nullptr) return;
  try {
    store.save();
  } catch (...) {
    // The disk is full or broken, or memory is out: what was saved before remains.
  }
  if (!store.has_saved_work()) return;
  workdir->keep();
  if (options.kept) options.kept();
}

}  // namespace

RunReport mesh_volume(const io::DenseVolume& volume, const MeshSettings& settings,
                      io::MeshSink& sink, const RunHooks& hooks) {
  check(settings);
  RunReport report;
  const RunLayout layout(march_grids(volume.info().shape, settings));
  MemoryBudget budget(hooks.store.memory);
  require_least(layout, volume, budget);
  const auto program = budget.reserve(Purpose::kProgram, program_bytes(volume));
  const auto workdir = open_workdir(volume.info(), settings, hooks.store);
  RunStore store(layout, budget, workdir.get(), hooks.store.group);
  try {
    march_all(layout, volume, settings, store, hooks, report);
    write_mesh(layout, store, volume, sink, report);
  } catch (...) {
    keep_work(store, workdir.get(), hooks.store);
    throw;
  }
  if (workdir != nullptr) workdir->discard();
  report.memory_budget_bytes = budget.limit();
  report.peak_accounted_bytes = budget.peak();
  report.store = store.facts();
  return report;
}

}  // namespace mw::engine
