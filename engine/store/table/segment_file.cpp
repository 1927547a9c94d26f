// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Growth by segments: an eighth of what is there, within limits.
#include "engine/store/table/segment_file.h"

#include <algorithm>
#include <utility>

namespace mw::engine {
namespace {

constexpr std::uint64_t kSector = ExtentAllocator::kSectorBytes;
constexpr std::uint64_t kMinSegmentBytes = 4 << 20;
constexpr std::uint64_t kLargestSegmentBytes = 64 << 20;

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
  const std::uint64_t end = (free_.end() + segment + kSector - 1) / kSector * kSector;
  file_->resize(end);
  free_.grow(end);
}

}  // namespace mw::engine
