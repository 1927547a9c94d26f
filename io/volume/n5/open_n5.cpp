// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Brings an array of N5 together with its place and its blocks.
#include "io/volume/n5/open_n5.h"

#include "io/chunks/chunked_volume.h"
#include "io/file/errors.h"
#include "io/volume/n5/n5_blocks.h"
#include "io/volume/n5/n5_container.h"
#include "io/volume/n5/n5_space.h"

namespace mw::io {
namespace {

/// A level of a pyramid needs what is written of the finest one and of all.
VolumeSpace space_of(const std::filesystem::path& folder, const N5Document& own,
                     const N5Array& array, const OpenOptions& options) {
  const auto level = level_of(folder);
  if (!level) return n5_space({.own = own}, array, options);
  const std::filesystem::path group_folder = folder / "..";
  const auto group = read_attributes(group_folder);
  const auto finest = *level == 0 ? std::nullopt : read_attributes(group_folder / "s0");
  return n5_space({.own = own,
                   .group = group ? &*group : nullptr,
                   .finest = finest ? &*finest : nullptr,
                   .level = *level},
                  array, options);
}

}  // namespace

bool is_n5(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(folder / "attributes.json", ignored) ||
         std::filesystem::exists(folder / "s0" / "attributes.json", ignored) ||
         folder.extension() == ".n5";
}

std::unique_ptr<LabelVolume> open_n5(const std::filesystem::path& container,
                                     const OpenOptions& options) {
  std::filesystem::path folder = find_n5_array(container, options);
  // A path with a slash at its end has no name.
  if (!folder.has_filename()) folder = folder.parent_path();
  const auto document = read_attributes(folder);
  if (!document) fail_input(folder.string(), "N5", "attributes.json is missing");
  N5Array array = parse_n5_array(document->fields());
  VolumeInfo info{.shape = shape_of(array),
                  .space = space_of(folder, *document, array, options),
                  .type = array.type,
                  .format = "n5",
                  .chunk = block_of(array)};
  const VoxelCoding coding{.type = array.type, .order = ByteOrder::kBig};
  return std::make_unique<ChunkedVolume>(
      std::move(info), coding, 0, std::make_unique<N5Blocks>(std::move(folder), std::move(array)),
      options.cache_bytes);
}

}  // namespace mw::io
