// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which bytes of a file are free; and bytes of blocks on disk: one file that grows by segments,
// dealt out in extents.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "engine/store/journal/work_file.h"

namespace mw::engine {

/// A run of bytes in a file, or none where the size is 0.
struct Extent {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;

  friend bool operator==(const Extent&, const Extent&) = default;
};

/// Deals out a file's bytes in multiples of a sector, so that no write touches the sector of
/// another extent.  It takes the best fit, at the lowest offset, and joins free neighbours.
/// Thread safety: none.  Cost of each member: logarithmic in the number of free runs.
class ExtentAllocator {
 public:
  static constexpr std::uint64_t kSectorBytes = 512;

  /// Adds [end(), end) to what can be dealt out.  REQUIRES: whole sectors, end >= end().
  void grow(std::uint64_t end);
  /// Gives up what is free at the end; end() is then that of the last extent.
  void trim();
  [[nodiscard]] std::uint64_t end() const { return end_; }

  /// Returns nothing when no free run is long enough.  REQUIRES: size > 0.
  [[nodiscard]] std::optional<Extent> allocate(std::uint64_t size);
  /// Takes the lowest place that lies before `end` as a whole.  Cost: linear in the number
  /// of free runs.
  [[nodiscard]] std::optional<Extent> allocate_before(std::uint64_t end, std::uint64_t size);
  /// Takes a given extent, for an index that is read back.
  /// ENSURES: false, and nothing taken, when part of it is not free.
  [[nodiscard]] bool take(const Extent& extent);
  /// REQUIRES: allocated or taken, with the same size.
  void release(const Extent& extent);

  [[nodiscard]] std::uint64_t free_bytes() const;

 private:
  using Runs = std::map<std::uint64_t, std::uint64_t>;  ///< offset -> size

  void add(std::uint64_t offset, std::uint64_t size);
  void remove(Runs::iterator run);

  Runs free_;
  std::set<std::pair<std::uint64_t, std::uint64_t>> by_size_;  ///< (size, offset) of free_
  std::uint64_t end_ = 0;
};

/// Nothing is overwritten: an extent is used again only after release().
/// Thread safety: read(), prefetch() and sync() may run beside everything; the others one at a
/// time.  ERRORS: those of WorkFile.
class SegmentFile {
 public:
  /// Everything in the file is free until take() says otherwise.
  explicit SegmentFile(std::unique_ptr<WorkFile> file);

  [[nodiscard]] Extent write(std::span<const std::byte> bytes);
  /// Writes a copy of an extent into a gap before it; returns nothing where no gap is long enough.
  [[nodiscard]] std::optional<Extent> copy_down(const Extent& extent);
  void release(const Extent& extent) { free_.release(extent); }
  /// ENSURES: false when the extent is outside the file or overlaps another.
  [[nodiscard]] bool take(const Extent& extent) { return free_.take(extent); }

  void read(const Extent& extent, const UseBytes& use) const {
    file_->read(extent.offset, extent.size, use);
  }
  void prefetch(const Extent& extent) const { file_->prefetch(extent.offset, extent.size); }
  void sync() { file_->sync(); }
  /// Returns where the file ends; free_bytes() says how much of it are gaps.
  [[nodiscard]] std::uint64_t end() const { return free_.end(); }
  [[nodiscard]] std::uint64_t free_bytes() const { return free_.free_bytes(); }
  /// Makes the file end where its last extent does.
  void trim() {
    free_.trim();
    file_->resize(free_.end());
  }

 private:
  /// REQUIRES: no free run of this size.
  void grow(std::uint64_t size);

  std::unique_ptr<WorkFile> file_;
  ExtentAllocator free_;
};

}  // namespace mw::engine
