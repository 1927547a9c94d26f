// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How users ask for materials by ranges of a value.
#pragma once

#include <string_view>

#include "io/mesh/grouped/material_sets.h"

namespace mw::engine {

/// Parses "NAME=N" or "NAME=N:LO:HI".  ERRORS: mw::Error(kUsage) for another form, for fewer than 1
/// or more than io::kMostMaterials materials, and unless LO is below HI.
[[nodiscard]] io::MaterialRule parse_materials(std::string_view text);

}  // namespace mw::engine
