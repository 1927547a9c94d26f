// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where a volume lies: from voxels to the world.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "kernels/core/index.h"
#include "kernels/core/vector3.h"

namespace mw::io {

using mw::Vector3;

/// A world frame that files name: x to the patient's right or left, y to the front or back, z up.
enum class WorldFrame {
  kOwn,  ///< the file names none; its axes are all that is known
  kRas,  ///< right, anterior, superior: NIfTI
  kLps,  ///< left, posterior, superior: DICOM, ITK
};
[[nodiscard]] const char* name(WorldFrame frame);  ///< "own", "ras", "lps"

/// world = origin + sum over i of axes[i] * spacing[i] * corner[i], corners of voxels in (x, y, z)
/// of the array; the centre of voxel v is corner v + 1/2.
struct VolumeSpace {
  Vector3 spacing{1.0, 1.0, 1.0};  ///< edges of a voxel, finite and positive, in `unit`
  Vector3 origin{0.0, 0.0, 0.0};   ///< first corner of the first voxel
  /// Directions of the array's axes, of unit length and at right angles to each other: rotations,
  /// flips and permutations.
  std::array<Vector3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::string unit;  ///< "mm", "um", "nm", "m" and so on; empty: unknown
  WorldFrame frame = WorldFrame::kOwn;
  bool is_sized = true;  ///< false: nobody said how large voxels are, and 1 was taken
};

/// Returns how many nanometres "nm", "um", "mm" or "m" has; nothing for other texts.
[[nodiscard]] std::optional<double> nm_in(std::string_view unit);

/// Whether the array's axes are those of the world: then coordinates are origin + spacing * corner.
[[nodiscard]] bool is_upright(const VolumeSpace& space);
/// Whether the array's axes are left-handed in the world, which turns the sign of volumes.
[[nodiscard]] bool is_mirrored(const VolumeSpace& space);

/// Returns where a point of the array, in voxels from the first corner, is in the world.  In
/// upright spaces only one of the three products of a coordinate is not 0, so that it is origin +
/// spacing * corner to the bit.
[[nodiscard]] inline Vector3 to_world(const VolumeSpace& space, const Vector3& corner) {
  Vector3 out{};
  for (std::size_t k = 0; k < 3; ++k) {
    out[k] = space.origin[k] + (space.axes[0][k] * (space.spacing[0] * corner[0]) +
                                space.axes[1][k] * (space.spacing[1] * corner[1]) +
                                space.axes[2][k] * (space.spacing[2] * corner[2]));
  }
  return out;
}

/// Inverts to_world(), up to rounding.
[[nodiscard]] Vector3 to_corner(const VolumeSpace& space, const Vector3& world);

/// Returns that place in another world frame: x and y change their sign between kRas and kLps.
/// From and to kOwn nothing changes.
[[nodiscard]] VolumeSpace in_frame(VolumeSpace space, WorldFrame frame);

/// Returns the space of a box of the volume that begins at the corner `first`.
[[nodiscard]] VolumeSpace moved_to(const VolumeSpace& space, Index3 first);

/// Whether two places are one, up to what is lost when text and floats of 32 bits are written.
[[nodiscard]] bool is_same_place(const VolumeSpace& a, const VolumeSpace& b);

}  // namespace mw::io
