// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The checksum of Zarr's shards: CRC-32C.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace mw::io {

/// CRC-32C (Castagnoli; RFC 3720, appendix B.4) of the bytes.
[[nodiscard]] std::uint32_t crc32c(std::span<const std::byte> bytes);

}  // namespace mw::io
