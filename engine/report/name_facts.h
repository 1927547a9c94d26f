// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How outputs say what labels are called.
#pragma once

#include <string>

#include "io/json/json.h"
#include "io/labels/label_table.h"
#include "io/names/label_names.h"
#include "kernels/audit/subject.h"

namespace mw::report {

/// `7`, or `7 "liver"`.
[[nodiscard]] std::string label_text(RawLabel label, bool is_signed, const io::LabelNames& names);

/// `label 7 "liver"` of a dense label, for audits.  REQUIRES: table outlives it.
[[nodiscard]] audit::LabelText label_texts(const io::LabelTable& table, io::LabelNames names);

/// {"label": 7, "name": "liver"}, the name where there is one: what a row about a label begins
/// with.
[[nodiscard]] io::Json named_row_json(RawLabel label, bool is_signed, const io::LabelNames& names);

/// Adds "colour": [r, g, b, a], 0 to 255, where it is known.
void add_colour(io::Json& row, RawLabel label, const io::LabelNames& names);

}  // namespace mw::report
