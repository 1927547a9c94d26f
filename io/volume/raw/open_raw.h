// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens a headerless file as a volume.
#pragma once

#include "io/file/byte_source.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// REQUIRES: options.raw.  Spacing and origin are the options', else 1 and 0.
/// ERRORS: mw::Error(kInput) when the layout does not match the file's size to the byte.
[[nodiscard]] std::unique_ptr<LabelVolume> open_raw(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

}  // namespace mw::io
