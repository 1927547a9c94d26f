// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The chunks of a scale of a precomputed volume, from files or shards.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/chunks/chunk.h"
#include "io/volume/precomputed/precomputed_info.h"
#include "io/volume/precomputed/shard_folder.h"

namespace mw::io {

class PrecomputedChunks : public ChunkSource {
 public:
  /// folder: the one of the scale's chunks.
  PrecomputedChunks(std::filesystem::path folder, PrecomputedScale scale);

  [[nodiscard]] std::string name() const override { return folder_.string(); }
  [[nodiscard]] std::string name_of(Index3 chunk) const override;
  [[nodiscard]] std::optional<Chunk> load(Index3 chunk, const Box3& box) const override;
  [[nodiscard]] std::uint64_t scratch_bytes() const override;

 private:
  using Bytes = std::vector<std::byte>;

  [[nodiscard]] std::filesystem::path path_of(Index3 chunk) const;
  [[nodiscard]] SegmentationLayout layout_of(Index3 shape) const;
  [[nodiscard]] std::uint64_t max_encoded(Index3 shape) const;
  [[nodiscard]] std::optional<Bytes> read_file(Index3 chunk, Index3 shape) const;
  [[nodiscard]] std::optional<Bytes> read_shard(Index3 chunk, Index3 shape) const;
  [[nodiscard]] Bytes inflated(Bytes packed, Index3 chunk, Index3 shape) const;

  std::filesystem::path folder_;
  PrecomputedScale scale_;
  Index3 grid_;
  std::optional<ShardFolder> shards_;
};

}  // namespace mw::io
