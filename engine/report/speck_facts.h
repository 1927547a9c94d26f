// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What --drop-specks did, as summaries and reports say it.
#pragma once

#include <optional>

#include "io/json/json.h"
#include "io/labels/despeckled_volume.h"

namespace mw::report {

/// "specks" of a report; null when none were to be dropped.
[[nodiscard]] io::Json specks_json(const std::optional<io::SpeckFacts>& specks);

/// One line; nothing when none were to be dropped.
void print_specks(const std::optional<io::SpeckFacts>& specks);

}  // namespace mw::report
