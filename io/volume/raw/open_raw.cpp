// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a headerless file as a volume.
#include "io/volume/raw/open_raw.h"

#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/volume/checks.h"
#include "io/volume/file_space.h"
#include "io/volume/raw_array.h"

namespace mw::io {
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
