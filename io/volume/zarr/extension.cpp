// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parses names with configurations.
#include "io/volume/zarr/extension.h"

namespace mw::io {

Extension parse_extension(const Json& value, const std::string& file, const std::string& where) {
  Extension out{.configuration = Json::object(), .where = where + ".configuration"};
  if (value.is_string()) {
    out.name = value.text();
    return out;
  }
  const JsonFields fields(value, file, where);
  out.name = fields.text("name");
  if (fields.has("configuration")) {
    static_cast<void>(fields.object("configuration"));  // checks that it is one
    out.configuration = value["configuration"];
  }
  return out;
}

}  // namespace mw::io
