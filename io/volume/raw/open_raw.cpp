// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a headerless file as a volume.
#include "io/volume/raw/open_raw.h"

#include "io/volume/checks.h"
#include "io/volume/file_space.h"
#include "io/volume/raw_array.h"

namespace mw::io {

std::unique_ptr<LabelVolume> open_raw(std::unique_ptr<ByteSource> source,
                                      const OpenOptions& options) {
  const RawLayout& layout = *options.raw;
  VolumeInfo info{.shape = {}, .type = layout.type, .format = "raw"};
  info.shape =
      checked_shape(source->name(), "shape", {layout.shape.x, layout.shape.y, layout.shape.z});
  info.space = placed(source->name(), {}, options);
  check_payload(*source, info, 0, BytesBehind::kRefused);
  return std::make_unique<RawArrayVolume>(std::move(source), std::move(info),
                                          ArrayLayout{.offset = 0, .order = layout.order});
}

}  // namespace mw::io
