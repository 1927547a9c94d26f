// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The metadata of a Zarr array of version 2: .zarray.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "io/volume/zarr/zarr_array.h"

namespace mw::io {

/// Zarr specification, version 2.  file: what errors name.
/// ERRORS: mw::Error(kInput) naming file and field for what is missing, wrong or not read here:
/// filters, structured types and compressors beyond those of Codec.
[[nodiscard]] ZarrArray parse_zarr_v2(const nlohmann::json& document, const std::string& file);

}  // namespace mw::io
