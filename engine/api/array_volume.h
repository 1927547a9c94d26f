// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxels of a caller's array as a volume.
#pragma once

#include <array>

#include "engine/mwmesh_c.h"
#include "io/volume/label_volume.h"

namespace mw::api {

class ArrayReader : public io::LabelVolume {
 public:
  /// strides may be null.  ERRORS: mw::Error(kUsage) without data.
  ArrayReader(const void* data, const io::VolumeInfo& info, const std::int64_t* strides);

  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }
  /// ERRORS: mw::Error(kInput) naming a voxel that holds no whole number.
  void read(const Box3& box, std::span<RawLabel> out) const override;

 private:
  const std::byte* data_;
  std::array<std::int64_t, 3> strides_;
  io::VolumeInfo info_;
};

/// A volume whose voxels a caller's function fetches.
class RegionReader : public io::LabelVolume {
 public:
  using Read = int (*)(void* data, const std::int64_t lo[3], const std::int64_t hi[3],
                       std::uint64_t* labels);

  /// ERRORS: mw::Error(kUsage) without reader.
  RegionReader(io::VolumeInfo info, Read reader, void* data);

  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }
  /// ERRORS: CallbackFailed; mw::Error(kInput) for a label that the type cannot hold.
  void read(const Box3& box, std::span<RawLabel> out) const override;

 private:
  io::VolumeInfo info_;
  Read read_;
  void* data_;
};

/// Returns what a caller says of a volume.  ERRORS: mw::Error(kUsage) for a type, a shape or a
/// space that makes no sense.
[[nodiscard]] io::VolumeInfo info_of(mw_type type, const std::int64_t* shape,
                                     const mw_space* space);

}  // namespace mw::api
