// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Segments of neuroglancer's multi-resolution meshes, in files of their own or in shards.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "io/file/scratch/scratch_file.h"
#include "io/json/json.h"

namespace mw::io {

/// Writes segments, which wait in a temporary file, as their number decides where they go.
/// ERRORS: as AtomicFile.
class DracoSegments {
 public:
  /// The files go to folder.  REQUIRES: folder exists.
  explicit DracoSegments(std::filesystem::path folder)
      : folder_(std::move(folder)), waiting_(folder_) {}

  /// Adds a segment.  REQUIRES: no two segments have the same number.
  void add(std::uint64_t segment, std::string_view fragments, std::string_view manifest);

  /// Writes FOLDER/ID (fragments) and FOLDER/ID.index (the manifest) for each segment, or, where
  /// there are more than most_single of them, shards ("neuroglancer_uint64_sharded_v1").
  /// Returns the member "sharding" of the folder's info; null without shards.
  [[nodiscard]] Json finish(std::size_t most_single);

 private:
  struct Entry {
    std::uint64_t segment = 0;
    std::uint64_t offset = 0;  ///< in the temporary file: fragments, then the manifest
    std::uint64_t fragment_bytes = 0;
    std::uint64_t manifest_bytes = 0;
  };
  class ShardWriter;

  void write_single(const Entry& entry);

  std::filesystem::path folder_;
  ScratchFile waiting_;
  std::vector<Entry> entries_;
};

}  // namespace mw::io
