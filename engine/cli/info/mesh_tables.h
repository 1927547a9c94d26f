// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// `mwmesh info` of a mesh as tables of text.
#pragma once

#include "engine/cli/info/mesh_info.h"
#include "engine/cli/info/text_table.h"

namespace mw::cli {

/// Numbers of a table: whole for scripts, four digits for eyes.
enum class Digits { kAll, kFour };

/// What a table of labels holds.
enum class LabelColumns { kSizes, kPlaces, kBoth };

/// A row for each label, ascending.
[[nodiscard]] TextTable label_table(const MeshInfo& facts, Digits digits, LabelColumns columns);

/// A row for each of contacts_of().
[[nodiscard]] TextTable contact_table(const MeshInfo& facts, Digits digits);

}  // namespace mw::cli
