// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// JSON with a long list of rows, written one by one.
#include "engine/report/json_rows.h"

namespace mw::report {

using io::Json;

void append_with_rows(const Json& value, const std::function<void(const TakeRow&)>& for_each_row,
                      const AppendText& append) {
  const std::string text = value.dump_indented();
  // Inside of a string the quotes would be escaped, so this is the key and no part of a value.
  const std::string key = "\"per_label\": ";
  const std::string rows = "\"" + std::string(kRows) + "\"";
  const std::size_t at = text.find(key + rows) + key.size();
  append(std::string_view(text).substr(0, at));
  append("[");
  const char* before = "";
  for_each_row([&](const Json& row) {
    append(std::string(before) + "\n      " + row.dump());
    before = ",";
  });
  append("\n    ]");
  append(std::string_view(text).substr(at + rows.size()));
  append("\n");
}

}  // namespace mw::report
