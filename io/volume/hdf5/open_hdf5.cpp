// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Makes a volume of a described HDF5 data set.
#include "io/volume/hdf5/open_hdf5.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>

#include "io/chunks/chunked_volume.h"
#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/file_space.h"
#include "io/volume/hdf5/description.h"
#include "io/volume/hdf5/hdf5_chunks.h"
#include "io/volume/raw_array.h"

namespace mw::io {
namespace {

constexpr std::string_view kMagic{"\x89HDF\r\n\x1a\n", 8};
constexpr std::size_t kFirstUserBlock = 512;

/// The voxels of a compact data set, which are no run of bytes in the file.
class HeldBytes : public ByteSource {
 public:
  HeldBytes(std::string bytes, std::string name)
      : bytes_(std::move(bytes)), name_(std::move(name)) {}

  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
  [[nodiscard]] const std::string& name() const override { return name_; }
  void read_at(std::uint64_t offset, std::span<std::byte> out) const override {
    if (offset > bytes_.size() || out.size() > bytes_.size() - offset) {
      fail_input(name_, "voxel data", "truncated");
    }
    std::ranges::copy(std::as_bytes(std::span(bytes_)).subspan(offset, out.size()), out.begin());
  }

 private:
  std::string bytes_;
  std::string name_;
};

Index3 shape_of(const Hdf5Description& description, const Hdf5Axes& axes, std::string_view file) {
  std::array<std::int64_t, 3> extents{1, 1, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!axes[i]) continue;
    // What 63 bits cannot hold is too long in any case.
    extents[i] =
        static_cast<std::int64_t>(std::min<std::uint64_t>(description.shape[*axes[i]], INT64_MAX));
  }
  return checked_shape(file, text("data set ", description.path, " shape"), extents);
}

/// Whether z is the axis that goes fastest in the file.
/// ERRORS: kInput for orders of axes other than z, y, x and x, y, z.
bool is_z_fastest(const Hdf5Description& description, const Hdf5Axes& axes, std::string_view file) {
  // An axis that the array does not have can stand anywhere.
  const auto in_order = [&](const std::array<std::size_t, 3>& order) {
    std::size_t next = 0;
    for (const std::size_t i : order) {
      if (!axes[i] || description.shape[*axes[i]] == 1) continue;
      if (*axes[i] < next) return false;
      next = *axes[i];
    }
    return true;
  };
  if (in_order({2, 1, 0})) return false;
  if (in_order({0, 1, 2})) return true;
  fail_input(file, text("data set ", description.path),
             "its axes are neither in the order z, y, x nor x, y, z",
             "write it in one of them, or in chunks");
}

std::unique_ptr<LabelVolume> open_run(std::unique_ptr<ByteSource> source, VolumeInfo info,
                                      Hdf5Description& description) {
  std::uint64_t offset = description.offset;
  if (description.layout == Hdf5Layout::kCompact) {
    source = std::make_unique<HeldBytes>(std::move(description.bytes), source->name());
    offset = 0;
  }
  check_payload(*source, info, offset);
  return std::make_unique<RawArrayVolume>(
      std::move(source), std::move(info),
      ArrayLayout{.offset = offset, .order = description.order});
}

/// Returns what voxels are whose chunk was never written.
ChunkFill fill_of(const Hdf5Description& description) {
  VoxelCoding coding{description.type, description.order};
  const auto* const bytes = reinterpret_cast<const std::byte*>(description.fill.data());
  ChunkFill out;
  RawLabel label = 0;
  const bool is_label = decode_voxels(bytes, 1, 1, coding, &label, 1) == 1;
  out.label = is_label ? std::optional(label) : std::nullopt;
  coding.as_numbers = true;
  static_cast<void>(decode_voxels(bytes, 1, 1, coding, &label, 1));
  out.number = std::bit_cast<double>(label);
  return out;
}

std::unique_ptr<LabelVolume> open_chunks(std::unique_ptr<ByteSource> source, VolumeInfo info,
                                         Hdf5Description description, const Hdf5Axes& axes,
                                         std::uint64_t cache_bytes) {
  check_filters(description, source->name());
  info.chunk = chunk_extents(description, axes);
  const ChunkFill fill = fill_of(description);
  const VoxelCoding coding{description.type, description.order};
  auto chunks = std::make_unique<Hdf5Chunks>(std::move(source), std::move(description), axes);
  return std::make_unique<ChunkedVolume>(std::move(info), coding, fill, std::move(chunks),
                                         cache_bytes);
}

}  // namespace

bool has_hdf5_magic(std::span<const std::byte> head) {
  for (std::size_t at = 0; at + kMagic.size() <= head.size();
       at = at == 0 ? kFirstUserBlock : 2 * at) {
    if (std::memcmp(head.data() + at, kMagic.data(), kMagic.size()) == 0) return true;
  }
  return false;
}

std::unique_ptr<LabelVolume> open_hdf5(std::unique_ptr<ByteSource> source,
                                       const OpenOptions& options) {
  Hdf5Description description = describe_hdf5(*source, options.dataset);
  const std::string file = source->name();
  const Hdf5Axes axes = find_axes(description, file);
  VolumeInfo info{
      .shape = shape_of(description, axes, file), .type = description.type, .format = "hdf5"};
  info.space = placed(file, hdf5_space(description, info.shape, file), options);
  if (description.layout == Hdf5Layout::kChunked) {
    return open_chunks(std::move(source), std::move(info), std::move(description), axes,
                       options.cache_bytes);
  }
  info.z_fastest = is_z_fastest(description, axes, file);
  return open_run(std::move(source), std::move(info), description);
}

}  // namespace mw::io
