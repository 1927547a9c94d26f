// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sizes of edges, voxel by voxel, that come from a volume beside the labels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/volume/label_volume.h"
#include "io/volume/number_volume.h"

namespace mw::engine {

/// The sizes that an image asks for.  The volume must outlive it.
/// Thread safety: const members may be called from many threads.
class SizeImage {
 public:
  /// labels describes the volume that is meshed.
  /// ERRORS: mw::Error(kInput) when the image has another shape, lies elsewhere in the world, or is
  ///         of a format whose numbers are not read here.
  SizeImage(const io::LabelVolume& image, const io::VolumeInfo& labels, std::string file);
  /// Returns the image with each size multiplied.
  [[nodiscard]] SizeImage scaled(double factor) const;
  /// Returns the sizes of these voxels alone, for a volume that has no others.
  [[nodiscard]] SizeImage part(const Box3& voxels) const;

  /// Returns the sizes in a box, x fastest, in physical units; infinity where the image has no
  /// positive number.  lattice is the shape of the lattice, a multiple of that of the labels.
  [[nodiscard]] std::vector<double> read(const Box3& box, Index3 lattice) const;
  /// Returns a hash of all sizes.  Cost: the image is read once, some 1 MiB at a time.
  [[nodiscard]] std::uint64_t fingerprint() const;
  /// Returns the smallest size; infinity when there is none.  Cost: that of fingerprint().
  [[nodiscard]] double least() const;
  /// Returns how many voxels ask for less than this size.  Cost: that of fingerprint().
  [[nodiscard]] std::uint64_t voxels_below(double size) const;

 private:
  template <typename Visit>
  void each_size(Visit visit) const;

  const io::NumberVolume* numbers_;
  Index3 first_{};  ///< the first voxel of the image that counts
  Index3 shape_;
  double factor_ = 1.0;
};

}  // namespace mw::engine
