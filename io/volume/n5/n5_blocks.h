// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The blocks of an N5 array, a file each.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/chunks/chunk.h"
#include "io/volume/n5/n5_array.h"

namespace mw::io {

/// A block file: mode (u16), number of axes (u16), extents (u32 each), in mode 1 the number of
/// values (u32); then the values, packed; the most significant byte of each number first.
class N5Blocks : public ChunkSource {
 public:
  /// folder: the array's.
  N5Blocks(std::filesystem::path folder, N5Array array)
      : folder_(std::move(folder)), array_(std::move(array)) {}

  [[nodiscard]] std::string name() const override { return folder_.string(); }
  [[nodiscard]] std::string name_of(Index3 chunk) const override { return path_of(chunk).string(); }
  [[nodiscard]] std::optional<Chunk> load(Index3 chunk, const Box3& box) const override;
  [[nodiscard]] std::uint64_t scratch_bytes() const override;

 private:
  [[nodiscard]] std::filesystem::path path_of(Index3 chunk) const;

  std::filesystem::path folder_;
  N5Array array_;
};

}  // namespace mw::io
