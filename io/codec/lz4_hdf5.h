// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks LZ4 in the framing of HDF5's registered filter, by liblz4.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace mw::io {

/// The unpacked size in 8 bytes and that of a block in 4, most significant first; then blocks, each
/// behind its packed size in 4 bytes; a block that did not shrink is stored.
/// name: what errors call the bytes.  Memory: at most `most` bytes.  Thread safety: any.
/// ERRORS: mw::Error(kInput) for damage, truncation and more than `most` bytes.
[[nodiscard]] std::vector<std::byte> unpack_lz4_hdf5(std::span<const std::byte> packed,
                                                     std::size_t max, std::string_view name);

}  // namespace mw::io
