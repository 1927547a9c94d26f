// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The checksums that stores carry, their own and ours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace mw::io {

/// CRC-32C (Castagnoli; RFC 3720, appendix B.4) of the bytes: Zarr's shards.  before: that of the
/// bytes in front of them.
[[nodiscard]] std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before = 0);

/// XXH32 of the bytes (xxHash fast digest algorithm, specification 0.1.1): lz4-java's blocks.
[[nodiscard]] std::uint32_t xxhash32(std::span<const std::byte> bytes, std::uint32_t seed);

/// Fletcher's checksum over numbers of 16 bits, most significant byte first; a last odd byte is the
/// upper half of one: HDF5's filter 3.
[[nodiscard]] std::uint32_t fletcher32(std::span<const std::byte> bytes);

/// CRC-32 (ISO 3309) of the bytes.  Finds every change of up to 32 bits in a row.
[[nodiscard]] std::uint32_t checksum(std::span<const std::byte> bytes);

}  // namespace mw::io
