// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Chunks of a Zarr array: where they are, and their voxels.
#include "io/volume/zarr/zarr_array.h"

#include <algorithm>

#include "io/codec/checksums.h"
#include "io/codec/stream.h"
#include "io/file/errors.h"

namespace mw::io {

std::uint64_t chunk_bytes(const ZarrArray& array) {
  auto bytes = static_cast<std::uint64_t>(byte_size(array.type));
  for (const std::int64_t extent : array.chunk.shape) bytes *= static_cast<std::uint64_t>(extent);
  return bytes;
}

void check_axes(std::string_view file, std::string_view field, std::size_t axes) {
  if (axes <= kMaxZarrAxes) return;
  fail_input(file, field, text(axes, " axes; at most ", kMaxZarrAxes, " are read"),
             "the file is damaged");
}

void check_grid(std::string_view file, std::string_view field,
                const std::vector<std::int64_t>& extents, std::size_t axes) {
  if (extents.size() != axes) {
    fail_input(file, field,
               text("has ", extents.size(), " extents, and the array has ", axes, " axes"),
               "the file is damaged");
  }
  for (const std::int64_t extent : extents) {
    if (extent > 0) continue;
    fail_input(file, field, text("extent ", extent, " of a chunk is not positive"),
               "the file is damaged");
  }
}

void check_chunk(std::string_view file, std::string_view field,
                 const std::vector<std::int64_t>& chunk, std::size_t axes, VoxelType type) {
  check_grid(file, field, chunk, axes);
  auto bytes = static_cast<std::uint64_t>(byte_size(type));
  for (const std::int64_t extent : chunk) {
    if (static_cast<std::uint64_t>(extent) > kMaxChunkBytes / bytes) {
      fail_input(file, field, text("chunks of ", name(type), " are larger than 2 GiB"),
                 "write the array in smaller chunks");
    }
    bytes *= static_cast<std::uint64_t>(extent);
  }
}

namespace {

/// How many voxels further in memory the next along each axis is.
std::vector<std::int64_t> strides_of(const ChunkCoding& coding) {
  std::vector<std::int64_t> strides(coding.shape.size());
  std::int64_t stride = 1;
  for (auto axis = coding.order.rbegin(); axis != coding.order.rend(); ++axis) {
    strides[*axis] = stride;
    stride *= coding.shape[*axis];
  }
  return strides;
}

}  // namespace

void strip_crc32c(std::vector<std::byte>& bytes, std::string_view name) {
  const PackedName named{"crc32c", name};
  if (bytes.size() < 4) fail_packed(named, "truncated: no whole checksum");
  const auto end = std::span(bytes).last<4>();
  const auto sum = load<std::uint32_t>(end.data(), ByteOrder::kLittle);
  bytes.resize(bytes.size() - 4);
  if (crc32c(bytes) != sum) fail_packed(named, "damaged: the checksum is wrong");
}

Chunk unpack_chunk(const ZarrArray& array, const AxisMap& axes, std::vector<std::byte> packed,
                   std::string_view name) {
  const std::uint64_t size = chunk_bytes(array);
  const std::vector<PackStep>& steps = array.chunk.steps;
  for (std::size_t i = steps.size(); i-- > 0;) {
    if (steps[i].is_crc32c) {
      strip_crc32c(packed, name);
    } else {
      packed = unpack(steps[i].codec, packed, i == 0 ? size : max_packed_bytes(size), name);
    }
  }
  if (packed.size() != size) {
    fail_input(name, {},
               text("has ", packed.size(), " bytes of voxels, and the chunk needs ", size),
               "get a whole copy of the store");
  }
  return {.bytes = std::move(packed), .strides = axes.pick(strides_of(array.chunk), 0)};
}

std::uint64_t max_packed(const ZarrArray& array) {
  return max_packed_bytes(chunk_bytes(array));
}

std::uint64_t unpack_scratch(const ZarrArray& array, const AxisMap& axes) {
  const std::uint64_t size = chunk_bytes(array);
  const std::uint64_t used = static_cast<std::uint64_t>(axes.pick(array.chunk.shape, 1).product()) *
                             static_cast<std::uint64_t>(byte_size(array.type));
  std::uint64_t library = 0;
  for (const PackStep& step : array.chunk.steps) {
    if (!step.is_crc32c) library = std::max(library, max_scratch(step.codec, size));
  }
  // What goes into a step, and what comes out of it when another follows.
  return max_packed(array) * std::clamp<std::uint64_t>(array.chunk.steps.size(), 1, 2) + library +
         (size - used);
}

}  // namespace mw::io
