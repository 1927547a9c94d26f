// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bytes of blocks on disk: one file that grows by segments, dealt out in extents.
#pragma once

#include <memory>
#include <optional>

#include "engine/store/journal/work_file.h"
#include "engine/store/table/extent_allocator.h"

namespace mw::engine {

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
