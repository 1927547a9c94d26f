// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Temporary files of records that lie packed on the disk, where they take a third to a half.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <span>
#include <type_traits>
#include <vector>

#include "io/codec/codec.h"
#include "io/file/scratch/scratch_file.h"

namespace mw::io {

/// Some records of a PackedScratch.
struct PackedChunk {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;  ///< packed
  std::uint64_t records = 0;
};

/// Records that are packed, for PackedScratch::append().
struct PackedBatch {
  std::vector<std::byte> bytes;
  std::uint64_t records = 0;
};

/// Lists of records of one type, which are read as they were appended.
/// Thread safety: one thread appends, or several read and give up; any packs.  ERRORS: see
/// ScratchFile; mw::Error(kInput) where the disk gives back other bytes than were written.
template <typename Record>
class PackedScratch {
  static_assert(std::is_trivially_copyable_v<Record> && sizeof(Record) <= 255);

 public:
  /// REQUIRES: an existing folder.
  explicit PackedScratch(const std::filesystem::path& folder) : file_(folder) {}

  /// REQUIRES: some records, less than 2 GiB.
  [[nodiscard]] static PackedBatch pack(std::span<const Record> records) {
    return {pack_rows(std::as_bytes(records), sizeof(Record)), records.size()};
  }
  [[nodiscard]] PackedChunk append(const PackedBatch& batch) {
    const PackedChunk chunk{file_.size(), batch.bytes.size(), batch.records};
    file_.append(batch.bytes);
    return chunk;
  }

  /// Adds the records of a chunk to a list.
  void read(const PackedChunk& chunk, std::vector<Record>& out) const {
    std::vector<std::byte> packed(chunk.bytes);
    {
      const std::lock_guard lock(mutex_);
      file_.read_at(chunk.offset, packed);
    }
    const std::vector<std::byte> bytes =
        unpack_blosc(packed, chunk.records * sizeof(Record), "a temporary file");
    const std::size_t first = out.size();
    out.resize(first + chunk.records);
    std::memcpy(out.data() + first, bytes.data(), bytes.size());
  }

  /// Gives the chunk's place on the disk back.  REQUIRES: the chunk was read, and is not any more.
  void give_up(const PackedChunk& chunk) const { file_.give_up(chunk.offset, chunk.bytes); }

 private:
  mutable std::mutex mutex_;
  mutable ScratchFile file_;
};

/// One list of records, read in its order.
/// Memory: 4096 records, and 24 bytes for as many.  Thread safety: none.  ERRORS: see ScratchFile.
template <typename Record>
class PackedRecords {
 public:
  /// REQUIRES: an existing folder.
  explicit PackedRecords(const std::filesystem::path& folder) : file_(folder) {}

  void append(const Record& record) {
    waiting_.push_back(record);
    if (waiting_.size() < kBatch) return;
    chunks_.push_back(file_.append(PackedScratch<Record>::pack(waiting_)));
    waiting_.clear();
  }

  /// Calls visit(std::span<const Record>) on all records in their order, some thousands at once.
  template <class Visit>
  void each_batch(Visit visit) const {
    std::vector<Record> batch;
    for (const PackedChunk& chunk : chunks_) {
      batch.clear();
      file_.read(chunk, batch);
      visit(std::span<const Record>(batch));
    }
    if (!waiting_.empty()) visit(std::span<const Record>(waiting_));
  }

 private:
  static constexpr std::size_t kBatch = 4096;

  PackedScratch<Record> file_;
  std::vector<PackedChunk> chunks_;
  std::vector<Record> waiting_;
};

}  // namespace mw::io
