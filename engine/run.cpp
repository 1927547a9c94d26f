// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The main job: march over the volume, then finish.
#include "engine/run.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>

#include "engine/forecast/run_forecast.h"
#include "engine/labels/prepared_labels.h"
#include "engine/labels/voxel_lattice.h"
#include "engine/marches.h"
#include "engine/shared_run.h"
#include "engine/store/damaged_work.h"
#include "engine/store/run_identity.h"
#include "engine/store/workdir.h"
#include "engine/system/resident_memory.h"
#include "engine/system/stopwatch.h"
#include "engine/system/tbb_for.h"
#include "engine/team_labels.h"
#include "engine/team_output.h"
#include "engine/team_run.h"
#include "engine/window/inner_quality.h"
#include "engine/window/window_memory.h"
#include "io/file/errors.h"

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

/// The blocks of the last march; a run may be stopped while they are read.
class FinishedBlocks : public FinalBlocks {
 public:
  FinishedBlocks(const BlockStore& store, const OnProgress& progress, RunForecast& forecast,
                 std::uint64_t windows)
      : store_(store), progress_(progress), forecast_(forecast), windows_(windows) {}

  [[nodiscard]] BlockMesh load(Index3 block) override {
    if (progress_) {
      progress_({.done = windows_, .total = windows_, .seconds_left = forecast_.seconds_left()});
      forecast_.reading(block);
    }
    return store_.load(block);
  }

 private:
  const BlockStore& store_;
  const OnProgress& progress_;
  RunForecast& forecast_;
  std::uint64_t windows_;
};

/// program_bytes(), and the names of labels: all, those that are written, and a sink's text of
/// them.
std::uint64_t always_bytes(const io::DenseVolume& volume, int threads) {
  constexpr std::uint64_t kCopies = 8;
  return program_bytes(volume.table().size(), threads) + kCopies * volume.info().names.bytes();
}

/// share: null: the labels of the whole volume.
std::uint64_t prepared_bytes(const io::DenseVolume& volume, const MeshSettings& settings,
                             const LabelShare* share) {
  const Index3 shape = volume.info().shape;
  const bool sized = !settings.sizes.labels.empty();
  if (share == nullptr) return prepared_label_bytes(shape, sized);
  return prepared_label_bytes(bricks_of(*share, shape, settings), shape, sized);
}

std::uint64_t output_buffer_bytes(const io::MeshSink& sink, const RunHooks& hooks) {
  const std::uint64_t together = hooks.together == nullptr ? 0 : hooks.together->buffer_bytes();
  return std::max(sink.buffer_bytes(), together);
}

/// Tells at once, before any work, the least that the parts take whose size is known by then.
/// What windows take depends on the labels, and on what earlier windows leave.
void require_min(const RunLayout& layout, const io::DenseVolume& volume,
                 const MeshSettings& settings, const io::MeshSink& sink, const RunHooks& hooks,
                 int threads, const MemoryBudget& budget) {
  // Of several processes none knows its share yet.
  const LabelShare nothing;
  const LabelShare* const share = hooks.team == nullptr ? nullptr : &nothing;
  const std::uint64_t always =
      always_bytes(volume, threads) + prepared_bytes(volume, settings, share) +
      (share == nullptr ? index_bytes(layout) : shared_index_bytes(layout));
  const std::uint64_t reading = preparation_bytes(settings) + volume.raw().buffer_bytes(1);
  const std::uint64_t min = always + std::max(reading, output_buffer_bytes(sink, hooks));
  if (min > budget.limit()) budget.fail(min);
}

/// Threads that read labels, and what these hold meanwhile, beside what the volume keeps of its
/// file: so many that this stays below a quarter of the budget.
struct Readers {
  Readers(const io::DenseVolume& volume, const MeshSettings& settings, int max_threads,
          const StoreOptions& options, RunStore& store) {
    const std::uint64_t each = preparation_bytes(settings);
    const auto at_once = std::clamp<std::uint64_t>(options.memory / 4 / each, 1,
                                                   static_cast<std::uint64_t>(max_threads));
    threads = static_cast<int>(at_once);
    scratch = store.reserve(Purpose::kLabels, at_once * each + volume.raw().buffer_bytes(threads));
  }

