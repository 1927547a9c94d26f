// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The processes that a run is divided among, as one of them sees them: one, or many (engine/team).
#pragma once

#include <array>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/keep/window_keep.h"
#include "engine/labels/label_counts.h"
#include "engine/labels/label_need.h"
#include "engine/march/arrival_front.h"
#include "engine/store/journal/run_folder.h"
#include "engine/store/memory_budget.h"
#include "engine/store/run_store.h"
#include "engine/window/window_visitor.h"

namespace mw::engine {

struct RunHooks;

/// What one process did, and the memory that it held.
struct ProcessFacts {
  std::uint64_t windows = 0;
  std::uint64_t blocks_sent = 0;
  std::uint64_t bytes_sent = 0;
  std::uint64_t peak_accounted_bytes = 0;
  std::array<std::uint64_t, kPurposes> peak_bytes_by_purpose{};  ///< not at the same time
};

/// The labels that the windows of this process need.
struct LabelPlan {
  std::optional<LabelNeed> need;      ///< empty if all of them
  std::optional<LabelCounts> counts;  ///< of the whole volume; if empty, of the prepared labels
};

/// Opens what a process keeps for later runs (kept_part()).
using OpenKeep = std::function<std::unique_ptr<WindowKeep>(int process)>;

/// Thrown by a run that was asked to save its work and to stop (RunHooks::stop_after_save).
struct StoppedAfterSave {};

/// What one process does in a run.  The members are called in the order in which they stand.
/// ERRORS (of all except fail() and keep_work()): those of the other processes.
class RunPart {
 public:
  virtual ~RunPart() = default;

  /// Returns null when there is no work folder.
  [[nodiscard]] virtual WorkFiles* work_files() = 0;
  /// Returns the folder of temporary files; empty when there is none.
  [[nodiscard]] virtual std::filesystem::path work_folder() const = 0;
  /// Returns null when all blocks stay here.
  [[nodiscard]] virtual BlockRouter* router() = 0;
  /// Calls `open` with the number of this process; that of the one that speaks is 0, and its turn
  /// comes first.
  [[nodiscard]] virtual std::unique_ptr<WindowKeep> open_keep(const OpenKeep& open) = 0;
  /// Lets blocks come into the store until the result is destroyed.
  [[nodiscard]] virtual std::shared_ptr<void> attach(RunStore& store) = 0;

  /// Decides which labels are prepared here.  Memory: that of preparation (LabelReaders).
  [[nodiscard]] virtual LabelPlan plan_labels(const io::DenseVolume& volume,
                                              const MeshSettings& settings, const RunHooks& hooks,
                                              RunStore& store) = 0;
  /// To be called once labels are prepared.  ENSURES: what an earlier run left is in the store.
  virtual void begin_marches(RunStore& store) = 0;
  /// True if the window is visited here.
  [[nodiscard]] virtual bool visits(const WindowKey& key) const = 0;
  /// Returns the part of a march that is visited here; none if that is all of it.
  [[nodiscard]] virtual std::optional<PartialMarch> part_of_march(std::uint32_t march) = 0;
  /// To be called once all own windows are done.  Returns the sum of the visits of all processes.
  [[nodiscard]] virtual VisitStats end_marches(const VisitStats& own) = 0;

  /// True if this process writes the mesh; all final blocks are in the store then.
  [[nodiscard]] virtual bool await_output() = 0;
  /// To be called once the mesh is complete, where something is kept: the process that speaks has
  /// what all have kept.
  virtual void finish_keep(WindowKeep& keep) = 0;
  /// To be called once the mesh is complete and more is to be written (StoreOptions::stays): saves
  /// the work and gives the folder away, in which it stays until it is discarded.  Returns null if
  /// no run could go on from there; a failure to save is no error.
  [[nodiscard]] virtual std::shared_ptr<Workdir> keep_for_rest(RunStore& store) = 0;
  /// To be called once the output is complete: the work folder is not needed any more, unless it
  /// was given away.  Returns what each process did; empty if there is only one.
  [[nodiscard]] virtual std::vector<ProcessFacts> end(const ProcessFacts& own) = 0;

  /// Ends a process that cannot go on.  Returns the error that the run ends with.
  /// ENSURES: only messages that still come in use the store.
  [[nodiscard]] virtual std::exception_ptr fail(const std::exception_ptr& error) = 0;
  /// To be called after fail(): keeps the work folder if work is saved in it.  Returns true if
  /// another run can go on from there.
  [[nodiscard]] virtual bool keep_work(const RunStore& store) = 0;
};

/// Thread safety: any thread may call count(), count_here(), speaks() and fail().
class Processes {
 public:
  virtual ~Processes() = default;

  [[nodiscard]] virtual int count() const = 0;
  /// Returns the number of processes on this machine, which share its memory and its cores.
  [[nodiscard]] virtual int count_here() const = 0;
  /// True for exactly one of them, which speaks to the user and writes what one process writes.
  [[nodiscard]] virtual bool speaks() const = 0;

  /// Returns the labels of the whole volume, which then has the fingerprint of all of it.
  [[nodiscard]] virtual io::LabelTable collect_labels(FingerprintVolume& volume, int threads) = 0;
  /// Returns the least bytes of the table of blocks and the prepared labels, as far as they are
  /// known before any label is read.
  [[nodiscard]] virtual std::uint64_t least_bytes(const RunLayout& layout,
                                                  const io::DenseVolume& volume,
                                                  const MeshSettings& settings) const = 0;
  /// Begins a run.  identity holds lines "name = value" of what its result depends on.  Arguments
  /// outlive the result.  ERRORS: those of Workdir; mw::Error(kUsage) when processes differ.
  [[nodiscard]] virtual std::unique_ptr<RunPart> take_part(const RunLayout& layout,
                                                           const RunHooks& hooks,
                                                           const std::string& identity) = 0;
  /// Tells the others that this process cannot go on.
  virtual void fail(const std::exception_ptr& error) = 0;
};

/// True for the process that speaks; null stands for one that is alone.
[[nodiscard]] inline bool speaks(const Processes* processes) {
  return processes == nullptr || processes->speaks();
}

/// True where a run is not divided.
[[nodiscard]] inline bool is_alone(const Processes* processes) {
  return processes == nullptr || processes->count() == 1;
}

/// Returns the one process of a run that is not divided.
[[nodiscard]] Processes& one_process();

}  // namespace mw::engine
