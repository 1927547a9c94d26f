// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Source surfaces in bricks, in a temporary file.
#pragma once

#include <atomic>
#include <vector>

#include "io/file/scratch/scratch_file.h"
#include "io/labels/brick_volume.h"
#include "kernels/source/source_surface.h"

namespace mw::engine {

/// The source surface of a volume, written once and read many times in small boxes.  Bricks are
/// those of BrickVolume.  In memory it holds 8 bytes a brick; the file has a byte a voxel and 4
/// bytes a face for bricks that have faces.
/// Thread safety: different bricks may be written at once, and then read by many threads.
class SourceBricks {
 public:
  /// bricks is their number along each axis.  The temporary file goes into `folder`.
  SourceBricks(Index3 bricks, const std::filesystem::path& folder,
               const PlaneForm& form = kFilteredForm);

  [[nodiscard]] const PlaneForm& form() const { return form_; }
  /// Stores what belongs to a brick's voxels.  A brick that is not written has no faces.
  void write(Index3 brick, const SourceSurface& surface, const Box3& voxels);
  /// REQUIRES: a box within the volume.
  [[nodiscard]] SourceSurface read(const Box3& box) const;

 private:
  [[nodiscard]] SourceSurface::Part part(std::uint64_t offset) const;

  static constexpr std::uint64_t kNoFaces = ~std::uint64_t{0};

  Index3 bricks_;
  PlaneForm form_;
  std::vector<std::uint64_t> offsets_;
  std::atomic<std::uint64_t> file_size_ = 0;
  io::UnlinkedFile file_;
};

}  // namespace mw::engine
