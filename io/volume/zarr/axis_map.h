// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which axes of an array are x, y and z.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/core/index.h"

namespace mw::io {

struct AxisMap {
  /// Of x, y and z; empty for the z of an array of two axes, which is one slice.
  std::array<std::optional<std::size_t>, 3> axes;

  /// What a vector with an entry an axis has along x, y and z; `missing` for the z of a slice.
  [[nodiscard]] Index3 pick(const std::vector<std::int64_t>& of_axes, std::int64_t missing) const;
  /// The other way round: 0 along all other axes.
  [[nodiscard]] std::vector<std::int64_t> spread(Index3 index, std::size_t axes) const;
};

/// By names "x", "y" and "z" (z may be missing); without them the axes are z, y, x in this order.
/// All others must be of one entry: of axes without names the first such ones are the others.
/// names: as many as shape, or none.  way_out: what to do about further axes.
/// ERRORS: mw::Error(kInput) naming file and axis.
[[nodiscard]] AxisMap map_axes(std::string_view file, const std::vector<std::int64_t>& shape,
                               const std::vector<std::string>& names, std::string_view way_out);

}  // namespace mw::io
