// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What every format demands of its numbers, and what shapes are, worded the same for all.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/errors.h"
#include "io/file/source/byte_source.h"
#include "io/volume/label_volume.h"
#include "kernels/core/index.h"

namespace mw::io {

/// Makes a shape of (x, y, z) extents.  ERRORS: kInput naming field when an axis is not in
/// 1..kMaxAxisVoxels.
[[nodiscard]] Index3 checked_shape(std::string_view file, std::string_view field,
                                   std::array<std::int64_t, 3> extents);

/// ERRORS: kInput naming `field` unless spacing is finite and positive.
void check_spacing(std::string_view file, std::string_view field, double spacing);

/// ERRORS: kInput naming `field` unless the origin is finite.
void check_origin(std::string_view file, std::string_view field, double origin);

enum class BytesBehind { kIgnored, kRefused };

/// ERRORS: kInput with both numbers of bytes unless source holds the voxels, as many times as
/// `copies` says, from `offset` on; with kRefused, also when bytes are left over.
/// ENSURES: a source that is packed is unpacked as far as the voxels go, and not much further.
void check_payload(const ByteSource& source, const VolumeInfo& info, std::uint64_t offset,
                   BytesBehind behind = BytesBehind::kIgnored, std::uint64_t copies = 1);

/// RAS and LPS are turned into one another.
/// ERRORS: kInput naming `file` unless it has the shape and the place of the volumes before it,
/// which errors call `what`, such as "masks".
void check_same_grid(std::string_view file, const VolumeInfo& info, const VolumeInfo& before,
                     std::string_view what);

/// Returns a shape as "3 x 4 x 5".
template <class Extent>
[[nodiscard]] std::string shape_text(const std::vector<Extent>& shape) {
  std::string out;
  for (const Extent extent : shape) out += text(out.empty() ? "" : " x ", extent);
  return out;
}

/// Returns how many numbers an array has.  REQUIRES: extents are not negative, and the product
/// fits.
[[nodiscard]] inline std::uint64_t product(std::span<const std::int64_t> extents) {
  std::uint64_t out = 1;
  for (const std::int64_t extent : extents) out *= static_cast<std::uint64_t>(extent);
  return out;
}

/// Returns how many bytes all voxels take.
[[nodiscard]] std::uint64_t payload_bytes(const VolumeInfo& info);

}  // namespace mw::io
