// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run keeps for later runs, and what it takes from an earlier one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "kernels/core/index.h"

namespace mw::engine {

enum class KeepUse {
  kBegin,   ///< the folder holds nothing yet
  kGoOn,    ///< with what is there, if there is something
  kUpdate,  ///< an earlier run has left something there
};

struct KeepOptions {
  static constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

  std::filesystem::path folder;  ///< empty: nothing is kept
  KeepUse use = KeepUse::kBegin;
  /// Boxes of the lattice outside of which the labels are those of the run that used the folder
  /// last; empty: anything may have changed.
  std::vector<Box3> changed;
  std::uint64_t max_bytes = kUnlimited;  ///< of the folder, once the run is done
  /// What else two runs must have in common: lines "name = value".
  std::string identity;
  /// Optional: told, in a line each, what a user should know.
  std::function<void(const std::string&)> say;
};

/// What a run took from a folder, and left there.
struct KeepFacts {
  struct March {
    std::uint64_t visited = 0;
    std::uint64_t skipped = 0;
  };
  std::vector<March> marches;
  std::uint64_t tiles_read = 0;     ///< of labels
  std::uint64_t bytes_kept = 0;     ///< in the folder, at the end
  std::uint64_t bytes_written = 0;  ///< of blocks
};

}  // namespace mw::engine
