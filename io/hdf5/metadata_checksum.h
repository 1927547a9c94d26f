// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The checksum of HDF5's metadata.
#pragma once

#include <cstdint>
#include <string_view>

namespace mw::io {

/// Jenkins' "lookup3" (hashlittle) from 0, as the HDF5 file format asks for.
[[nodiscard]] std::uint32_t metadata_checksum(std::string_view bytes);

}  // namespace mw::io
