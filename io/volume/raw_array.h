// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A dense array of voxels somewhere in a ByteSource, read by region: what all formats end in.
#pragma once

#include <memory>

#include "io/file/byte_order.h"
#include "io/file/source/byte_source.h"
#include "io/volume/decode.h"
#include "io/volume/label_volume.h"
#include "io/volume/number_volume.h"

namespace mw::io {

/// Where the voxels are.  Axes go from fastest to slowest x, y, z, or z, y, x when
/// VolumeInfo::z_fastest (a Fortran-order npy).
struct ArrayLayout {
  std::uint64_t offset = 0;
  ByteOrder order = ByteOrder::kLittle;
  VoxelScaling scaling{};
};

class RawArrayVolume : public LabelVolume, public NumberVolume {
 public:
  /// REQUIRES: the source holds all voxels (check_payload).
  RawArrayVolume(std::unique_ptr<ByteSource> source, VolumeInfo info, ArrayLayout position)
      : source_(std::move(source)), info_(std::move(info)), position_(position) {}

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  /// Cost: one pread for each run of rows that lie close together; at most 1 MiB or one row of
  /// scratch memory.
  void read(const Box3& box, std::span<RawLabel> out) const override;
  void read_numbers(const Box3& box, std::span<double> out) const override;

 private:
  /// Calls use(rows, row, bytes) for the rows of a box.
  template <typename Use>
  void read_rows(const Box3& box, Use use) const;

  std::unique_ptr<ByteSource> source_;
  VolumeInfo info_;
  ArrayLayout position_;
};

}  // namespace mw::io
