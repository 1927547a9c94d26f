// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A dense array of voxels somewhere in a ByteSource, read by region: what all formats end in that
// keep one, and files that are nothing else.
#pragma once

#include <filesystem>
#include <memory>

#include "io/file/byte_order.h"
#include "io/file/source/byte_source.h"
#include "io/volume/decode.h"
#include "io/volume/label_volume.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// Where the voxels are.  Axes go from fastest to slowest x, y, z, or z, y, x when
/// VolumeInfo::z_fastest (a Fortran-order npy).
struct ArrayLayout {
  std::uint64_t offset = 0;
  ByteOrder order = ByteOrder::kLittle;
  VoxelScaling scaling{};
};

class RawArrayVolume : public LabelVolume {
 public:
  /// REQUIRES: the source holds all voxels (check_payload).
  RawArrayVolume(std::unique_ptr<ByteSource> source, VolumeInfo info, ArrayLayout position)
      : source_(std::move(source)), info_(std::move(info)), position_(position) {}

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  /// Cost: one pread for each run of rows that lie close together; at most 1 MiB or one row of
  /// scratch memory.
  void read(const Box3& box, std::span<RawLabel> out) const override;

 private:
  std::unique_ptr<ByteSource> source_;
  VolumeInfo info_;
  ArrayLayout position_;
};

/// The bytes of a file that holds such voxels, unpacked where it is gzipped: one of the right size
/// may begin with gzip's magic by chance, and is then not inflated.
[[nodiscard]] std::unique_ptr<ByteSource> open_raw_bytes(const std::filesystem::path& path,
                                                         const RawLayout& layout);

/// REQUIRES: options.raw.  Spacing and origin are the options', else 1 and 0.
/// ERRORS: mw::Error(kInput) when the layout does not match the file's size to the byte.
[[nodiscard]] std::unique_ptr<LabelVolume> open_raw(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

}  // namespace mw::io
