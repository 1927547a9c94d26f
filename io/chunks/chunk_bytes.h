// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How large chunks may be, and how they are read from files of their own.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "io/file/file_source.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// The most bytes that a chunk may unpack to, whatever a store says.
inline constexpr std::uint64_t kMaxChunkBytes = 2ULL << 30U;

/// Bytes of the voxels of a chunk.
/// ERRORS: mw::Error(kInput) naming file and field when an axis is not positive, or when they are
/// more than kMaxChunkBytes.
[[nodiscard]] std::uint64_t checked_chunk_bytes(std::string_view file, std::string_view field,
                                                Index3 chunk, VoxelType type);

/// What no codec's packed form of that many bytes exceeds: lz4-java's adds the most, a third.
[[nodiscard]] constexpr std::uint64_t max_packed_bytes(std::uint64_t unpacked) {
  constexpr std::uint64_t kHeaders = 64U << 10U;
  return unpacked + unpacked / 2 + kHeaders;
}

/// A file of a store; null when there is none.
/// ERRORS: mw::Error(kInput) when there is something that cannot be read.
[[nodiscard]] std::unique_ptr<FileSource> open_if_there(const std::filesystem::path& path);

/// The bytes from offset on.  ERRORS: mw::Error(kInput) when they are more than `most`.
[[nodiscard]] std::vector<std::byte> read_rest(const ByteSource& source, std::uint64_t offset,
                                               std::uint64_t max);

}  // namespace mw::io