  int threads = 1;
  MemoryBudget::Reservation scratch;
};

/// Reads and coarsens the labels, or a share of them; their memory is `room`, and more while they
/// are made.
PreparedLabels prepare(const io::DenseVolume& volume, const MeshSettings& settings,
                       const LabelShare* share, int threads, const StoreOptions& options,
                       RunStore& store, MemoryBudget::Reservation& room) {
  room = store.reserve(Purpose::kLabels, prepared_bytes(volume, settings, share));
  const Readers readers(volume, settings, threads, options, store);
  const std::filesystem::path folder =
      options.workdir.empty() ? io::scratch_folder() : options.workdir;
  if (share == nullptr) return {volume, settings, readers.threads, folder};
  return {volume, settings, *share, readers.threads, folder};
}

/// What is settled before a process prepares its labels.
struct Dealt {
  LabelCounts counts;  ///< of the whole volume
  Partition partition;
  LabelShare share;
};

/// Settles who visits what.
Dealt deal(Team& team, const RunLayout& layout, const io::DenseVolume& volume,
           const MeshSettings& settings, int threads, const StoreOptions& options,
           RunStore& store) {
  const LabelShare nothing;
  const auto room = store.reserve(Purpose::kLabels, prepared_bytes(volume, settings, &nothing));
  const Readers readers(volume, settings, threads, options, store);
  Dealt out{count_together(team, volume, readers.threads), {}, {}};
  out.partition = deal_windows(team, layout, settings, out.counts.faces);
  out.share = share_of(layout, out.partition, team.rank(), settings);
  return out;
}

io::MeshPromises promises_of(const MeshSettings& settings) {
  return {.max_distance = settings.max_distance,
          .quality_floor = settings.quality_floor,
          .interfaces = settings.topology == KeptTopology::kInterfaces,
          .smooth = settings.surface == Surface::kSmooth};
}

/// Writes what the last march left; memory for that comes first, blocks are spilled to make room.
/// own_lines: none where this process writes all.
FinishedMesh write_mesh(const RunLayout& layout, const VoxelLattice& lattice, RunStore& store,
                        io::MeshSink& sink, const std::optional<LineShare>& own_lines,
                        const RunHooks& hooks, RunForecast& forecast) {
  const std::uint32_t last = layout.marches() - 1;
  const WindowGrid& grid = layout.grid(last);
  const BlockStore& stored = store.march(last);
  std::uint64_t largest = 0;
  for_each_index(grid.blocks(),
                 [&](Index3 b) { largest = std::max(largest, stored.loaded_bytes(b)); });
  const auto room = store.reserve(Purpose::kOutput,
                                  output_buffer_bytes(sink, hooks) + written_block_bytes(largest));
  return_free_memory_above(0);
  MemoryBudget::Reservation rows;
  OutputOptions options = hooks.output;
  options.layers = lattice.layers();
  options.hold = [&](std::uint64_t bytes) {
    rows = {};
    rows = store.reserve(Purpose::kOutput, bytes);
  };
  forecast.begin_output();
  FinishedBlocks blocks(stored, hooks.progress, forecast, layout.windows());
  if (!own_lines) return finish(blocks, grid, lattice.volume(), sink, options);
  return finish_together(*hooks.team, *own_lines, blocks, grid, lattice.volume(), *hooks.together,
                         options);
}

void report_labels(FinishedMesh& finished, const LabelCounts& labels, const LabelSelection& kept,
                   RunReport& report) {
  report.label_volumes6 = std::move(finished.label_volumes6);
  report.longest_edges = std::move(finished.longest_edges);
  report.label_voxels = labels.voxels;
  for (Label label = 0; label < report.label_voxels.size(); ++label) {
    if (!kept.keeps(label)) report.label_voxels[label] = 0;
  }
}

