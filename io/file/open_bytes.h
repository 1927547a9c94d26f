// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a file for reading by region, whether it is gzipped or not.
#pragma once

#include <filesystem>
#include <memory>

#include "io/file/byte_source.h"

namespace mw::io {

/// Opens path; a gzip file (by content) is inflated first, see inflate_bytes.
/// ERRORS: mw::Error(kInput) when missing, a folder, empty, or not a sound gzip file.
[[nodiscard]] std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& path);

/// Inflates the gzip data that begin at offset of packed, once, into an unlinked temporary file in
/// $TMPDIR or /tmp, so that memory stays bounded and the result can be read by region.
/// ERRORS: mw::Error(kInput) when corrupt or truncated; kResource when the disk is full.
[[nodiscard]] std::unique_ptr<ByteSource> inflate_bytes(const ByteSource& packed,
                                                        std::uint64_t offset);

/// Whether the bytes at offset begin a gzip member.
[[nodiscard]] bool is_gzip(const ByteSource& source, std::uint64_t offset = 0);

}  // namespace mw::io
