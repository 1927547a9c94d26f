// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The main job: prepare labels, march over the volume, write the mesh.
#include "engine/run/run.h"

#include <algorithm>
#include <mutex>

#include "engine/forecast/run_forecast.h"
#include "engine/labels/periodic_labels.h"
#include "engine/labels/prepared_labels.h"
#include "engine/run/marches.h"
#include "engine/run/run_context.h"
#include "engine/store/journal/work_file.h"
#include "engine/system/crew.h"
#include "engine/system/memory.h"
#include "engine/system/stopwatch.h"
#include "engine/window/window_memory.h"
#include "engine/window/window_visitor.h"
#include "io/file/errors.h"
#include "io/labels/repeated_volume.h"

namespace mw::engine {
namespace {

/// The blocks of the last march; a run may be stopped while they are read.
class FinishedBlocks : public FinalBlocks {
 public:
  FinishedBlocks(const BlockStore& store, const RunContext& run, RunForecast& forecast)
      : store_(store),
        progress_(run.hooks.progress),
        forecast_(forecast),
        windows_(run.layout.windows()),
        grid_(run.layout.output_grid()),
        last_(run.layout.grid(run.layout.marches() - 1)) {}

  [[nodiscard]] BlockMesh load(Index3 block) override {
    if (progress_) {
      const std::lock_guard lock(mutex_);
      progress_({.done = windows_, .total = windows_, .seconds_left = forecast_.seconds_left()});
      forecast_.reading(block);
    }
    const Index3 stored = last_.in_grid(block);
    return in_other_grid(store_.load(stored), {last_, stored}, {grid_, block});
  }

 private:
  const BlockStore& store_;
  std::mutex mutex_;  ///< guards the next two
  const OnProgress& progress_;
  RunForecast& forecast_;
  std::uint64_t windows_;
  const WindowGrid& grid_;
  const WindowGrid& last_;
};

/// The labels that windows are made from, and what is counted in the whole volume.
struct ReadyLabels {
  MemoryBudget::Reservation room;
  LabelPlan plan;
  std::optional<io::PeriodicVolume> copies;  ///< a cell that repeats itself, with copies around it
  std::optional<PreparedLabels> prepared;

