// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The checksum of lz4-java's blocks: xxHash of 32 bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace mw::io {

/// XXH32 of the bytes (xxHash fast digest algorithm, specification 0.1.1).
[[nodiscard]] std::uint32_t xxhash32(std::span<const std::byte> bytes, std::uint32_t seed);

}  // namespace mw::io
