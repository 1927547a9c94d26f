// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A volume in chunks that is read by region; every chunked store opens as one.  It keeps unpacked
// chunks for a while, within a bound; those that are large against it go to files without names.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <semaphore>
#include <unordered_map>

#include "io/chunks/chunk.h"
#include "io/volume/label_volume.h"
#include "io/volume/number_volume.h"
#include "io/volume/raw_array.h"

namespace mw::io {

/// Keeps the chunks that were used last.  Threads that ask for a chunk at once unpack it once.
/// Thread safety: all members may be called from many threads.
class ChunkCache {
 public:
  /// A chunk, or null where the store has no such chunk.
  using Loaded = std::shared_ptr<const Chunk>;

  /// max_bytes bounds the chunks that are kept, be they in memory or in files.
  explicit ChunkCache(std::uint64_t max_bytes) : max_bytes_(max_bytes) {}

  /// Returns the chunk of that number, which load() unpacks unless the cache still has it.
  /// Memory: what is kept stays within the bound; each thread may use one chunk beyond that.
  /// ERRORS: what load throws; the next caller loads again.
  [[nodiscard]] Loaded get(std::uint64_t number, const std::function<std::optional<Chunk>()>& load);
  /// Forgets everything.
  void clear();

 private:
  struct Slot {
    std::mutex loading;
    bool loaded = false;
    Loaded chunk;
  };
  struct Entry {
    std::shared_ptr<Slot> slot;
    std::list<std::uint64_t>::iterator age;
    std::uint64_t bytes = 0;
  };

  [[nodiscard]] std::shared_ptr<Slot> touch(std::uint64_t number);
  void account(std::uint64_t number, const std::shared_ptr<Slot>& slot);
  void forget(std::uint64_t number, const std::shared_ptr<Slot>& slot);

  std::uint64_t max_bytes_;
  std::mutex mutex_;
  std::list<std::uint64_t> ages_;  ///< numbers, the one used last in front
  std::unordered_map<std::uint64_t, Entry> entries_;
  std::uint64_t bytes_ = 0;
};

class ChunkedVolume : public LabelVolume, public NumberVolume {
 public:
  /// REQUIRES: info.chunk positive on every axis; chunk c holds the voxels from c * info.chunk on.
  /// To read labels of a chunk that the store does not have is an error where fill is no label.
  /// cache_bytes bounds the unpacked chunks that are kept between reads.  Chunks above an eighth of
  /// it (and 1 MiB) are unpacked once to files without names in $TMPDIR or /tmp, as far as there is
  /// room, and read from there by region.
  ChunkedVolume(VolumeInfo info, VoxelCoding coding, const ChunkFill& fill,
                std::unique_ptr<ChunkSource> source, std::uint64_t cache_bytes);

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override {
    read_as(coding_, fill_.label, {box, out});
  }
  void read_numbers(const Box3& box, std::span<double> out) const override;
  [[nodiscard]] std::uint64_t buffer_bytes(int threads) const override;
  void drop_buffers() const override;

 private:
  [[nodiscard]] Box3 box_of(Index3 chunk) const;
  [[nodiscard]] std::uint64_t chunk_bytes() const;
  [[nodiscard]] std::uint64_t unpacking_bytes() const;
  [[nodiscard]] std::uint64_t unpacked_at_once() const;
  [[nodiscard]] std::optional<Chunk> unpacked(Index3 chunk, const Box3& box) const;
  [[nodiscard]] ChunkCache::Loaded load(Index3 chunk) const;
  void read_as(const VoxelCoding& coding, std::optional<RawLabel> fill, const ReadBox& to) const;
  void copy(const Chunk& chunk, const StoredArray& array, const Box3& part,
            const ReadBox& to) const;

  VolumeInfo info_;
  VoxelCoding coding_;
  ChunkFill fill_;
  std::unique_ptr<ChunkSource> source_;
  std::uint64_t cache_bytes_;
  ChunkPlace place_;
  mutable ChunkCache cache_;
  mutable std::counting_semaphore<> unpacking_;  ///< how many threads may unpack at once
};

}  // namespace mw::io
