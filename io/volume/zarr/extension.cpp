// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parses names with configurations.
#include "io/volume/zarr/extension.h"

namespace mw::io {

Extension parse_extension(const nlohmann::json& value, const std::string& file,
                          const std::string& where) {
  Extension out{.configuration = nlohmann::json::object(), .where = where + ".configuration"};
  if (value.is_string()) {
    out.name = value.get<std::string>();
    return out;
  }
  const JsonFields fields(value, file, where);
  out.name = fields.text("name");
  if (fields.has("configuration")) {
    static_cast<void>(fields.object("configuration"));  // checks that it is one
    out.configuration = value.at("configuration");
  }
  return out;
}

}  // namespace mw::io
