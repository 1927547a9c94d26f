// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What `mwmesh mesh` is asked to do.
#pragma once

#include "engine/cli/mesh/progress.h"
#include "engine/cli/options/volume_options.h"
#include "engine/job/mesh_job.h"
#include "engine/settings/settings.h"
#include "io/mesh/element.h"
#include "io/mesh/mesh_extras.h"

namespace mw::cli {

using engine::Certify;

struct MeshRequest {
  VolumeRequest volume;
  std::filesystem::path output;
  io::Element element = io::Element::kTet4;
  io::MeshExtras extras;                 ///< what the output has beside the mesh
  bool force = false;                    ///< whether it may replace files of others, mesh images
  std::filesystem::path report;          ///< empty: none
  std::filesystem::path html;            ///< empty: none
  std::filesystem::path trace;           ///< empty: none
  std::filesystem::path config;          ///< the file that options come from; empty: none
  std::vector<std::string> size_tables;  ///< files that sizes come from
  std::optional<std::uint64_t> memory;   ///< bytes, as asked for
  std::filesystem::path keep;            ///< empty: nothing new is kept
  std::filesystem::path from;            ///< empty: no earlier run is used
  std::filesystem::path delta;           ///< empty: none
  /// What the engine is asked to do; complete after check_mesh_request().
  engine::MeshJob job;
  ProgressKind progress = ProgressKind::kNone;
  std::string log_level;
};

/// Adds every option of the command, in the order of the documentation.
/// REQUIRES: request outlives options.
void add_mesh_options(OptionSet& options, MeshRequest& request);

/// Fills in what follows from other values.
/// ERRORS: mw::Error(kUsage) when values that are allowed by themselves contradict each other.
void check_mesh_request(MeshRequest& request);

/// Checks before any work that names of files are apart (FileNames::require_apart()), and that the
/// work folder neither is one of these files, nor lies in one, nor has one in it.
/// REQUIRES: the work folder of the request is settled.
/// ERRORS: mw::Error(kUsage) naming flag and path.
void require_paths_apart(const MeshRequest& request);

/// Checks that the files that are to be replaced are ours (FileNames::require_own()).
void require_own_output(const MeshRequest& request);

}  // namespace mw::cli
