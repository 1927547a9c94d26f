// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the steps of a run work on and with.
#pragma once

#include "engine/keep/window_keep.h"
#include "engine/labels/label_need.h"
#include "engine/labels/voxel_lattice.h"
#include "engine/run/run.h"
#include "engine/store/run_store.h"

namespace mw::engine {

/// Returns the bytes that prepared labels hold; need is null for the labels of the whole volume.
[[nodiscard]] std::uint64_t prepared_bytes(const io::DenseVolume& volume,
                                           const MeshSettings& settings, const LabelNeed* need);

/// Threads that read labels (reader_count()), and the memory that they hold meanwhile.  There are
/// fewer of them where that memory is not free.
struct LabelReaders {
  LabelReaders(const io::DenseVolume& volume, const MeshSettings& settings, const RunHooks& hooks,
               RunStore& store);

  int threads = 1;
  MemoryBudget::Reservation scratch;
};

/// Everything that lives from before the first label is read until the mesh is written.  The
/// arguments outlive it.  Labels and marches belong to the steps that make them.
struct RunContext {
  /// ERRORS: those of check(volume, settings), RunPart, RunStore; mw::Error(kResource) with the
  /// least budget that works, as far as that is known before any work.
  RunContext(const io::DenseVolume& volume, const MeshSettings& settings, io::MeshSink& sink,
             const RunHooks& asked);

  const MeshSettings& settings;
  io::MeshSink& sink;
  VoxelLattice lattice;
  RunHooks hooks;  ///< with all that is known of the output, and as many threads as there will be
  RunLayout layout;
  MemoryBudget budget;
  MemoryBudget::Reservation program_room;
  std::optional<codt::WorkerPool> workers;  ///< with Optimizer::kTetgen
  std::unique_ptr<RunPart> part;
  std::unique_ptr<WindowKeep> keep;  ///< null: nothing is kept
  RunStore store;
  std::shared_ptr<void> attached;  ///< blocks come in as long as it lives
  RunReport report;
};

}  // namespace mw::engine