  [[nodiscard]] const LabelCounts& counts() const {
    return plan.counts ? *plan.counts : prepared->counts();
  }
};

void end_stage(const RunContext& run, const char* name) {
  if (run.hooks.stages != nullptr) run.hooks.stages->end(name);
}

void prepare(RunContext& run, ReadyLabels& out) {
  Stopwatch watch;
  const io::DenseVolume& labels = run.lattice.labels();
  out.plan = run.part->plan_labels(labels, run.settings, run.hooks, run.store);
  const LabelNeed* const need = out.plan.need ? &*out.plan.need : nullptr;
  out.room = run.store.reserve(Purpose::kLabels, prepared_bytes(labels, run.settings, need));
  const LabelReaders readers(labels, run.settings, run.hooks, run.store);
  std::filesystem::path folder = run.part->work_folder();
  if (folder.empty() && run.keep != nullptr) folder = run.keep->folder();
  if (folder.empty()) folder = io::scratch_folder();
  if (run.settings.periodic != 0) {
    out.copies.emplace(labels.raw(), periodic_margin(run.settings));
    if (!out.plan.counts) {
      out.plan.counts = counts_of_part(labels, readers.threads, SequencePart{});
    }
    out.prepared.emplace(io::DenseVolume(*out.copies, labels.table()), run.settings,
                         readers.threads, folder, run.hooks.sizes);
  } else if (need == nullptr) {
    out.prepared.emplace(labels, run.settings, readers.threads, folder, run.hooks.sizes);
  } else {
    out.prepared.emplace(labels, run.settings, *need, readers.threads, folder, run.hooks.sizes);
  }
  run.report.thin_parts = out.prepared->thin_parts();
  watch.lap(run.report.prepare_seconds);
}

/// Returns how many of the last marches polish: of a volume that repeats itself the last two, as
/// each of them keeps what lies around the place where its grid begins.
std::uint32_t polishing_marches(const RunLayout& layout) {
  return layout.grid(layout.marches() - 1).first() == Index3{} ? 1 : 2;
}

VisitPlan plan_of(RunContext& run, std::uint32_t march) {
  VisitPlan plan;
  if (run.hooks.threads > 1) plan.seeding = tbb_for;
  const std::uint32_t last = polishing_marches(run.layout);
  if (march + last < run.layout.marches()) return plan;
  plan.last = run.layout.order(march);
  plan.turn = run.layout.marches() - 1 - march;
  plan.turns = last;
  if (last > 1 && plan.turn == 0) plan.before = run.layout.grid(march - 1);
  if (!run.workers) return plan;
  plan.triangulate = [&workers = *run.workers](const Plc& plc) { return workers.triangulate(plc); };
  return plan;
}

/// Visits all windows.  Returns how many were visited here.
std::uint64_t march(RunContext& run, const ReadyLabels& labels, RunForecast& forecast) {
  MeshSettings settings = run.settings;
  if (!settings.inner_quality) settings.inner_quality = inner_quality_for(labels.counts().faces);
  run.report.inner_quality = *settings.inner_quality;
  const Metric metric(run.lattice.info().space.spacing);
  run.part->begin_marches(run.store);
  if (run.keep != nullptr) {
    run.keep->begin(*labels.prepared, settings, run.report.inner_quality, run.hooks.threads);
  }
  Marches marches(run, forecast);
  for (std::uint32_t i = 0; i < run.layout.marches(); ++i) {
    const WindowVisitor visitor(*labels.prepared, metric, settings, run.layout.grid(i),
                                run.store.march(i), plan_of(run, i));
    marches.visit_all(i, visitor);
  }
  if (run.workers) run.report.workers = run.workers->facts();
  static_cast<VisitStats&>(run.report) = run.part->end_marches(marches.stats());
  return marches.stats().windows;
}

/// How output blocks are worked on, and the memory for that beside the rows that it remembers.
struct OutputRoom {
  WorkInOrder work;
  MemoryBudget::Reservation reserved;
};

/// Spills blocks to make room for one; those beside it take no more than an eighth of memory.
OutputRoom reserve_output(RunContext& run, const BlockStore& blocks, const WindowGrid& grid) {
  std::uint64_t largest = 0;
  for_each_index(grid.blocks(),
                 [&](Index3 b) { largest = std::max(largest, blocks.loaded_bytes(b)); });
  const std::uint64_t each = std::max<std::uint64_t>(written_block_bytes(largest), 1);
  const int threads = run.hooks.threads;
  OutputRoom out{.work = {.threads = threads}};
  const std::uint64_t others = std::min<std::uint64_t>(run.budget.limit() / 8 / each,
                                                       threads > 1 ? out.work.at_once - 1 : 0);
  out.work.at_once = 1 + static_cast<std::size_t>(others);
  out.reserved =
      run.store.reserve(Purpose::kOutput, run.sink.buffer_bytes() + out.work.at_once * each,
                        run.hooks.store.buffers_grow);
  return out;
}

void report_mesh(RunContext& run, const FinishedMesh& finished, const LabelCounts& labels) {
  RunReport& report = run.report;
  report.vertices = finished.vertices;
  report.tets = finished.tets;
  report.tets_within = finished.tets_within;
  report.label_voxels = labels.voxels;
  const LabelSelection kept(run.hooks.output.wanted, run.lattice.volume().table());
  for (Label label = 0; label < report.label_voxels.size(); ++label) {
    if (!kept.keeps(label)) report.label_voxels[label] = 0;
  }
}

/// Writes what the last march left.
void write(RunContext& run, const LabelCounts& labels, RunForecast& forecast) {
  if (!run.part->await_output()) return;
  Stopwatch watch;
  const std::uint32_t last = run.layout.marches() - 1;
  const WindowGrid& grid = run.layout.output_grid();
  const BlockStore& stored = run.store.march(last);
  const OutputRoom room = reserve_output(run, stored, grid);
  return_free_memory_above(0);
  MemoryBudget::Reservation rows;
  OutputOptions options = run.hooks.output;
  options.work = room.work;
  options.hold = [&](std::uint64_t bytes) {
    rows = {};
    rows = run.store.reserve(Purpose::kOutput, bytes);
  };
  forecast.begin_output();
  FinishedBlocks blocks(stored, run, forecast);
  const FinishedMesh finished = finish({blocks, grid, run.lattice.volume()}, run.sink, options);
  watch.lap(run.report.output_seconds);
  report_mesh(run, finished, labels);
}

template <std::size_t N>
void copy_peaks(const MemoryBudget& budget, std::array<std::uint64_t, N>& out) {
  for (std::size_t i = 0; i < N; ++i) out[i] = budget.peak(static_cast<Purpose>(i));
}

ProcessFacts facts_of(const MemoryBudget& budget, std::uint64_t windows) {
  ProcessFacts out{.windows = windows, .peak_accounted_bytes = budget.peak()};
  copy_peaks(budget, out.peak_bytes_by_purpose);
  return out;
}

/// Settles what is kept for later runs.
void finish_keep(RunContext& run) {
  if (run.keep == nullptr) return;
  try {
    run.part->finish_keep(*run.keep);
  } catch (const DamagedWork&) {
    throw;
  } catch (const Error& error) {
    throw Error(error.kind(), std::string(error.what()) + "; the mesh is complete all the same");
  }
  run.report.keep = run.keep->facts();
}

void go(RunContext& run) {
  std::optional<ReadyLabels> labels(std::in_place);
  prepare(run, *labels);
  end_stage(run, "prepare");
  const LabelCounts counts = labels->counts();
  RunForecast forecast(counts.faces, run.layout, run.settings, run.hooks.threads);
  const std::uint64_t windows = march(run, *labels, forecast);
  end_stage(run, "march");
  // What is kept for later runs refers to the labels; else their memory and disk serve what
  // follows.
  if (run.keep == nullptr) labels.reset();
  write(run, counts, forecast);
  end_stage(run, "output");
  finish_keep(run);
  if (run.hooks.store.stays) run.report.work = run.part->keep_for_rest(run.store);
  run.report.processes = run.part->end(facts_of(run.budget, windows));
  run.report.memory_budget_bytes = run.budget.limit();
  run.report.peak_accounted_bytes = run.budget.peak();
  copy_peaks(run.budget, run.report.peak_bytes_by_purpose);
  run.report.store = run.store.facts();
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

/// Saves what can be saved after an error; the user is told of the first error only.  Damaged work
/// stays, to show what happened, but nobody is told to go on from it.
void keep_work(RunContext& run, const std::exception_ptr& error) {
  if (run.hooks.store.is_scratch) return;
  const bool damaged = is_damage(error);
  try {
    if (!damaged) run.store.save();
    if (!damaged && run.keep != nullptr) run.keep->save();
  } catch (...) {
    // The disk is full or broken, or memory is out: what was saved before remains.
  }
  const bool has_facts = run.keep != nullptr && run.keep->has_facts();
  const bool can_go_on = run.part->keep_work(run.store) || has_facts;
  if (can_go_on && run.hooks.store.kept && !damaged) run.hooks.store.kept();
}

RunReport run_and_explain(const io::DenseVolume& volume, const MeshSettings& settings,
                          io::MeshSink& sink, const RunHooks& hooks) {
  try {
    RunContext run(volume, settings, sink, hooks);
    try {
      go(run);
    } catch (...) {
      const std::exception_ptr error = run.part->fail(std::current_exception());
      keep_work(run, error);
      std::rethrow_exception(error);
    }
    return std::move(run.report);
  } catch (const DamagedWork& damage) {
    fail_damaged(damage, hooks);
  }
}

}  // namespace

void fail_damaged(const DamagedWork& damage, const RunHooks& hooks) {
  const auto& folder = hooks.keep.folder.empty() ? hooks.store.workdir : hooks.keep.folder;
  throw Error(damage.kind(), io::text(damage.what(), "; the disk or ", folder.string(),
                                      " is damaged: delete that folder and start again"));
}

RunReport mesh_volume(const io::DenseVolume& volume, const MeshSettings& settings,
                      io::MeshSink& sink, const RunHooks& hooks) {
  try {
    return run_and_explain(volume, settings, sink, hooks);
  } catch (...) {
    if (hooks.processes != nullptr) hooks.processes->fail(std::current_exception());
    throw;
  }
}

}  // namespace mw::engine
