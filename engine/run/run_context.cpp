// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/run/run_context.h"

#include <algorithm>

#include "engine/keep/keep_options.h"
#include "engine/labels/label_scan.h"
#include "engine/labels/periodic_labels.h"
#include "engine/settings/promises.h"
#include "engine/store/journal/identity.h"
#include "engine/system/crew.h"
#include "engine/window/window_memory.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"

namespace mw::engine {
namespace {

/// Refuses scores whose copies beside a cell would not begin with a whole voxel of theirs.
void check_copies_of_scores(const io::VolumeInfo& info, const MeshSettings& settings) {
  const Index3 layers = layers_of(info.space.spacing, info.shape, settings.periodic);
  const Index3 margin = periodic_margin(settings);
  for (unsigned axis = 0; axis < 3; ++axis) {
    const std::int64_t around = along(margin, axis), each = along(layers, axis);
    if (around % each == 0) continue;
    io::fail_usage(io::text("--periodic: --values are seen ", around,
                            " layers beyond a face, but voxels have ", each, " layers along ",
                            "xyz"[axis], ", which do not divide that; resample the volume"));
  }
}

/// Returns the settings once check() has found nothing wrong with them.
const MeshSettings& checked(const io::DenseVolume& volume, const MeshSettings& settings) {
  check(volume.info(), settings);
  if (volume.raw().scores() != nullptr) check_copies_of_scores(volume.info(), settings);
  check(volume.table(), settings);
  return settings;
}

RunHooks settled(RunHooks hooks, const MeshSettings& settings, Index3 layers) {
  hooks.output.promises = promises_of(settings);
  hooks.output.layers = layers;
  hooks.threads = hooks.pick ? 1 : thread_count(hooks.threads);
  if (hooks.processes == nullptr) hooks.processes = &one_process();
  check_together(asked_of(hooks, settings));
  if (!hooks.keep.folder.empty()) hooks.store.workdir.clear();
  return hooks;
}

/// Returns a grid that begins after a share of the blocks along periodic axes.
WindowGrid grid_from(Index3 shape, int window, const MeshSettings& settings, int thirds) {
  const WindowGrid grid(shape, window);
  const auto first = [&](unsigned axis, std::int64_t blocks) {
    return (settings.periodic >> axis & 1U) != 0 ? thirds * blocks / 3 : 0;
  };
  const Index3 blocks = grid.blocks();
  return {shape, window, {first(0, blocks.x), first(1, blocks.y), first(2, blocks.z)}};
}

/// Returns one grid for each march.  A vertex near a block plane is free in half as many windows,
/// so it stays denser there; the next march has other planes and heals that.
///
/// Where the volume repeats itself, all marches but the last keep the planes where it ends.  The
/// last one is done twice, over grids that begin at a third and at two thirds of the volume, so
/// that windows lie across these planes.  Each of the two heals what the other keeps: where it
/// begins.
std::vector<WindowGrid> march_grids(Index3 shape, const MeshSettings& settings) {
  std::vector<WindowGrid> grids;
  const int most = std::min(kMaxWindow, largest_window(shape, settings));
  int window = settings.window;
  while (window > most) window = window / 4 * 2;
  for (int i = 0; i < settings.marches && window <= most; ++i, window *= 2) {
    grids.emplace_back(shape, window);
  }
  if (settings.periodic == 0) return grids;
  const auto last = static_cast<int>(2 * grids.back().block_edge());
  if (grids.size() > 1) grids.pop_back();
  grids.push_back(grid_from(shape, last, settings, 1));
  grids.push_back(grid_from(shape, last, settings, 2));
  return grids;
}

/// Returns program_bytes() and what names of labels take: all names, those that are written, and a
/// sink's text of them.
std::uint64_t always_bytes(const io::DenseVolume& volume, int threads) {
  constexpr std::uint64_t kCopies = 8;
  return program_bytes(volume.table().size(), threads) + kCopies * volume.info().names.bytes();
}

/// Returns what reading, and then writing, take at least beside what is there all the time.
struct KnownStages {
  explicit KnownStages(const RunContext& run)
      : buffers(run.lattice.labels().raw().buffer_bytes(1)),
        reading(buffers +
                preparation_bytes(run.settings, run.lattice.labels().raw().scores() != nullptr)),
        writing(run.sink.buffer_bytes()) {}

