// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A dense array of voxels somewhere in a ByteSource, read by region.  All formats that keep one are
// read by it, and so are files that are nothing else.
#pragma once

#include <filesystem>
#include <memory>

#include "io/file/byte_order.h"
#include "io/file/source/byte_source.h"
#include "io/volume/decode.h"
#include "io/volume/label_volume.h"
#include "io/volume/number_volume.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// Where the voxels are.  Axes go from fastest to slowest x, y, z, or z, y, x when
/// VolumeInfo::z_fastest (a Fortran-order npy).
struct ArrayLayout {
  std::uint64_t offset = 0;
  ByteOrder order = ByteOrder::kLittle;
  VoxelScaling scaling{};
  std::int64_t numbers = 1;  ///< how many each voxel has, one behind the other
  std::int64_t number = 0;   ///< which of them is read
};

/// An array of voxels in a ByteSource.
struct StoredArray {
  std::uint64_t first = 0;  ///< where the voxel box.lo is, in voxels from `offset` on
  Index3 strides;           ///< how many voxels further along x, y and z
  VoxelCoding coding;
  Box3 box;                  ///< its voxels
  std::string name;          ///< what errors call it
  std::uint64_t offset = 0;  ///< in bytes
};

/// Labels of a box, x fastest.
struct ReadBox {
  Box3 box;
  std::span<RawLabel> labels;
};

/// Reads the voxels of a part, which lies in the array and in the box that the labels go to.
/// REQUIRES: strides not negative, all voxels within the source.
/// Cost: one read for each run of rows that lie close together; at most 1 MiB or one row of memory.
/// ERRORS: those of the source; mw::Error(kInput) for a voxel that is no label.
void read_array(const ByteSource& source, const StoredArray& array, const Box3& part,
                const ReadBox& to);

class RawArrayVolume : public LabelVolume, public NumberVolume {
 public:
  /// REQUIRES: the source holds all voxels (check_payload).
  RawArrayVolume(std::shared_ptr<const ByteSource> source, VolumeInfo info, ArrayLayout position)
      : source_(std::move(source)), info_(std::move(info)), position_(position) {}

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  /// Cost: that of read_array().
  void read(const Box3& box, std::span<RawLabel> out) const override;
  void read_numbers(const Box3& box, std::span<double> out) const override;

 private:
  [[nodiscard]] StoredArray stored() const;

  std::shared_ptr<const ByteSource> source_;
  VolumeInfo info_;
  ArrayLayout position_;
};

/// Opens a file that holds such voxels, and unpacks it where it is gzipped.  A file of the right
/// size may begin with gzip's magic by chance, and is not inflated.
[[nodiscard]] std::unique_ptr<ByteSource> open_raw_bytes(const std::filesystem::path& path,
                                                         const RawLayout& layout);

/// Opens a raw file.  Spacing and origin are the options', else 1 and 0.  REQUIRES: options.raw.
/// ERRORS: mw::Error(kInput) when the layout does not match the file's size to the byte.
[[nodiscard]] std::unique_ptr<LabelVolume> open_raw(std::unique_ptr<ByteSource> source,
                                                    const OpenOptions& options);

}  // namespace mw::io
