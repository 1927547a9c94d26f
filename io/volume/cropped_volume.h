// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A box of a volume, seen as a volume (--crop).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "io/volume/number_volume.h"
#include "io/volume/open_options.h"

namespace mw::io {

/// A box of a volume.  Chunks keep their size; where the box does not begin at one they are not
/// aligned, which costs time only.  Thread safety: that of the volume below.
class CroppedVolume : public VolumeView {
 public:
  /// moves_origin says whether to move the origin from the first corner of the volume to the box's.
  /// REQUIRES: box not empty and inside the volume.
  CroppedVolume(std::unique_ptr<LabelVolume> volume, const Box3& box, bool moves_origin);

  [[nodiscard]] const VolumeInfo& info() const override { return info_; }
  void read(const Box3& box, std::span<RawLabel> out) const override;
  [[nodiscard]] const LabelScores* scores() const override { return scores_ ? &*scores_ : nullptr; }

 private:
  class CroppedScores : public LabelScores {
   public:
    CroppedScores(const LabelScores& whole, const Box3& box) : whole_(whole), box_(box) {}
    [[nodiscard]] Index3 shape() const override { return box_.shape(); }
    [[nodiscard]] std::size_t labels() const override { return whole_.labels(); }
    void read_scores(RawLabel label, const Box3& box, std::span<double> out) const override {
      whole_.read_scores(label, {box.lo + box_.lo, box.hi + box_.lo}, out);
    }

   private:
    const LabelScores& whole_;
    Box3 box_;
  };

  Index3 first_;
  VolumeInfo info_;
  std::optional<CroppedScores> scores_;
};

/// Returns a box as --crop takes it, "0,0,0,4,4,4".
[[nodiscard]] std::string box_text(const Box3& box);

/// Returns the voxels of the whole volume that are in the box of --crop, which counts as the data
/// set does (VolumeInfo::offset).
/// ERRORS: mw::Error(kUsage) naming `file` and its box when that of --crop is empty or reaches
/// outside.
[[nodiscard]] Box3 voxels_of_crop(std::string_view file, const Box3& crop, const VolumeInfo& whole);

/// Returns the part of the volume that options.crop asks for, or all of it without a crop.  The
/// origin of the options, if they have one, is that of the part.
/// ERRORS: those of voxels_of_crop().
[[nodiscard]] std::unique_ptr<LabelVolume> cropped(std::unique_ptr<LabelVolume> volume,
                                                   std::string_view file,
                                                   const OpenOptions& options);

}  // namespace mw::io
