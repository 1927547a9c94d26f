// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run keeps for later runs, what it takes from an earlier one, and an id of the sources that
// decide on results, as facts from other sources are not used.
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
  kGoOn,    ///< the run goes on with what is there, if anything
  kUpdate,  ///< an earlier run has left something there
};

struct KeepOptions {
  std::filesystem::path folder;  ///< if empty, nothing is kept
  KeepUse use = KeepUse::kBegin;
  /// Bytes that the folder may take when the run ends; if empty, the limit of an earlier run holds.
  std::optional<std::uint64_t> bytes;
  /// Boxes of the volume's voxels outside of which the labels are those of the run that was
  /// complete last.  If empty, anything may have changed.  mesh() uses it (engine/job/mesh_job.h).
  std::vector<Box3> changed;
  /// Further lines "name = value" that two runs must have in common.
  std::string identity;
  /// The folder if it is open already; if null, it is opened.
  std::shared_ptr<KeepFolder> opened;
  /// Optional; called once it is known that settings and budget fit, before anything is kept.
  std::function<void()> begin;
  /// Optional; called with each line that a user should read.
  std::function<void(const std::string&)> say;
};

/// What a run took from a folder, and left there.
struct KeepFacts {
  struct March {
    std::uint64_t visited = 0;
    std::uint64_t skipped = 0;
  };
  std::vector<March> marches;
  std::uint64_t voxels_read = 0;    ///< voxels read from the volume, not from the folder
  std::uint64_t bytes_kept = 0;     ///< what the folder takes at the end
  std::uint64_t bytes_written = 0;  ///< bytes of blocks written
};

/// Returns 16 hexadecimal digits, which differ for other sources.  results_id.cmake makes the file
/// that defines it.
[[nodiscard]] const char* results_id();

}  // namespace mw::engine
