// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// `mwmesh stats --json`.
#pragma once

#include "engine/cli/stats/stats_facts.h"
#include "io/json/json.h"

namespace mw::cli {

/// {"labels": [..], "contacts": [..]}, all digits; what is not known of a volume is left out.
[[nodiscard]] io::Json stats_json(const StatsFacts& facts);

}  // namespace mw::cli
