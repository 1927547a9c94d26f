// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a Neuroglancer precomputed volume.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/chunks/chunk.h"
#include "io/volume/open_options.h"
#include "io/volume/precomputed/precomputed_info.h"
#include "io/volume/precomputed/sharding.h"

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

/// Whether the folder has an `info` file.
[[nodiscard]] bool is_precomputed(const std::filesystem::path& folder);

/// Chunks raw or in compressed_segmentation, in files of their own or in shards, each also gzipped;
/// what is not there has label 0.  Coordinates are in nm.  options.scale or options.dataset (a key)
/// chooses among the scales.
/// ERRORS: mw::Error(kInput) naming file and field; kUsage when there is no such scale.
[[nodiscard]] std::unique_ptr<LabelVolume> open_precomputed(const std::filesystem::path& folder,
                                                            const OpenOptions& options);

}  // namespace mw::io
