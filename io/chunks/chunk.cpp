// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Chunks in files of their own, and the names of their types.
#include "io/chunks/chunk.h"

#include <algorithm>
#include <array>

#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/text_numbers.h"

namespace mw::io {

std::uint64_t checked_chunk_bytes(std::string_view file, std::string_view field, Index3 chunk,
                                  VoxelType type) {
  auto bytes = static_cast<std::uint64_t>(byte_size(type));
  for (const std::int64_t extent : {chunk.x, chunk.y, chunk.z}) {
    if (extent < 1) {
      fail_input(file, field, text("extent ", extent, " of a chunk is not positive"),
                 "the file is damaged");
    }
    if (static_cast<std::uint64_t>(extent) > kMaxChunkBytes / bytes) {
      fail_input(file, field,
                 text("chunks of ", chunk.x, " x ", chunk.y, " x ", chunk.z, " voxels of ",
                      name(type), " are larger than 2 GiB"),
                 "write the volume in smaller chunks");
    }
    bytes *= static_cast<std::uint64_t>(extent);
  }
  return bytes;
}

std::vector<std::byte> read_rest(const ByteSource& source, std::uint64_t offset,
                                 std::uint64_t max) {
  const std::uint64_t count = source.size() > offset ? source.size() - offset : 0;
  if (count > max) {
    fail_input(
        source.name(), {},
        text("the file has ", source.size(), " bytes, and its voxels need at most ", offset + max),
        "it is damaged or belongs to another store");
  }
  std::vector<std::byte> bytes(count);
  source.read_at(offset, bytes);
  return bytes;
}

std::shared_ptr<const ByteSource> written_to_file(std::span<const std::byte> bytes,
                                                  std::string name) {
  ScratchFile file(scratch_folder());
  file.append(bytes);
  return std::make_shared<FileSource>(file.release(), bytes.size(), std::move(name));
}

std::optional<VoxelType> parse_store_type(std::string_view text) {
  constexpr std::array<std::string_view, 10> kNames{"uint8",   "uint16", "uint32", "uint64",
                                                    "int8",    "int16",  "int32",  "int64",
                                                    "float32", "float64"};
  const auto found = std::find(kNames.begin(), kNames.end(), lower_case(text));
  if (found == kNames.end()) return std::nullopt;
  return static_cast<VoxelType>(found - kNames.begin());
}

VoxelType store_type(const JsonFields& fields, std::string_view key) {
  const std::string type = fields.text(key);
  if (const auto known = parse_store_type(type)) return *known;
  fields.fail(key, text("unsupported type '", type, "'"),
              "supported are uint8 to uint64, int8 to int64, float32 and float64");
}

}  // namespace mw::io
