// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What every format demands of its numbers, what shapes are, worded the same for all; and what a
// file says of its place and the caller against it, made into a VolumeSpace.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/errors.h"
#include "io/file/source/byte_source.h"
#include "io/volume/label_volume.h"
#include "io/volume/open_options.h"
#include "io/volume/volume_space.h"
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

/// A volume's place in the world as a header has it, not checked.
struct FileSpace {
  /// steps[i] is the way from a voxel to its neighbour along axis i of the array (x, y, z).
  std::array<Vector3, 3> steps{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  /// The lengths of the steps where the file states them, too.  They replace the lengths of turned
  /// steps that agree with them, which have rounding errors.
  std::optional<Vector3> lengths;
  /// The steps are floats of 32 bits, read by decimal_of(): lengths of turned ones are the numbers
  /// of fewest digits within the rounding, so that they do not depend on whether they are stated.
  bool in_floats = false;
  /// Where the first voxel is; empty: the file does not say it, and its first corner is at 0.
  std::optional<Vector3> first;
  bool first_is_centre = true;  ///< `first` is the centre of that voxel, else its first corner
  std::string unit;
  WorldFrame frame = WorldFrame::kOwn;
  const char* steps_field = "spacing";  ///< what errors call the two
  const char* first_field = "origin";
  bool is_sized = true;      ///< false: the file does not say the steps
  const char* way_out = "";  ///< what a user may do about sheared steps, ending in ", or, "
};

/// Returns steps along the axes of the array, of these lengths.
[[nodiscard]] std::array<Vector3, 3> steps_of(const Vector3& spacing);

/// Returns the choice called "file", "ras", "lps" or "voxel".
[[nodiscard]] std::optional<FrameChoice> parse_frame_choice(std::string_view text);

/// The options' spacing replaces the lengths of the steps, their origin the first corner, and their
/// frame the axes: kRas and kLps turn x and y of a file of the other frame; kVoxel keeps the
/// spacing only.  Where the file's steps are no directions, its axes are those of the array, in a
/// frame of its own.  What the options replace is not looked at.
/// ERRORS: mw::Error(kInput) naming file and field for steps that are not finite, 0, or not at
/// right angles (beyond 1e-4, as many tools keep coordinates in float; within it the axes are
/// straightened); kUsage when the axes cannot be turned to the frame that is asked for.
[[nodiscard]] VolumeSpace placed(std::string_view file, const FileSpace& space,
                                 const OpenOptions& options);

/// Where a file alone says that a volume lies.
struct OwnPlace {
  VolumeSpace space;
  bool first_is_centre = false;  ///< the file places the centre of the first voxel, not its corner
};

/// Returns the number of an array's first voxel where that data set counts voxels from the one at
/// coordinates 0.  It is 0 where the array is no whole number of voxels away from there, and where
/// the place makes no sense, as options may replace it.
[[nodiscard]] Index3 number_of_first_voxel(const std::function<OwnPlace()>& place);

}  // namespace mw::io
