// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Checks the shapes of chunks of a Zarr array, and unpacks their voxels.
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

/// Returns how many voxels further in memory the next one along each axis is.
std::vector<std::int64_t> strides_of(const ChunkCoding& coding) {
  std::vector<std::int64_t> strides(coding.shape.size());
  std::int64_t stride = 1;
  for (auto axis = coding.order.rbegin(); axis != coding.order.rend(); ++axis) {
    strides[*axis] = stride;
    stride *= coding.shape[*axis];
  }
  return strides;
}

/// Returns the most bytes that undoing a step may give: the voxels, or what a step before packed.
std::uint64_t max_of_step(const ZarrArray& array, std::size_t step) {
  const std::uint64_t size = chunk_bytes(array);
  return step == 0 ? size : max_packed_bytes(size);
}

Chunk checked(const ZarrArray& array, const AxisMap& axes, Chunk chunk, std::string_view name) {
  const std::uint64_t size = chunk_bytes(array);
  if (chunk.size() != size) {
    fail_input(name, {}, text("has ", chunk.size(), " bytes of voxels, and the chunk needs ", size),
               "get a whole copy of the store");
  }
  chunk.strides = axes.pick(strides_of(array.chunk), 0);
  return chunk;
}

/// Does what strip_crc32c() does, for a source.
std::shared_ptr<const ByteSource> without_crc32c(std::shared_ptr<const ByteSource> bytes) {
  constexpr std::uint64_t kPiece = 1 << 20;
  const PackedName named{"crc32c", bytes->name()};
  if (bytes->size() < 4) fail_packed(named, "truncated: no whole checksum");
  const std::uint64_t end = bytes->size() - 4;
  std::uint32_t sum = 0;
  std::vector<std::byte> piece;
  for (std::uint64_t at = 0; at < end; at += piece.size()) {
    piece.resize(std::min(kPiece, end - at));
    bytes->read_at(at, piece);
    sum = crc32c(piece, sum);
  }
  piece.resize(4);
  bytes->read_at(end, piece);
  if (load<std::uint32_t>(piece.data(), ByteOrder::kLittle) != sum) {
    fail_packed(named, "damaged: the checksum is wrong");
  }
  return std::make_shared<BytesPart>(bytes, 0, end, bytes->name());
}

/// Counts the bytes of a chunk that belong to axes that are left out.
std::uint64_t unused_bytes(const ZarrArray& array, const AxisMap& axes) {
  const auto used = static_cast<std::uint64_t>(axes.pick(array.chunk.shape, 1).product());
  return chunk_bytes(array) - used * static_cast<std::uint64_t>(byte_size(array.type));
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
  const std::vector<PackStep>& steps = array.chunk.steps;
  for (std::size_t i = steps.size(); i-- > 0;) {
    if (steps[i].is_crc32c) {
      strip_crc32c(packed, name);
    } else {
      packed = unpack(steps[i].codec, packed, max_of_step(array, i), name);
    }
  }
  return checked(array, axes, {.bytes = std::move(packed), .strides = {}}, name);
}

Chunk unpack_chunk_to_file(const ZarrArray& array, const AxisMap& axes,
                           std::shared_ptr<const ByteSource> packed) {
  const std::vector<PackStep>& steps = array.chunk.steps;
  const std::string name = packed->name();
  for (std::size_t i = steps.size(); i-- > 0;) {
    packed = steps[i].is_crc32c
                 ? without_crc32c(std::move(packed))
                 : unpack_to_file(steps[i].codec, std::move(packed), max_of_step(array, i));
  }
  return checked(array, axes, {.bytes = {}, .file = std::move(packed), .strides = {}}, name);
}

std::optional<std::uint64_t> unpack_streaming(const ZarrArray& array) {
  std::uint64_t most = *max_streamed(Codec::kNone);
  for (const PackStep& step : array.chunk.steps) {
    if (step.is_crc32c) continue;
    const auto bytes = max_streamed(step.codec);
    if (!bytes) return std::nullopt;
    most = std::max(most, *bytes);
  }
  return most;
}

std::uint64_t max_packed(const ZarrArray& array) {
  return max_packed_bytes(chunk_bytes(array));
}

std::uint64_t unpack_scratch(const ZarrArray& array, const AxisMap& axes) {
  const std::uint64_t size = chunk_bytes(array);
  std::uint64_t library = 0;
  for (const PackStep& step : array.chunk.steps) {
    if (!step.is_crc32c) library = std::max(library, max_scratch(step.codec, size));
  }
  // This counts what goes into a step, and what comes out of it when another follows.
  return max_packed(array) * std::clamp<std::uint64_t>(array.chunk.steps.size(), 1, 2) + library +
         unused_bytes(array, axes);
}

std::uint64_t unpack_scratch(const ZarrArray& array, const AxisMap& axes,
                             const ByteSource& packed) {
  const std::vector<PackStep>& steps = array.chunk.steps;
  if (steps.size() > 1) return unpack_scratch(array, axes);  // what is between them is unknown
  const std::uint64_t library = steps.empty() || steps[0].is_crc32c
                                    ? 0
                                    : scratch_of(steps[0].codec, packed, chunk_bytes(array));
  return packed.size() + library + unused_bytes(array, axes);
}

}  // namespace mw::io
