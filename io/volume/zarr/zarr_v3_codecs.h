// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The chain of codecs of a Zarr array of version 3.
#pragma once

#include <string>

#include "io/json/json.h"
#include "io/volume/zarr/zarr_array.h"

namespace mw::io {

/// Reads `codecs` into array.chunk and array.shard.
/// REQUIRES: type and shape of the array are set, and array.chunk.shape is the one of the grid:
/// with sharding it becomes that of the shards' chunks. ERRORS: mw::Error(kInput) naming file and
/// codec for an unknown one, a wrong order, and sharding within shards or below further codecs.
void parse_codecs(const Json& codecs, const std::string& file, ZarrArray& array);

}  // namespace mw::io
