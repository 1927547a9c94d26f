// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Large labels that a mesh keeps less well than their users expect, in words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/report/run_report.h"
#include "kernels/audit/shape/volumes.h"

namespace mw::report {

/// Labels of audit::kMinJudgedVoxels and more that are off by more than kShare in volume, whatever
/// P8 allows them.
struct VolumesOff {
  static constexpr double kShare = 0.05;
  static constexpr std::size_t kMostListed = 6;

  std::uint64_t count = 0;
  std::vector<audit::VolumeRow> worst;  ///< the first kMostListed, worst first
};

/// Finds them.  There are none where volumes were not measured, where parts were left out on
/// purpose, and where labels come from scores, whose volume voxels do not tell.
[[nodiscard]] VolumesOff volumes_off(const FinishedRun& run);

/// Returns "3 of 1,000 voxels and more are off by more than 5 %: 1 "Skull" -22.8 %, ..."; empty
/// when none is.
[[nodiscard]] std::string volumes_off_text(const FinishedRun& run);

}  // namespace mw::report
