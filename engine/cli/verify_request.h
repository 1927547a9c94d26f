// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What `mwmesh verify` is asked to do.
#pragma once

#include <optional>

#include "engine/cli/options/volume_options.h"
#include "engine/job/verify_job.h"
#include "engine/output/label_selection.h"

namespace mw::cli {

struct VerifyRequest {
  VolumeRequest volume;
  engine::LabelChoice choice;
  std::filesystem::path mesh;
  std::filesystem::path report;
  engine::AskedBounds asked;
  int threads = 0;                      ///< 0: all cores
  std::optional<std::uint64_t> memory;  ///< bytes; after check_verify_request() never empty
};

using report::kOtherPromises;

/// Adds every option of the subcommand.  REQUIRES: request outlives options.
void add_verify_options(OptionSet& options, VerifyRequest& request);

/// Fills in what follows from other values.
/// ERRORS: mw::Error(kUsage) when values contradict each other, or names of files collide.
void check_verify_request(VerifyRequest& request);

}  // namespace mw::cli
