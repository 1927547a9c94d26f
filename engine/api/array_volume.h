// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxels of a caller's array as a volume.
#pragma once

#include "engine/mwmesh.h"
#include "io/volume/label_volume.h"

namespace mw::api {

class ArrayReader : public io::LabelVolume {
 public:
  /// ERRORS: mw::Error(kUsage) without data, and for a type, a shape or a space that makes no
  /// sense.
  explicit ArrayReader(const mwmesh::ArrayVolume& array);

  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }
  /// ERRORS: mw::Error(kInput) naming a voxel that holds no whole number.
  void read(const Box3& box, std::span<RawLabel> out) const override;

 private:
  const std::byte* data_;
  mwmesh::Index strides_;
  io::VolumeInfo info_;
};

/// A volume whose voxels a caller's function fetches.
class RegionReader : public io::LabelVolume {
 public:
  /// ERRORS: mw::Error(kUsage) without read() or with a negative chunk; else those of ArrayReader.
  explicit RegionReader(const mwmesh::RegionVolume& region);

  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override;

 private:
  std::function<void(const mwmesh::Box&, std::span<std::uint64_t>)> read_;
  io::VolumeInfo info_;
};

}  // namespace mw::api
