// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A dense array of voxels in a ByteSource, read by region.
#include "io/volume/raw_array.h"

#include <algorithm>

#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/volume/checks.h"
#include "io/volume/decode.h"
#include "io/volume/file_space.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kChunkBytes = 1 << 20;
/// Reading this much for nothing costs about as much as one more system call.
constexpr std::uint64_t kMaxGapBytes = 4096;

/// The rows (runs along the fastest axis) of a box, in file order.
class Rows {
 public:
  Rows(const VolumeInfo& info, const ArrayLayout& position, const Box3& box)
      : info_(info),
        offset_(position.offset),
        size_(static_cast<std::uint64_t>(byte_size(info.type))),
        box_(box) {
    const Index3 shape = box.shape();
    length_ = static_cast<std::size_t>(info.z_fastest ? shape.z : shape.x);
    count_ = info.z_fastest ? shape.x * shape.y : shape.y * shape.z;
    stride_ = info.z_fastest ? static_cast<std::size_t>(shape.x * shape.y) : 1;
  }

  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] std::size_t length() const { return length_; }
  [[nodiscard]] std::uint64_t bytes() const { return length_ * size_; }
  /// Distance in the output between voxels that are neighbours in a row.
  [[nodiscard]] std::size_t out_stride() const { return stride_; }

  [[nodiscard]] std::uint64_t file_offset(std::int64_t row) const {
    const Index3 v = first_voxel(row);
    const Index3 n = info_.shape;
    const std::int64_t index =
        info_.z_fastest ? (v.x * n.y + v.y) * n.z + v.z : (v.z * n.y + v.y) * n.x + v.x;
    return offset_ + static_cast<std::uint64_t>(index) * size_;
  }
  [[nodiscard]] std::size_t out_offset(std::int64_t row) const {
    return static_cast<std::size_t>(box_.offset(first_voxel(row)));
  }
  [[nodiscard]] Index3 voxel(std::int64_t row, std::int64_t along) const {
    return first_voxel(row) + (info_.z_fastest ? Index3{0, 0, along} : Index3{along, 0, 0});
  }

 private:
  [[nodiscard]] Index3 first_voxel(std::int64_t row) const {
    const std::int64_t middle = row % box_.shape().y;
    const std::int64_t slow = row / box_.shape().y;
    return info_.z_fastest ? box_.lo + Index3{slow, middle, 0} : box_.lo + Index3{0, middle, slow};
  }

  const VolumeInfo& info_;
  std::uint64_t offset_;
  std::uint64_t size_;
  Box3 box_;
  std::size_t length_;
  std::int64_t count_;
  std::size_t stride_;
};

/// One past the last row that is worth reading together with `first`.
std::int64_t group_end(const Rows& rows, std::int64_t first) {
  const std::uint64_t start = rows.file_offset(first);
  std::uint64_t end = start + rows.bytes();
  std::int64_t row = first + 1;
  for (; row < rows.count(); ++row) {
    const std::uint64_t next = rows.file_offset(row);
    if (next - end > kMaxGapBytes || next + rows.bytes() - start > kChunkBytes) break;
    end = next + rows.bytes();
  }
  return row;
}

}  // namespace

void RawArrayVolume::read(const Box3& box, std::span<RawLabel> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  const Rows rows(info_, position_, box);
  const VoxelCoding coding{info_.type, position_.order, position_.scaling};
  std::vector<std::byte> scratch;
  for (std::int64_t first = 0; first < rows.count();) {
    const std::int64_t last = group_end(rows, first);
    const std::uint64_t start = rows.file_offset(first);
    scratch.resize(rows.file_offset(last - 1) + rows.bytes() - start);
    source_->read_at(start, scratch);
    for (std::int64_t row = first; row < last; ++row) {
      const std::byte* bytes = scratch.data() + (rows.file_offset(row) - start);
      const std::size_t good = decode_voxels(bytes, rows.length(), 1, coding,
                                             out.data() + rows.out_offset(row), rows.out_stride());
      if (good == rows.length()) continue;
      fail_voxel(source_->name(), rows.voxel(row, static_cast<std::int64_t>(good)),
                 bytes + good * static_cast<std::size_t>(byte_size(info_.type)), coding);
    }
    first = last;
  }
}

namespace {

VolumeInfo info_of(const RawLayout& layout, std::string_view file) {
  const auto [x, y, z] = layout.shape;
  return {.shape = checked_shape(file, "shape", {x, y, z}), .type = layout.type, .format = "raw"};
}

}  // namespace

std::unique_ptr<ByteSource> open_raw_bytes(const std::filesystem::path& path,
                                           const RawLayout& layout) {
  auto plain = std::make_unique<FileSource>(path);
  if (plain->size() == payload_bytes(info_of(layout, plain->name()))) return plain;
  return open_bytes(path);
}

std::unique_ptr<LabelVolume> open_raw(std::unique_ptr<ByteSource> source,
                                      const OpenOptions& options) {
  const RawLayout& layout = *options.raw;
  VolumeInfo info = info_of(layout, source->name());
  info.space = placed(source->name(), {}, options);
  check_payload(*source, info, 0, BytesBehind::kRefused);
  return std::make_unique<RawArrayVolume>(std::move(source), std::move(info),
                                          ArrayLayout{.offset = 0, .order = layout.order});
}

}  // namespace mw::io
