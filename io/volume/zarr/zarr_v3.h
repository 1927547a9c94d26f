// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How Zarr 3 names types, grids, keys and codecs, and the chain of codecs of an array.
#pragma once

#include <string>

#include "io/json/json.h"
#include "io/json/json_fields.h"
#include "io/volume/zarr/zarr_array.h"

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

/// Reads `codecs` into array.chunk and array.shard.
/// REQUIRES: type and shape of the array are set, and array.chunk.shape is the one of the grid:
/// with sharding it becomes that of the shards' chunks. ERRORS: mw::Error(kInput) naming file and
/// codec for an unknown one, a wrong order, and sharding within shards or below further codecs.
void parse_codecs(const Json& codecs, const std::string& file, ZarrArray& array);

}  // namespace mw::io
