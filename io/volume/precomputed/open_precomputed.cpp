// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds the chunks that `info` speaks of.
#include "io/volume/precomputed/open_precomputed.h"

#include "io/chunks/chunked_volume.h"
#include "io/file/errors.h"
#include "io/json/json.h"
#include "io/volume/precomputed/precomputed_chunks.h"
#include "io/volume/precomputed/precomputed_info.h"

namespace mw::io {
namespace {

/// Keys may lead to folders beside that of `info` ("../8_8_8"), by the format's rules, but no
/// further.
bool stays_in_store(const std::filesystem::path& key) {
  if (key.is_absolute() || key.native().find('\0') != std::string::npos) return false;
  int depth = 0;
  for (const std::filesystem::path& part : key) {
    if (part == "..") --depth;
    if (part != ".." && part != "." && !part.empty()) ++depth;
    if (depth < -1) return false;
  }
  return true;
}

std::filesystem::path folder_of(const std::filesystem::path& root, const PrecomputedScale& scale) {
  const std::string info = (root / "info").string();
  if (!stays_in_store(scale.key)) {
    fail_input(info, scale.key_field, "the key leads out of the store",
               "the file is damaged or not sound");
  }
  std::filesystem::path folder = root / scale.key;
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    fail_input(info, scale.key_field,
               text("the folder of the chunks, ", folder.string(), ", is missing"),
               "get a whole copy of the store, or choose a scale that is there with --scale");
  }
  return folder;
}

}  // namespace

bool is_precomputed(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(folder / "info", ignored);
}

std::unique_ptr<LabelVolume> open_precomputed(const std::filesystem::path& folder,
                                              const OpenOptions& options) {
  const std::filesystem::path path = folder / "info";
  PrecomputedScale scale = parse_precomputed_info(read_json(path), path.string(), options);
  VolumeInfo info{.shape = scale.shape,
                  .space = scale.space,
                  .type = scale.type,
                  .format = "precomputed",
                  .chunk = scale.chunk};
  const VoxelCoding coding{.type = scale.type, .order = ByteOrder::kLittle};
  auto chunks = std::make_unique<PrecomputedChunks>(folder_of(folder, scale), std::move(scale));
  return std::make_unique<ChunkedVolume>(std::move(info), coding, 0, std::move(chunks),
                                         options.cache_bytes);
}

}  // namespace mw::io
