// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// `mwmesh stats --json`.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/cli/stats/stats_facts.h"

namespace mw::cli {

/// {"labels": [..], "contacts": [..]}, all digits; what is not known of a volume is left out.
[[nodiscard]] nlohmann::ordered_json stats_json(const StatsFacts& facts);

}  // namespace mw::cli