/// Everything between an open store and a written mesh.  Returns how many windows were visited
/// here.  shared: null where all windows are visited here; workers: null without TetGen.
std::uint64_t march_and_write(const RunLayout& layout, const VoxelLattice& lattice,
                              const MeshSettings& settings, RunStore& store, io::MeshSink& sink,
                              const RunHooks& hooks, SharedRun* shared, codt::WorkerPool* workers,
                              RunReport& report) {
  Stopwatch watch;
  MemoryBudget::Reservation room;
  std::optional<Dealt> dealt;
  if (shared != nullptr) {
    dealt =
        deal(*hooks.team, layout, lattice.labels(), settings, report.threads, hooks.store, store);
  }
  const PreparedLabels labels = prepare(lattice.labels(), settings, dealt ? &dealt->share : nullptr,
                                        report.threads, hooks.store, store, room);
  const LabelCounts& counts = dealt ? dealt->counts : labels.counts();
  watch.lap(report.prepare_seconds);
  MeshSettings chosen = settings;
  if (!chosen.inner_quality) chosen.inner_quality = inner_quality_for(counts.faces);
  report.inner_quality = *chosen.inner_quality;
  const Metric metric(lattice.info().space.spacing);
  RunForecast forecast(counts.faces, layout, settings, report.threads);
  if (shared != nullptr) shared->begin(store, std::move(dealt->partition));
  Marches marches(hooks, layout, forecast, store.facts().resumed_windows,
                  shared == nullptr ? nullptr : &shared->traffic());
  for (std::uint32_t i = 0; i < layout.marches(); ++i) {
    WindowVisitor visitor(labels, metric, chosen, layout.grid(i), store.march(i));
    if (report.threads > 1) visitor.seed_with(tbb_for);
    if (i + 1 == layout.marches()) visitor.polish(layout.order(i));
    if (i + 1 == layout.marches() && workers != nullptr) {
      visitor.reconnect_with([workers](const Plc& plc) { return workers->triangulate(plc); });
    }
    marches.run(i, store.march(i), visitor);
  }
  static_cast<VisitStats&>(report) = marches.stats();
  if (workers != nullptr) report.workers = workers->facts();
  if (shared != nullptr) {
    static_cast<VisitStats&>(report) = sum_of_all(*hooks.team, report);
    shared->end_marches();
    report.written_together = shared->own_lines().has_value();
    if (!hooks.team->is_first() && !report.written_together) return marches.stats().windows;
    shared->traffic().wait_for_output();
  }
  watch.restart();
  FinishedMesh finished =
      write_mesh(layout, lattice, store, sink,
                 shared != nullptr ? shared->own_lines() : std::nullopt, hooks, forecast);
  watch.lap(report.output_seconds);
  report.vertices = finished.vertices;
  report.tets = finished.tets;
  report.quality = finished.quality;
  report.shape = finished.shape;
  if (!finished.label_volumes6.empty()) {
    report_labels(finished, counts, LabelSelection(hooks.output.wanted, lattice.volume().table()),
                  report);
  }
  return marches.stats().windows;
}

bool is_damage(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const DamagedWork&) {
    return true;
  } catch (...) {
    return false;
  }
}

/// After an error: what can be saved is, and the first error stays the one that is told.
void keep_work(RunStore& store, Workdir* workdir, const SharedRun* shared,
               const StoreOptions& options, const std::exception_ptr& error) {
  if (workdir == nullptr) return;
  const bool damaged = is_damage(error);
  try {
    if (!damaged) store.save();
  } catch (...) {
    // The disk is full or broken, or memory is out: what was saved before remains.
  }
  if (store.has_saved_work()) workdir->keep();
  // Nobody is told to go on from damage; it stays for whoever wants to know what happened.
  const bool can_go_on = shared != nullptr ? shared->has_saved_work() : store.has_saved_work();
  if (can_go_on && options.kept && !damaged) options.kept();
}

