// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bounds of a Zarr array's chunks.
#include "io/volume/zarr/zarr_array.h"

#include "io/chunks/chunk_bytes.h"
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

}  // namespace mw::io