  std::uint64_t buffers;
  std::uint64_t reading;
  std::uint64_t writing;
};

/// Refuses a budget that is below what the parts of known size take.  What windows take depends on
/// the labels, which are not known yet, so a budget is named that usual ones get along with.
[[noreturn]] void refuse_budget(const RunContext& run, std::uint64_t always,
                                const KnownStages& stages) {
  constexpr double kCacheShare = 0.25;              // of --memory, for chunks that were unpacked
  constexpr std::uint64_t kUsualBlock = 2U << 20U;  // to write it
  const MemoryBudget& budget = run.budget;
  const std::uint64_t least =
      std::max(budget.memory_with(always + stages.reading, stages.buffers > 0 ? kCacheShare : 0),
               budget.memory_with(always + stages.writing, run.hooks.store.buffers_grow));
  const std::uint64_t enough = std::max(
      {least,
       budget.memory_with(always + stages.writing + kUsualBlock, run.hooks.store.buffers_grow),
       budget.memory_with(
           always + usual_window_bytes(run.layout.grid(0), run.settings.sizes.limits_edges()))});
  budget.refuse("--memory " + io::mebibytes(enough) + " is enough for most labels, and for none " +
                "is less than " + io::mebibytes(least));
}

/// Reserves what the program takes.
MemoryBudget::Reservation reserve_program(RunContext& run) {
  const io::DenseVolume& labels = run.lattice.labels();
  const std::uint64_t program = always_bytes(labels, run.hooks.threads);
  const std::uint64_t always =
      program + run.hooks.processes->least_bytes(run.layout, labels, run.settings);
  const KnownStages stages(run);
  const std::uint64_t min = always + std::max(stages.reading, stages.writing);
  if (min > run.budget.limit()) refuse_budget(run, always, stages);
  return run.budget.reserve(Purpose::kProgram, program);
}

std::optional<codt::WorkerPool> start_workers(const RunContext& run) {
  if (run.settings.optimizer != Optimizer::kTetgen) return std::nullopt;
  return std::optional<codt::WorkerPool>(std::in_place, run.hooks.workers);
}

std::unique_ptr<RunPart> take_part(RunContext& run, const io::VolumeInfo& info) {
  const std::string identity = run.hooks.store.identity + identity_text(info, run.settings);
  return run.hooks.processes->take_part(run.layout, run.hooks, identity);
}

std::unique_ptr<WindowKeep> open_keep(RunContext& run, const io::VolumeInfo& info) {
  const KeepOptions& options = run.hooks.keep;
  if (options.folder.empty()) return nullptr;
  const std::string settings =
      io::text(options.identity, "folder-format = ", kFolderFormat, "\nresults = ", results_id(),
               "\n", identity_text(info, run.settings));
  return run.part->open_keep([&](int process) {
    KeepOptions here = options;
    if (process > 0) here = {.folder = kept_part(options.folder, process), .use = KeepUse::kGoOn};
    return std::make_unique<WindowKeep>(here, settings, run.layout, run.budget,
                                        run.lattice.labels().table(), run.hooks.store.group);
  });
}

RunReport begun_report(const RunContext& run) {
  RunReport report;
  report.lattice = {run.lattice.info().shape, run.lattice.info().space.spacing,
                    run.lattice.layers()};
  report.threads = run.hooks.threads;
  return report;
}

}  // namespace

std::uint64_t standing_bytes(const io::DenseVolume& volume, const MeshSettings& settings,
                             const RunHooks& hooks) {
  const VoxelLattice lattice(volume, settings.periodic);
  const RunLayout layout(march_grids(lattice.info().shape, settings), settings.order);
  const Processes& processes = hooks.processes == nullptr ? one_process() : *hooks.processes;
  return always_bytes(lattice.labels(), thread_count(hooks.threads)) +
         processes.least_bytes(layout, lattice.labels(), settings);
}

std::string way_on(const RunHooks& hooks) {
  const bool is_kept = !hooks.keep.folder.empty();
  const bool are_many = !is_alone(hooks.processes);
  const auto& folder = is_kept ? hooks.keep.folder : hooks.store.workdir;
  return "the work so far is in " + folder.string() +
         (is_kept && are_many ? ", run mwmesh without mpirun and with --resume to go on"
                              : ", add --resume to go on");
}

Asked asked_of(const RunHooks& hooks, const MeshSettings& settings) {
  const bool is_kept = !hooks.keep.folder.empty();
  return {.keep = is_kept,
          .keep_bytes = hooks.keep.bytes.has_value(),
          .update = is_kept && hooks.keep.use == KeepUse::kUpdate,
          .colour = settings.order == Order::kColour,
          .periodic = settings.periodic != 0,
          .count = settings.sizes.count > 0,
          .many = !is_alone(hooks.processes)};
}

std::uint64_t prepared_bytes(const io::DenseVolume& volume, const MeshSettings& settings,
                             const LabelNeed* need) {
  const Index3 margin = periodic_margin(settings);
  const Index3 shape = volume.info().shape + margin + margin;
  // Labels of a cell are coarsened without its copies, so bricks of both have places meanwhile.
  const bool has_cell = settings.periodic != 0 && is_coarsened(settings);
  const std::uint64_t of_cell = has_cell ? brick_place_bytes(volume.info().shape) : 0;
  const bool sized = settings.sizes.limits_edges();
  const bool has_source = volume.raw().scores() != nullptr && !sized;
  if (need == nullptr) {
    return of_cell + prepared_label_bytes(shape, sized) +
           (has_source ? brick_place_bytes(shape) : 0);
  }
  return of_cell + prepared_label_bytes(bricks_of(*need, shape, settings), shape, sized);
}

LabelReaders::LabelReaders(const io::DenseVolume& volume, const MeshSettings& settings,
                           const RunHooks& hooks, RunStore& store) {
  const std::uint64_t each = preparation_bytes(settings, volume.raw().scores() != nullptr);
  threads = reader_count(volume.raw(), hooks.threads, {each, hooks.store.memory});
  const auto taken = [&] {
    return static_cast<std::uint64_t>(threads) * each + volume.raw().buffer_bytes(threads);
  };
  for (; threads > 1; --threads) {
    auto room = store.try_reserve(Purpose::kLabels, taken());
    if (!room) continue;
    scratch = std::move(*room);
    return;
  }
  scratch = store.reserve(Purpose::kLabels, taken());
}

RunContext::RunContext(const io::DenseVolume& volume, const MeshSettings& wanted,
                       io::MeshSink& output, const RunHooks& asked)
    : settings(checked(volume, wanted)),
      sink(output),
      lattice(volume, settings.periodic),
      hooks(settled(asked, settings, lattice.layers())),
      layout(march_grids(lattice.info().shape, settings), settings.order),
      budget(hooks.store.memory, hooks.processes->count_here(), hooks.store.memory_beside),
      program_room(reserve_program(*this)),
      workers(start_workers(*this)),
      part(take_part(*this, volume.info())),
      keep(open_keep(*this, volume.info())),
      store(layout, budget, part->work_files(), hooks.store.group, part->router(), keep.get()),
      attached(part->attach(store)),
      report(begun_report(*this)) {}

}  // namespace mw::engine
