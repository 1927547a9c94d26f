// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Volumes of one shape and place that lie one behind the other in a file, as NIfTI and FreeSurfer
// have them.
#pragma once

#include <cstdint>
#include <memory>

#include "io/file/source/byte_source.h"
#include "io/volume/label_volume.h"
#include "io/volume/open_options.h"
#include "io/volume/raw_array.h"

namespace mw::io {

/// Opens `count` volumes, of which `first` says where the first lies.  Several are masks
/// (io/volume/masks/open_masks.h), or numbers where options.values asks for them.  Bytes behind
/// them are ignored.
/// REQUIRES: count is positive.
/// ERRORS: mw::Error(kInput) naming the file that has fewer bytes; those of MaskMerger; kUsage for
/// a rule of overlaps where there is one volume.
[[nodiscard]] std::unique_ptr<LabelVolume> open_series(std::unique_ptr<ByteSource> source,
                                                       VolumeInfo info, const ArrayLayout& first,
                                                       std::int64_t count,
                                                       const OpenOptions& options);

}  // namespace mw::io
