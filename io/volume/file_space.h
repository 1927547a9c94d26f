// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a file says of its place, and what the caller says against it, made into a VolumeSpace.
#pragma once

#include <optional>
#include <string_view>

#include "io/volume/open_options.h"
#include "io/volume/volume_space.h"

namespace mw::io {

/// A volume's place in the world as a header has it, not checked.
struct FileSpace {
  /// steps[i] is the way from a voxel to its neighbour along axis i of the array (x, y, z).
  std::array<Vector3, 3> steps{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  /// The lengths of the steps where the file states them, too.  They replace the lengths of turned
  /// steps that agree with them, which have rounding errors.
  std::optional<Vector3> lengths;
  /// Where the first voxel is; empty: the file does not say it, and its first corner is at 0.
  std::optional<Vector3> first;
  bool first_is_centre = true;  ///< `first` is the centre of that voxel, else its first corner
  std::string unit;
  WorldFrame frame = WorldFrame::kOwn;
  const char* steps_field = "spacing";  ///< what errors call the two
  const char* first_field = "origin";
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

}  // namespace mw::io
