// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a file for reading by region, whether it is gzipped or not.
#pragma once

#include <filesystem>
#include <memory>

#include "io/file/byte_source.h"

namespace mw::io {

/// Opens path; a gzip file (by content) is inflated as far as it is read, see InflatedSource.
/// ERRORS: mw::Error(kInput) when missing, a folder, empty, or not a sound gzip file.
[[nodiscard]] std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& path);

/// Whether the bytes at offset begin a gzip member.
[[nodiscard]] bool is_gzip(const ByteSource& source, std::uint64_t offset = 0);

}  // namespace mw::io
