// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What `mwmesh verify` is asked to do.
#pragma once

#include <optional>

#include "engine/cli/label_choice.h"
#include "engine/cli/volume_options.h"
#include "engine/report/verify_report.h"
#include "io/mesh/mesh_record.h"

namespace mw::cli {

struct VerifyRequest {
  VolumeRequest volume;
  LabelChoice choice;
  std::filesystem::path mesh;
  std::filesystem::path report;
  // What is not given is what the run promised that made the mesh.
  std::optional<bool> count_junctions;
  std::optional<double> quality_floor;
  std::optional<std::optional<double>> max_distance;
  std::optional<bool> in_layers;        ///< distances in voxels of the lattice of smooth surfaces
  audit::AuditOptions checks;           ///< bounds that no run promises
  int threads = 0;                      ///< 0: all cores
  std::optional<std::uint64_t> memory;  ///< bytes; after check_verify_request() never empty
};

using report::Bounds;
using report::kOtherPromises;

/// Every option of the subcommand.  REQUIRES: request outlives options.
void add_verify_options(OptionSet& options, VerifyRequest& request);

/// Fills in what follows from other values.
/// ERRORS: mw::Error(kUsage) when something is missing, or values contradict each other.
void check_verify_request(VerifyRequest& request);

/// record: of the mesh's file.
[[nodiscard]] Bounds bounds_of(const VerifyRequest& request, const io::MeshRecord& record);

}  // namespace mw::cli
