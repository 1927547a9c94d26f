// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What hangs together in a mesh, as JSON and as a line.
#pragma once

#include <string>
#include <vector>

#include "engine/connect/connect_options.h"
#include "io/json/json.h"

namespace mw::report {

/// Returns "parts" of a report.
[[nodiscard]] io::Json connect_json(const engine::ConnectFacts& facts, bool labels_signed);

/// Tells from "parts" of a report what options left out, doubled or put in between; empty where
/// they did nothing.
[[nodiscard]] std::string changes_text(const io::Json& parts);

/// Returns that, and how many parts there are and hang; empty where the mesh is one part.
[[nodiscard]] std::string connect_text(const engine::ConnectFacts& facts);

/// Returns the pairs as an option has them, "1|2, 1|3"; empty where there are none.
[[nodiscard]] std::string pairs_text(const std::vector<engine::LabelPair>& pairs,
                                     bool labels_signed);
[[nodiscard]] io::Json pairs_json(const std::vector<engine::LabelPair>& pairs, bool labels_signed);

}  // namespace mw::report
