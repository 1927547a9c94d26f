// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The one interface through which the rest of the program sees a labelled volume in a file.
#pragma once

#include <array>
#include <span>
#include <string>

#include "kernels/core/index.h"
#include "kernels/core/label.h"

namespace mw::io {

enum class VoxelType { kU8, kU16, kU32, kU64, kI8, kI16, kI32, kI64 };

[[nodiscard]] int byte_size(VoxelType type);
[[nodiscard]] bool is_signed(VoxelType type);
[[nodiscard]] const char* name(VoxelType type);  ///< "u8" .. "i64"

/// Facts of a volume.  Arrays are (x, y, z); spacing > 0 and finite, in the file's physical unit;
/// origin is the physical position of the first corner of the first voxel.
struct VolumeInfo {
  Index3 shape;
  std::array<double, 3> spacing{1.0, 1.0, 1.0};
  std::array<double, 3> origin{0.0, 0.0, 0.0};
  VoxelType type = VoxelType::kU8;
  std::string format;      ///< "npy", "nifti", "nrrd", "raw"
  bool z_fastest = false;  ///< order in the file; whoever reads everything then goes along x
};

/// A readable volume.  Thread safety: read() is const and may be called from many threads.
class LabelVolume {
 public:
  virtual ~LabelVolume() = default;
  [[nodiscard]] virtual const VolumeInfo& info() const = 0;

  /// Reads the voxels of box, x fastest, into out.
  /// REQUIRES: box inside the volume; out.size() == box.voxels().
  /// ERRORS: mw::Error(kInput) naming the file when it is truncated or cannot be read.
  virtual void read(const Box3& box, std::span<RawLabel> out) const = 0;
};

}  // namespace mw::io
