// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The memory that labels take while they are read, and afterwards.
#pragma once

#include "engine/labels/label_need.h"
#include "engine/run/run.h"
#include "engine/store/run_store.h"

namespace mw::engine {

/// What prepared labels hold.  need: null: the labels of the whole volume.
[[nodiscard]] std::uint64_t prepared_bytes(const io::DenseVolume& volume,
                                           const MeshSettings& settings, const LabelNeed* need);

/// Threads that read labels, and what these hold meanwhile, beside what the volume keeps of its
/// file: so many that this stays below a quarter of the budget.
struct LabelReaders {
  LabelReaders(const io::DenseVolume& volume, const MeshSettings& settings, const RunHooks& hooks,
               RunStore& store);

  int threads = 1;
  MemoryBudget::Reservation scratch;
};

}  // namespace mw::engine
