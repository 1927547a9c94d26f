// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a user should look at when a mesh is finished, and what could be tried next.
#pragma once

#include <string>
#include <vector>

#include "engine/report/run_report.h"

namespace mw::report {

/// Labels of fewer voxels are said to keep their volume less well.
inline constexpr std::uint64_t kFewVoxels = 100;

/// Returns a line each, with the option that helps, as on the command line.
[[nodiscard]] std::vector<std::string> attention(const FinishedRun& run);

/// Returns that line of the spacing that was taken where nobody said one; empty where one is known.
[[nodiscard]] std::string spacing_text(const FinishedRun& run);

/// Returns a size of edges and about how many tets it gives, where no size was asked for and edges
/// are long; null otherwise.
[[nodiscard]] io::Json suggestion(const FinishedRun& run);

}  // namespace mw::report
