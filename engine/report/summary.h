// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a user reads first of a mesh, told from the tree of a report.
#pragma once

#include <string>

#include "io/json/json.h"

namespace mw::report {

/// Returns lines for people: tets, edges, shapes, volumes, labels, what the options did, checks,
/// time and file.  REQUIRES: the keys of run_report(); lines about what is null are left out.
[[nodiscard]] std::string summary_text(const io::Json& report);

/// Returns what figures of volumes need where parts of labels were left out; else "".
[[nodiscard]] std::string without_parts(const io::Json& report);

/// Returns a line for each thing to look at, and last the suggestion, if there is one.
[[nodiscard]] std::string attention_text(const io::Json& report);

}  // namespace mw::report
