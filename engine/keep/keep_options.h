// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run keeps for later runs, and what it takes from an earlier one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernels/core/index.h"

namespace mw::engine {

class KeepFolder;

enum class KeepUse {
  kBegin,   ///< the folder holds nothing yet
  kGoOn,    ///< with what is there, if there is something
  kUpdate,  ///< an earlier run has left something there
};

struct KeepOptions {
  std::filesystem::path folder;  ///< empty: nothing is kept
  KeepUse use = KeepUse::kBegin;
  /// What the folder may take when the run ends; none: as an earlier run said, or any number.
  std::optional<std::uint64_t> bytes;
  /// Boxes of the volume's voxels outside of which the labels are those of the run that was
  /// complete last; empty: anything may have changed.  For mesh() (engine/job/mesh_job.h).
  std::vector<Box3> changed;
  /// What else two runs must have in common: lines "name = value".
  std::string identity;
  /// The folder, where it is open already; null: it is opened.
  std::shared_ptr<KeepFolder> opened;
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
  std::uint64_t voxels_read = 0;    ///< of labels, from the volume and not from the folder
  std::uint64_t bytes_kept = 0;     ///< in the folder, at the end
  std::uint64_t bytes_written = 0;  ///< of blocks
};

}  // namespace mw::engine
