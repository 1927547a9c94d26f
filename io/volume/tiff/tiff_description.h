// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the ImageDescription of a TIFF stack says of its slices: as OME-XML, or as ImageJ's lines.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/volume/volume_space.h"

namespace mw::io {

struct TiffDescription {
  /// Edges of a voxel in `unit`; not a number where only others are known.
  Vector3 spacing{1, 1, 1};
  std::string unit;                    ///< "um", "nm" and so on; empty: unknown
  std::optional<std::int64_t> slices;  ///< how many there are
  bool is_imagej = false;
};

/// resolution: XResolution and YResolution, pixels a unit; ImageJ keeps x and y there.  That of
/// other files counts dots on paper, and is not used.
/// ERRORS: mw::Error(kInput) naming file and field for several channels, times or images, and for
/// OME-XML whose slices are in other files or another order.
[[nodiscard]] TiffDescription parse_tiff_description(std::string_view description,
                                                     std::array<double, 2> resolution,
                                                     const std::string& file);

}  // namespace mw::io