RankFacts rank_facts(const MemoryBudget& budget, std::uint64_t windows) {
  RankFacts out{.windows = windows, .sent = {}, .peak_accounted_bytes = budget.peak()};
  for (std::size_t i = 0; i < kPurposes; ++i) {
    out.peak_bytes_by_purpose[i] = budget.peak(static_cast<Purpose>(i));
  }
  return out;
}

/// mesh_volume() but for errors.
RunReport run(const io::DenseVolume& volume, const MeshSettings& settings, io::MeshSink& sink,
              const RunHooks& asked) {
  check(volume.info(), settings);
  check(volume.table(), settings);
  RunHooks hooks = asked;
  hooks.output.promises = promises_of(settings);
  const VoxelLattice lattice(volume, settings.surface);
  RunReport report;
  report.lattice = {lattice.info().shape, lattice.info().space.spacing, lattice.layers()};
  report.threads = hooks.pick ? 1 : thread_count(hooks.threads);
  const RunLayout layout(march_grids(lattice.info().shape, settings), settings.order);
  MemoryBudget budget(hooks.store.memory, hooks.team != nullptr ? hooks.team->ranks_here() : 1);
  require_min(layout, lattice.labels(), settings, sink, hooks, report.threads, budget);
  const auto program = budget.reserve(Purpose::kProgram, always_bytes(volume, report.threads));
  std::optional<codt::WorkerPool> workers;
  if (settings.optimizer == Optimizer::kTetgen) workers.emplace(hooks.workers);
  const std::string identity = hooks.store.identity + identity_text(volume.info(), settings);
  std::optional<SharedRun> shared;
  std::unique_ptr<Workdir> alone;
  if (hooks.team != nullptr) {
    shared.emplace(*hooks.team, layout, hooks, identity);
  } else if (!hooks.store.workdir.empty()) {
    alone = std::make_unique<Workdir>(hooks.store.workdir, hooks.store.resume, identity);
  }
  Workdir* workdir = shared ? shared->workdir() : alone.get();
  BlockTraffic* traffic = shared ? &shared->traffic() : nullptr;
  RunStore store(layout, budget, workdir, hooks.store.group, traffic);
  std::optional<BlockTraffic::Attached> attached;
  if (traffic != nullptr) attached.emplace(*traffic, store);
  try {
    const std::uint64_t own_windows =
        march_and_write(layout, lattice, settings, store, sink, hooks, shared ? &*shared : nullptr,
                        workers ? &*workers : nullptr, report);
    if (shared) report.ranks = shared->end(rank_facts(budget, own_windows));
  } catch (...) {
    std::exception_ptr error = std::current_exception();
    if (shared) error = shared->fail(error);
    keep_work(store, workdir, shared ? &*shared : nullptr, hooks.store, error);
    std::rethrow_exception(error);
  }
  if (alone != nullptr) alone->discard();
  report.memory_budget_bytes = budget.limit();
  report.peak_accounted_bytes = budget.peak();
  for (std::size_t i = 0; i < kPurposes; ++i) {
    report.peak_bytes_by_purpose[i] = budget.peak(static_cast<Purpose>(i));
  }
  report.store = store.facts();
  return report;
}

/// The same, with the way out of damaged work.
RunReport run_and_explain(const io::DenseVolume& volume, const MeshSettings& settings,
                          io::MeshSink& sink, const RunHooks& hooks) {
  try {
    return run(volume, settings, sink, hooks);
  } catch (const DamagedWork& damage) {
    const std::string folder = hooks.store.workdir.string();
    throw Error(damage.kind(), io::text(damage.what(), "; the disk or ", folder,
                                        " is damaged: delete that folder and start again"));
  }
}

}  // namespace

RunReport mesh_volume(const io::DenseVolume& volume, const MeshSettings& settings,
                      io::MeshSink& sink, const RunHooks& hooks) {
  if (hooks.team == nullptr) return run_and_explain(volume, settings, sink, hooks);
  try {
    return run_and_explain(volume, settings, sink, hooks);
  } catch (...) {
    hooks.team->fail(std::current_exception());
    throw;
  }
}

}  // namespace mw::engine
