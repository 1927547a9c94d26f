// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The library's face: a volume and settings in, a mesh and a report out.
#pragma once

#include <array>
#include <functional>

#include "engine/codt/worker_pool.h"
#include "engine/keep/keep_options.h"
#include "engine/labels/prepared_labels.h"
#include "engine/march/march.h"
#include "engine/output/finish.h"
#include "engine/run/processes.h"
#include "engine/settings/settings.h"
#include "engine/settings/together.h"
#include "engine/store/run_store.h"
#include "engine/system/stages.h"
#include "engine/window/window_visitor.h"
#include "io/labels/label_table.h"
#include "io/mesh/mesh_sink.h"

namespace mw::engine {

class SizeImage;

/// The lattice that a volume was meshed on.
struct LatticeFacts {
  Index3 shape;
  std::array<double, 3> spacing{1, 1, 1};
  Index3 layers{1, 1, 1};  ///< into which each voxel of the volume is cut
};

/// What a run did, without windows that were done before a resume.  Times of windows are summed
/// over threads; that of the output is wall seconds.
struct RunReport : VisitStats {
  LatticeFacts lattice;
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
  std::uint64_t tets_within = 0;  ///< see OutputOptions::within
  int halvings = 0;               ///< how often tets were cut into eight when they were written
  ThinParts thin_parts;           ///< what SizeSettings::across found
  int threads = 1;
  double inner_quality = 0.0;    ///< the value that was used, see MeshSettings
  double prepare_seconds = 0.0;  ///< labels: reading, coarsening, large cells
  double output_seconds = 0.0;
  std::vector<std::uint64_t> label_voxels;  ///< by dense label; 0 if it is not written
  std::uint64_t memory_budget_bytes = 0;
  std::uint64_t peak_accounted_bytes = 0;
  std::array<std::uint64_t, kPurposes> peak_bytes_by_purpose{};  ///< not at the same time
  StoreFacts store;
  std::optional<KeepFacts> keep;           ///< where something is kept
  std::shared_ptr<Workdir> work;           ///< for StoreOptions::stays; null if none is kept
  std::vector<ProcessFacts> processes;     ///< empty if there is only one
  std::optional<codt::PoolFacts> workers;  ///< with Optimizer::kTetgen
};

/// How far a run is.
struct RunProgress {
  std::uint64_t done = 0;   ///< windows, those of an earlier run included
  std::uint64_t total = 0;  ///< windows
  /// An estimate (RunForecast); empty before this run has done any window.
  std::optional<double> seconds_left;
};

/// Called after each window and for each block that is read for output, never by two threads at a
/// time; may throw to stop the run.
using OnProgress = std::function<void(const RunProgress& progress)>;

/// One visit in a run's trace; seconds since the run began.
struct TraceEvent {
  int march = 0;
  Index3 window;
  double start_seconds = 0.0;
  double end_seconds = 0.0;
  double cpu_seconds = 0.0;  ///< of the visiting thread
  int slot = 0;              ///< of the visiting thread, below the number of threads
  std::uint64_t bytes = 0;   ///< memory that the visit needs; 0 where another run made it
};

/// How a run goes, and callbacks that watch it.  Nothing here changes the result.
struct RunHooks {
  OnProgress progress;  ///< optional
  PickReady pick;       ///< optional; one thread visits ready windows in this order
  int threads = 1;      ///< 1 is the sequential reference; 0 stands for all cores
  std::function<void(const TraceEvent&)> trace;  ///< optional, never called by two threads at once
  /// Optional; called by the visiting thread before each visit, by many threads at once.
  std::function<void(Index3 window)> before_visit;
  OutputOptions output;
  const SizeImage* sizes = nullptr;  ///< of SizeRules::image; outlives the run
  StoreOptions store;                ///< memory and disk
  /// If it names a folder, that takes the place of the work folder: what memory does not hold, and
  /// what a later run can go on from, is there.
  KeepOptions keep;
  codt::PoolOptions workers;     ///< of Optimizer::kTetgen
  StageMeter* stages = nullptr;  ///< optional; the run ends its stages prepare, march and output
  /// The processes that the run is divided among; null if it is this one alone.  All of them call
  /// mesh_volume() with the same volume and settings; only the one that speaks uses its sink, and
  /// the others return when its output is complete.  Store options and threads are each one's own.
  Processes* processes = nullptr;
  /// Optional, with several processes, on the one that speaks.  A thread of its own often asks it
  /// whether to save and end the run, which then throws StoppedAfterSave.
  std::function<bool()> stop_after_save;
  /// If true, nothing else goes on in this process: its processor time is the run's, and the
  /// allocator gives large pieces back at once under a tight budget (mallopt).
  bool owns_process = false;
};

/// Says where a run that ended early left its work, and how to go on with it.
[[nodiscard]] std::string way_on(const RunHooks& hooks);

/// Returns what a run takes from its beginning to its end, as far as that is known before any work:
/// the program, names, the table of blocks, prepared labels.
[[nodiscard]] std::uint64_t standing_bytes(const io::DenseVolume& volume,
                                           const MeshSettings& settings, const RunHooks& hooks);

/// Returns what a run is asked for, as far as hooks and settings tell it.
[[nodiscard]] Asked asked_of(const RunHooks& hooks, const MeshSettings& settings);

/// Meshes the whole box of the volume into `sink`, on its VoxelLattice, in whose voxels the windows
/// and bounds of the settings are counted.
/// ENSURES: promises P1 to P3 and P5 of the README.
///          A run that ends early, by an error or because progress throws, leaves what it has done
///          in the work folder, if there is one and anything was done; otherwise the folder goes.
/// ERRORS: whatever volume and sink throw; those of check(volume, settings) (voxel_lattice.h),
///         check_together(asked_of()), Workdir and RunStore.
RunReport mesh_volume(const io::DenseVolume& volume, const MeshSettings& settings,
                      io::MeshSink& sink, const RunHooks& hooks = {});

/// Throws the error again with the way out of damaged work.
[[noreturn]] void fail_damaged(const DamagedWork& damage, const RunHooks& hooks);

}  // namespace mw::engine
