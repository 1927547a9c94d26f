// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What reports are made of, by the names that commands use.
#pragma once

#include "engine/report/mesh_facts.h"

namespace mw::cli {

using report::add_colour;
using report::append_with_rows;
using report::betti_json;
using report::interfaces_json;
using report::kRows;
using report::label_json;
using report::label_text;
using report::named_row_json;
using report::print_specks;
using report::specks_json;
using report::TakeRow;
using report::volume_row_json;
using report::volume_summary_json;
using report::welds_json;
using report::write_json;

}  // namespace mw::cli
