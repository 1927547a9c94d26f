// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// JSON with a long list of rows, written one by one.
#pragma once

#include <functional>
#include <string_view>

#include "io/json/json.h"

namespace mw::report {

/// Stands for the rows as the value of the key "per_label": as JSON values they would take some 500
/// bytes each, which no budget has set aside.
inline constexpr const char* kRows = "@rows";

using AppendText = std::function<void(std::string_view)>;
using TakeRow = std::function<void(const io::Json&)>;

/// Appends value, indented, and a line end; in place of kRows a list of what for_each_row() passes
/// on. REQUIRES: value has kRows once, in an object of its outermost one.
void append_with_rows(const io::Json& value,
                      const std::function<void(const TakeRow&)>& for_each_row,
                      const AppendText& append);

}  // namespace mw::report
