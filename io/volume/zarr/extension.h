// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The one form in which Zarr 3 names types, grids, keys and codecs.
#pragma once

#include <string>

#include "io/json/json.h"
#include "io/json/json_fields.h"

namespace mw::io {

/// "NAME", or {"name": "NAME", "configuration": {...}}.
struct Extension {
  std::string name;
  Json configuration;  ///< an object, empty when there is none
  std::string where;   ///< what errors call the configuration

  [[nodiscard]] JsonFields fields(const std::string& file) const {
    return {configuration, file, where};
  }
};

/// ERRORS: mw::Error(kInput) naming file and `where` for another form.
[[nodiscard]] Extension parse_extension(const Json& value, const std::string& file,
                                        const std::string& where);

}  // namespace mw::io
