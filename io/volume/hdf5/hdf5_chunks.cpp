// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds the chunks of an HDF5 data set in the file, and unpacks them.
#include "io/volume/hdf5/hdf5_chunks.h"

#include <algorithm>
#include <array>

#include "io/file/errors.h"
#include "io/volume/hdf5/catalogue.h"
#include "io/volume/hdf5/filters.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kMaxChunkBytes = UINT32_MAX;

/// Elements from one to the next along axis d of an array in a chunk.
std::int64_t stride_of(const Hdf5Description& description, std::optional<std::size_t> axis) {
  if (!axis) return 0;
  std::uint64_t stride = 1;
  for (std::size_t d = *axis + 1; d < description.chunk_shape.size(); ++d) {
    stride *= description.chunk_shape[d];
  }
  return static_cast<std::int64_t>(stride);
}

/// Bytes of the voxels of a chunk.
std::size_t checked_chunk_bytes(const Hdf5Description& description, std::string_view file) {
  auto bytes = static_cast<std::uint64_t>(byte_size(description.type));
  for (const std::uint64_t extent : description.chunk_shape) {
    if (__builtin_mul_overflow(bytes, extent, &bytes) || bytes > kMaxChunkBytes) {
      fail_input(file, text("data set ", description.path),
                 text("a chunk of ", shape_text(description.chunk_shape), " of ",
                      name(description.type), " is above 4 GiB, the most of HDF5"),
                 "the file is damaged: check it with h5dump, or h5repack it");
    }
  }
  return bytes;
}

}  // namespace

Hdf5Chunks::Hdf5Chunks(std::unique_ptr<ByteSource> source, Hdf5Description description,
                       const Hdf5Axes& axes)
    : source_(std::move(source)),
      description_(std::move(description)),
      axes_(axes),
      strides_{stride_of(description_, axes[0]), stride_of(description_, axes[1]),
               stride_of(description_, axes[2])},
      chunk_bytes_(checked_chunk_bytes(description_, source_->name())) {}

std::string Hdf5Chunks::name_of(Index3 chunk) const {
  return text(source_->name(), ": data set ", description_.path, ": chunk (", chunk.x, ", ",
              chunk.y, ", ", chunk.z, ")");
}

std::optional<Chunk> Hdf5Chunks::load(Index3 chunk, const Box3& /*box*/) const {
  const std::vector<std::uint64_t> index = index_in_grid(chunk);
  const Hdf5Chunk* const stored = find(index);
  if (stored == nullptr) return std::nullopt;
  std::vector<std::byte> bytes(stored->bytes);
  source_->read_at(stored->offset, bytes);
  const bool unfiltered = description_.edges_unfiltered && sticks_out(index);
  const std::string name = name_of(chunk);
  const Unfiltering wanted{.skipped = unfiltered ? ~std::uint32_t{0} : stored->skipped,
                           .bytes = chunk_bytes_,
                           .name = name};
  return Chunk{.bytes = unfilter(description_.filters, std::move(bytes), wanted),
               .first = 0,
               .strides = strides_};
}

std::uint64_t Hdf5Chunks::scratch_bytes() const {
  std::uint64_t stored = 0;
  for (const Hdf5Chunk& chunk : description_.chunks) {
    stored = std::max<std::uint64_t>(stored, chunk.bytes);
  }
  return stored + max_unfilter_scratch(description_.filters, chunk_bytes_);
}

std::vector<std::uint64_t> Hdf5Chunks::index_in_grid(Index3 chunk) const {
  std::vector<std::uint64_t> index(description_.shape.size(), 0);
  const std::array<std::int64_t, 3> numbers{chunk.x, chunk.y, chunk.z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (axes_[i]) index[*axes_[i]] = static_cast<std::uint64_t>(numbers[i]);
  }
  return index;
}

const Hdf5Chunk* Hdf5Chunks::find(const std::vector<std::uint64_t>& index) const {
  std::uint64_t number = 0;
  for (std::size_t d = 0; d < index.size(); ++d) {
    const std::uint64_t extent = description_.chunk_shape[d];
    number = number * ((description_.shape[d] + extent - 1) / extent) + index[d];
  }
  const auto found = std::lower_bound(
      description_.chunks.begin(), description_.chunks.end(), number,
      [](const Hdf5Chunk& chunk, std::uint64_t wanted) { return chunk.number < wanted; });
  return found != description_.chunks.end() && found->number == number ? &*found : nullptr;
}

bool Hdf5Chunks::sticks_out(const std::vector<std::uint64_t>& index) const {
  for (std::size_t d = 0; d < index.size(); ++d) {
    if ((index[d] + 1) * description_.chunk_shape[d] > description_.shape[d]) return true;
  }
  return false;
}

Index3 chunk_extents(const Hdf5Description& description, const Hdf5Axes& axes) {
  const auto extent = [&](std::optional<std::size_t> axis) {
    return axis ? static_cast<std::int64_t>(description.chunk_shape[*axis]) : 1;
  };
  return {extent(axes[0]), extent(axes[1]), extent(axes[2])};
}

}  // namespace mw::io
