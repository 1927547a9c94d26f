// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a .npy file as a volume.
#include "io/volume/npy/open_npy.h"

#include <vector>

#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "io/volume/number_volume.h"
#include "io/volume/raw_array.h"

namespace mw::io {
namespace {

/// Opens components as numbers.  REQUIRES: the source holds all of them.
std::unique_ptr<LabelVolume> open_components(const std::shared_ptr<const ByteSource>& source,
                                             const VolumeInfo& info, std::uint64_t offset,
                                             const NpyHeader& header) {
  std::vector<std::shared_ptr<const LabelVolume>> parts;
  for (std::int64_t i = 0; i < header.components; ++i) {
    ArrayLayout layout{.offset = offset, .order = header.order};
    if (header.fortran_order) {
      layout.numbers = header.components;
      layout.number = i;
    } else {
      layout.offset += static_cast<std::uint64_t>(i) * payload_bytes(info);
    }
    parts.push_back(std::make_shared<RawArrayVolume>(source, info, layout));
  }
  return std::make_unique<NumberStack>(std::move(parts));
}

}  // namespace

std::unique_ptr<LabelVolume> open_npy(std::unique_ptr<ByteSource> source,
                                      const OpenOptions& options) {
  const NpyPrefix prefix = parse_npy_prefix(read_prefix(*source, 12), source->name());
  const std::size_t offset = prefix.dict_offset + prefix.dict_length;
  const std::uint64_t held = source->size_within(offset);
  if (held < offset) {
    fail_input(source->name(), "npy header",
               text("truncated: it needs ", offset, " bytes, the file holds ", held),
               "get a whole copy of the file");
  }
  std::string dict(prefix.dict_length, '\0');
  source->read_at(prefix.dict_offset, std::as_writable_bytes(std::span(dict)));
  const NpyHeader header = parse_npy_dict(dict, options.values, source->name());
  VolumeInfo info{.shape = header.shape, .type = header.type, .format = "npy", .is_placed = false};
  info.z_fastest = header.fortran_order;
  info.space = placed(source->name(), {.is_sized = false}, options);
  if (header.components > 1 && options.values == VoxelValues::kLabels) {
    fail_axes(4, source->name());
  }
  check_payload(*source, info, offset, BytesBehind::kIgnored,
                static_cast<std::uint64_t>(header.components));
  if (header.components > 1) return open_components(std::move(source), info, offset, header);
  return std::make_unique<RawArrayVolume>(std::move(source), std::move(info),
                                          ArrayLayout{.offset = offset, .order = header.order});
}

}  // namespace mw::io
