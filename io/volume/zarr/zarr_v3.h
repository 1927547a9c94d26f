// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The metadata of a Zarr array of version 3: zarr.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "io/volume/zarr/zarr_array.h"

namespace mw::io {

/// Zarr core specification, version 3.0, with the codecs bytes, transpose, gzip, zstd, blosc,
/// crc32c and sharding_indexed.  file: what errors name. ERRORS: mw::Error(kInput) naming file and
/// field for what is missing, wrong or not read here, and for extensions that must be understood.
[[nodiscard]] ZarrArray parse_zarr_v3(const nlohmann::json& document, const std::string& file);

}  // namespace mw::io
