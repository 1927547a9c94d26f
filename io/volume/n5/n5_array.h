// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The array that an attributes.json of N5 describes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "io/codec/codec.h"
#include "io/json/json_fields.h"
#include "io/volume/label_volume.h"

namespace mw::io {

/// Axes go from the fastest to the slowest, as N5 has them.
struct N5Array {
  VoxelType type = VoxelType::kU8;
  Codec codec = Codec::kNone;
  std::vector<std::int64_t> dimensions;
  std::vector<std::int64_t> block_size;  ///< of all but smaller blocks at the end
  /// Which axes are x, y and z; the others have extent 1.  An axis of -1 is not in the array, and
  /// has extent 1, too.
  std::array<int, 3> axes{0, 1, 2};
};

/// Whether the attributes are those of an array, not of a group.
[[nodiscard]] bool is_n5_array(const JsonFields& attributes);

/// Checks all numbers, and bounds what blocks may take.
/// ERRORS: mw::Error(kInput) naming file and field, also when more than three axes have extents
/// above 1.
[[nodiscard]] N5Array parse_n5_array(const JsonFields& attributes);

/// Of the axes x, y and z.
[[nodiscard]] Index3 shape_of(const N5Array& array);
[[nodiscard]] Index3 block_of(const N5Array& array);

}  // namespace mw::io
