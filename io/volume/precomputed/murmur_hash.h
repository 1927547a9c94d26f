// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The hash by which shards of precomputed volumes are chosen.
#pragma once

#include <cstdint>

namespace mw::io {

/// MurmurHash3_x86_128 (A. Appleby, public domain) of the 8 bytes of key, least significant first,
/// with seed 0: the low 64 of its 128 bits.
[[nodiscard]] std::uint64_t murmur_hash(std::uint64_t key);

}  // namespace mw::io
