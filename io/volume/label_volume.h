// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The one interface through which the rest of the program sees a labelled volume in a file.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "io/names/label_names.h"
#include "io/names/mask_labels.h"
#include "io/volume/volume_space.h"
#include "kernels/core/index.h"
#include "kernels/core/label.h"

namespace mw::io {

class LabelScores;

enum class VoxelType { kU8, kU16, kU32, kU64, kI8, kI16, kI32, kI64, kF32, kF64 };

[[nodiscard]] int byte_size(VoxelType type);
[[nodiscard]] bool is_signed(VoxelType type);    ///< whether labels may be negative, as in floats
[[nodiscard]] bool is_float(VoxelType type);     ///< labels stored as whole numbers in floats
[[nodiscard]] const char* name(VoxelType type);  ///< "u8" .. "i64", "f32", "f64"

/// Facts of a volume.  Arrays are (x, y, z).
struct VolumeInfo {
  Index3 shape;
  // With {}, GCC 12 takes the unit for uninitialised in united sources.
  VolumeSpace space = VolumeSpace();
  VoxelType type = VoxelType::kU8;  ///< as stored
  std::string format;               ///< "npy", "nifti", "nrrd", "raw" and so on
  bool scaled = false;              ///< labels are slope * stored + intercept, hence signed
  bool z_fastest = false;           ///< order in the file; to read all, go along x
  /// The extents of what is read as one: boxes that begin and end at multiples of it are the
  /// cheapest.  0 along an axis means that any box is.
  Index3 chunk{0, 0, 0};
  Index3 first{0, 0, 0};  ///< which voxel of the file is the first of these
  /// The number that a data set gives the first voxel of its file: boxes that people give, and that
  /// they read, count so (first_number()).
  Index3 offset{0, 0, 0};
  bool is_placed = true;  ///< false: the format cannot say where voxels are
  LabelNames names;       ///< what the file calls labels
  /// The masks that the labels were made of, where each set of masks that meet has its own label.
  std::vector<MaskLabels> masks{};
  /// A hash of what the numbers of labels stand for, where these were given when the volume was
  /// opened, as to masks in the order of their files; else 0.
  std::uint64_t numbering = 0;
  std::string note;     ///< what was taken for what the file leaves open, for people; mostly empty
  bool is_far = false;  ///< reads wait for a network: several at a time take little longer than one
};

/// Whether labels of the volume are signed numbers.
[[nodiscard]] inline bool has_signed_labels(const VolumeInfo& info) {
  return info.scaled || is_signed(info.type);
}

/// Returns the number of the first voxel, as people count them.
[[nodiscard]] inline Index3 first_number(const VolumeInfo& info) {
  return info.offset + info.first;
}

/// A readable volume.  Thread safety: read() is const and may be called from many threads.
class LabelVolume {
 public:
  virtual ~LabelVolume() = default;
  [[nodiscard]] virtual const VolumeInfo& info() const = 0;

  /// Reads the voxels of box, x fastest, into out.
  /// REQUIRES: box inside the volume; out.size() == box.voxels().
  /// ERRORS: mw::Error(kInput) naming the file when it is truncated or cannot be read.
  virtual void read(const Box3& box, std::span<RawLabel> out) const = 0;

  /// Returns the most bytes that it holds between and during reads by this number of threads at
  /// once, beside what a reader of plain files takes (1 MiB a thread).
  [[nodiscard]] virtual std::uint64_t buffer_bytes(int /*threads*/) const { return 0; }
  /// Frees what it holds between reads.
  virtual void drop_buffers() const {}
  /// The scores that the labels come from (io/volume/number_volume.h), which live as long as the
  /// volume; null where labels are all that there is.
  [[nodiscard]] virtual const LabelScores* scores() const { return nullptr; }
};

/// Shows another volume as it is, except for read(), which a subclass defines.
class VolumeView : public LabelVolume {
 public:
  /// The volume must outlive it.
  explicit VolumeView(const LabelVolume& volume) : volume_(&volume) {}
  explicit VolumeView(std::shared_ptr<const LabelVolume> volume)
      : owned_(std::move(volume)), volume_(owned_.get()) {}

  [[nodiscard]] const VolumeInfo& info() const override { return volume_->info(); }
  [[nodiscard]] std::uint64_t buffer_bytes(int threads) const override {
    return volume_->buffer_bytes(threads);
  }
  void drop_buffers() const override { volume_->drop_buffers(); }
  [[nodiscard]] const LabelScores* scores() const override { return volume_->scores(); }

 protected:
  [[nodiscard]] const LabelVolume& below() const { return *volume_; }

 private:
  std::shared_ptr<const LabelVolume> owned_;
  const LabelVolume* volume_;
};

}  // namespace mw::io
