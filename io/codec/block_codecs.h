// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bare blocks of LZ4, by liblz4.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "io/codec/stream.h"

namespace mw::io {

/// Appends the `size` bytes of one bare block to out.  Nothing is allocated before the claim is
/// possible.  ERRORS: mw::Error(kInput) for damage and another size.
void append_lz4_block(std::vector<std::byte>& out, std::span<const std::byte> block,
                      std::size_t size, const PackedName& name);

}  // namespace mw::io
