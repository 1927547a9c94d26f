// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Free runs by offset and by size; growth by segments: an eighth of what is there, within limits.
#include "engine/store/table/segment_file.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "kernels/core/assert.h"

namespace mw::engine {
namespace {

constexpr std::uint64_t kSector = ExtentAllocator::kSectorBytes;
constexpr std::uint64_t kMinSegmentBytes = 4 << 20;
constexpr std::uint64_t kLargestSegmentBytes = 64 << 20;

std::uint64_t whole_sectors(std::uint64_t size) {
  return (size + kSector - 1) / kSector * kSector;
}

}  // namespace

SegmentFile::SegmentFile(std::unique_ptr<WorkFile> file) : file_(std::move(file)) {
  free_.grow(file_->size() / kSector * kSector);
}

Extent SegmentFile::write(std::span<const std::byte> bytes) {
  std::optional<Extent> extent = free_.allocate(bytes.size());
  if (!extent) {
    grow(bytes.size());
    extent = free_.allocate(bytes.size());
  }
  file_->write(extent->offset, bytes);
  return *extent;
}

std::optional<Extent> SegmentFile::copy_down(const Extent& extent) {
  const std::optional<Extent> gap = free_.allocate_before(extent.offset, extent.size);
  if (!gap) return std::nullopt;
  read(extent, [&](std::span<const std::byte> bytes) { file_->write(gap->offset, bytes); });
  return gap;
}

void SegmentFile::grow(std::uint64_t size) {
  const std::uint64_t segment =
      std::max(std::clamp(free_.end() / 8, kMinSegmentBytes, kLargestSegmentBytes), size);
  const std::uint64_t end = whole_sectors(free_.end() + segment);
  file_->resize(end);
  free_.grow(end);
}

void ExtentAllocator::add(std::uint64_t offset, std::uint64_t size) {
  free_.emplace(offset, size);
  by_size_.emplace(size, offset);
}

void ExtentAllocator::remove(Runs::iterator run) {
  by_size_.erase({run->second, run->first});
  free_.erase(run);
}

void ExtentAllocator::grow(std::uint64_t end) {
  MW_ASSERT(end >= end_ && end % kSectorBytes == 0);
  if (end == end_) return;
  const Extent more{end_, end - end_};
  end_ = end;
  release(more);
}

void ExtentAllocator::trim() {
  if (free_.empty()) return;
  const auto last = std::prev(free_.end());
  if (last->first + last->second != end_) return;
  end_ = last->first;
  remove(last);
}

std::optional<Extent> ExtentAllocator::allocate(std::uint64_t size) {
  const std::uint64_t needed = whole_sectors(size);
  const auto best = by_size_.lower_bound({needed, 0});
  if (best == by_size_.end()) return std::nullopt;
  const Extent extent{best->second, size};
  const bool taken = take(extent);
  MW_ASSERT(taken);
  static_cast<void>(taken);
  return extent;
}

std::optional<Extent> ExtentAllocator::allocate_before(std::uint64_t end, std::uint64_t size) {
  const std::uint64_t needed = whole_sectors(size);
  const auto first = std::find_if(free_.begin(), free_.end(),
                                  [&](const auto& run) { return run.second >= needed; });
  if (first == free_.end() || first->first + needed > end) return std::nullopt;
  const Extent extent{first->first, size};
  const bool taken = take(extent);
  MW_ASSERT(taken);
  static_cast<void>(taken);
  return extent;
}

bool ExtentAllocator::take(const Extent& extent) {
  const std::uint64_t needed = whole_sectors(extent.size);
  auto run = free_.upper_bound(extent.offset);
  if (run == free_.begin()) return false;
  --run;
  const auto [offset, size] = *run;
  const std::uint64_t before = extent.offset - offset;
  if (before > size || needed > size - before) return false;
  remove(run);
  if (before > 0) add(offset, before);
  if (before + needed < size) add(extent.offset + needed, size - before - needed);
  return true;
}

void ExtentAllocator::release(const Extent& extent) {
  std::uint64_t offset = extent.offset, size = whole_sectors(extent.size);
  auto next = free_.lower_bound(offset);
  MW_ASSERT(next == free_.end() || next->first >= offset + size);
  if (next != free_.end() && next->first == offset + size) {
    size += next->second;
    remove(next++);
  }
  if (next != free_.begin()) {
    const auto before = std::prev(next);
    MW_ASSERT(before->first + before->second <= offset);
    if (before->first + before->second == offset) {
      offset = before->first;
      size += before->second;
      remove(before);
    }
  }
  add(offset, size);
}

std::uint64_t ExtentAllocator::free_bytes() const {
  std::uint64_t sum = 0;
  for (const auto& [offset, size] : free_) sum += size;
  return sum;
}

}  // namespace mw::engine
