// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The checksum of HDF5's filter 3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace mw::io {

/// Fletcher's checksum over numbers of 16 bits, most significant byte first; a last odd byte is the
/// upper half of one.
[[nodiscard]] std::uint32_t fletcher32(std::span<const std::byte> bytes);

}  // namespace mw::io
