// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a caller can choose about memory and disk; the result does not depend on it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "engine/store/memory_budget.h"
#include "engine/store/run_store.h"

namespace mw::engine {

struct StoreOptions {
  std::uint64_t memory = MemoryBudget::kUnlimited;  ///< bytes, for the whole process
  std::filesystem::path workdir;                    ///< empty: everything stays in memory
  bool resume = false;                              ///< go on from what workdir holds
  /// What else a run must have in common with the one that it goes on from: lines "name = value".
  /// The engine adds shape, spacing and settings.
  std::string identity;
  GroupCommit group;
  /// Called when a run that ends early leaves work in the folder.
  std::function<void()> kept;
};

}  // namespace mw::engine
