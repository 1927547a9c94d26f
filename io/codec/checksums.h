// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The checksums that stores carry, their own and ours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace mw::io {

/// Returns the CRC-32C (Castagnoli; RFC 3720, appendix B.4) of the bytes, which Zarr's shards
/// carry.  before is the checksum of the bytes in front of them.
[[nodiscard]] std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before = 0);

/// Returns the XXH32 of the bytes (xxHash fast digest algorithm, specification 0.1.1), which
/// lz4-java's blocks carry.
[[nodiscard]] std::uint32_t xxhash32(std::span<const std::byte> bytes, std::uint32_t seed);

/// Returns Fletcher's checksum over numbers of 16 bits, most significant byte first, which HDF5's
/// filter 3 adds.  A last odd byte is the upper half of a number.
[[nodiscard]] std::uint32_t fletcher32(std::span<const std::byte> bytes);

/// Returns the CRC-32 (ISO 3309) of the bytes.  It finds every change of up to 32 bits in a row.
[[nodiscard]] std::uint32_t checksum(std::span<const std::byte> bytes);

}  // namespace mw::io
