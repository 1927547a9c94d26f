// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A dense array of voxels in a ByteSource, read by region.
#include "io/volume/raw_array.h"

#include <algorithm>
#include <array>

#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/volume/checks.h"
#include "io/volume/decode.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kChunkBytes = 1 << 20;
/// Reading this much for nothing costs about as much as one more system call.
constexpr std::uint64_t kMaxGapBytes = 4096;

using Axes = std::array<std::int64_t, 3>;

Axes axes_of(Index3 v) {
  return {v.x, v.y, v.z};
}

/// The rows (runs along the fastest axis) of a part, in file order.
class Rows {
 public:
  Rows(const StoredArray& array, const Box3& part, const Box3& box)
      : array_(array),
        part_(part),
        box_(box),
        strides_(axes_of(array.strides)),
        extents_(axes_of(part.shape())),
        size_(static_cast<std::uint64_t>(byte_size(array.coding.type))) {
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return strides_[a] < strides_[b]; });
    // An axis of one voxel makes no rows, whatever its stride.
    const Axes all = axes_of(array.box.shape());
    std::stable_partition(order_.begin(), order_.end(),
                          [&](std::size_t axis) { return all[axis] > 1; });
  }

  [[nodiscard]] std::int64_t count() const { return extents_[order_[1]] * extents_[order_[2]]; }
  [[nodiscard]] std::size_t length() const { return static_cast<std::size_t>(extents_[order_[0]]); }
  /// The way from a voxel of a row to the next, in voxels of the file and of the output.
  [[nodiscard]] std::size_t step() const { return static_cast<std::size_t>(strides_[order_[0]]); }
  [[nodiscard]] std::size_t out_stride() const {
    const Index3 n = box_.shape();
    return static_cast<std::size_t>(Axes{1, n.x, n.x * n.y}[order_[0]]);
  }
  [[nodiscard]] std::uint64_t bytes() const { return ((length() - 1) * step() + 1) * size_; }

  [[nodiscard]] std::uint64_t file_offset(std::int64_t row) const {
    const Axes inside = axes_of(voxel(row, 0) - array_.box.lo);
    auto at = static_cast<std::int64_t>(array_.first);
    for (std::size_t axis = 0; axis < 3; ++axis) at += inside[axis] * strides_[axis];
    return array_.offset + static_cast<std::uint64_t>(at) * size_;
  }
  [[nodiscard]] std::size_t out_offset(std::int64_t row) const {
    return static_cast<std::size_t>(box_.offset(voxel(row, 0)));
  }
  [[nodiscard]] Index3 voxel(std::int64_t row, std::int64_t along) const {
    Axes v = axes_of(part_.lo);
    v[order_[0]] += along;
    v[order_[1]] += row % extents_[order_[1]];
    v[order_[2]] += row / extents_[order_[1]];
    return {v[0], v[1], v[2]};
  }

 private:
  const StoredArray& array_;
  Box3 part_;
  Box3 box_;
  Axes strides_;
  Axes extents_;
  std::uint64_t size_;
  std::array<std::size_t, 3> order_{0, 1, 2};  ///< axes, the fastest of the file first
};

/// Returns one past the last row that is worth reading together with `first`.
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

/// Calls use(row, bytes) for each row.
template <typename Use>
void read_rows(const ByteSource& source, const Rows& rows, Use use) {
  std::vector<std::byte> scratch;
  for (std::int64_t first = 0; first < rows.count();) {
    const std::int64_t last = group_end(rows, first);
    const std::uint64_t start = rows.file_offset(first);
    scratch.resize(rows.file_offset(last - 1) + rows.bytes() - start);
    source.read_at(start, scratch);
    for (std::int64_t row = first; row < last; ++row) {
      use(row, scratch.data() + (rows.file_offset(row) - start));
    }
    first = last;
  }
}

VolumeInfo info_of(const RawLayout& layout, std::string_view file) {
  const auto [x, y, z] = layout.shape;
  return {.shape = checked_shape(file, "shape", {x, y, z}), .type = layout.type, .format = "raw"};
}

}  // namespace

void read_array(const ByteSource& source, const StoredArray& array, const Box3& part,
                const ReadBox& to) {
  if (part.voxels() == 0) return;
  const Rows rows(array, part, to.box);
  const std::size_t length = rows.length(), step = rows.step();
  const auto size = static_cast<std::size_t>(byte_size(array.coding.type));
  read_rows(source, rows, [&](std::int64_t row, const std::byte* bytes) {
    const std::size_t good =
        decode_voxels(bytes, length, step, array.coding, to.labels.data() + rows.out_offset(row),
                      rows.out_stride());
    if (good == length) return;
    fail_voxel(array.name, rows.voxel(row, static_cast<std::int64_t>(good)),
               bytes + good * step * size, array.coding);
  });
}

StoredArray RawArrayVolume::stored() const {
  const Index3 n = info_.shape;
  const Index3 strides = info_.z_fastest ? Index3{n.y * n.z, n.z, 1} : Index3{1, n.x, n.x * n.y};
  return {.first = static_cast<std::uint64_t>(position_.number),
          .strides = {strides.x * position_.numbers, strides.y * position_.numbers,
                      strides.z * position_.numbers},
          .coding = {info_.type, position_.order, position_.scaling},
          .box = {{0, 0, 0}, n},
          .name = source_->name(),
          .offset = position_.offset};
}

void RawArrayVolume::read(const Box3& box, std::span<RawLabel> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  read_array(*source_, stored(), box, {box, out});
}

void RawArrayVolume::read_numbers(const Box3& box, std::span<double> out) const {
  MW_ASSERT(out.size() == static_cast<std::size_t>(box.voxels()));
  StoredArray array = stored();
  array.coding.as_numbers = true;
  std::vector<RawLabel> bits(out.size());
  read_array(*source_, array, box, {box, bits});
  numbers_of_bits(bits, out);
}

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
  info.space = placed(source->name(), {.is_sized = false}, options);
  check_payload(*source, info, 0, BytesBehind::kRefused);
  return std::make_unique<RawArrayVolume>(std::move(source), std::move(info),
                                          ArrayLayout{.offset = 0, .order = layout.order});
}

}  // namespace mw::io
