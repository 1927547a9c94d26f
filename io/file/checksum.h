// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A checksum against accidents: CRC-32 with the polynomial of zlib.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace mw::io {

/// CRC-32 (ISO 3309) of the bytes.  Finds every change of up to 32 bits in a row.
[[nodiscard]] std::uint32_t checksum(std::span<const std::byte> bytes);

}  // namespace mw::io
