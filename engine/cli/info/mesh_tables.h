// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// `mwmesh info` of a mesh as tables of text.
#pragma once

#include "engine/cli/info/mesh_info.h"
#include "engine/cli/info/text_table.h"

namespace mw::cli {

/// How numbers of a table are written: with all digits for scripts, with four for people.
enum class Digits { kAll, kFour };

/// What a table of labels holds.
enum class LabelColumns { kSizes, kPlaces, kBoth };

/// Returns a table with a row for each label, ascending.
[[nodiscard]] TextTable label_table(const MeshInfo& facts, Digits digits, LabelColumns columns);

/// Returns a table with a row for each of contacts_of().
[[nodiscard]] TextTable contact_table(const MeshInfo& facts, Digits digits);

}  // namespace mw::cli
