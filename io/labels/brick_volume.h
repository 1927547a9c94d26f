// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Dense labels in cubes: uniform cubes as one number, the others in a temporary file.
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "io/file/scratch/scratch_file.h"
#include "kernels/core/index.h"
#include "kernels/core/label.h"

namespace mw::io {

/// A volume of dense labels that is read many times in small boxes.
///
/// It is cut into bricks of 16^3 voxels.  A uniform brick costs no file access, which makes the
/// large empty parts of a CT nearly free; another takes one read of 4 to 16 KiB.  In memory the
/// volume holds 8 bytes a brick (2 KiB a million voxels).  It may hold only a box of its bricks.
/// Thread safety: different bricks may be written at once; a brick is read after it is written.
class BrickVolume {
 public:
  static constexpr std::int64_t kEdge = 16;

  /// The temporary file goes to folder.
  /// REQUIRES: labels > 0, and every label is below it.
  BrickVolume(Index3 shape, std::size_t labels, const std::filesystem::path& folder);
  /// Holds only the bricks `held` of such a volume.
  BrickVolume(Index3 shape, std::size_t labels, const std::filesystem::path& folder,
              const Box3& held);

  [[nodiscard]] Index3 shape() const { return shape_; }
  [[nodiscard]] Index3 bricks() const { return bricks_; }
  [[nodiscard]] const Box3& held() const { return held_; }
  /// Returns the brick's voxels that are in the volume.
  [[nodiscard]] Box3 box_of(Index3 brick) const;

  /// REQUIRES: voxels are those of box_of(brick), x fastest; the brick is held and is written once.
  void write(Index3 brick, std::span<const Label> voxels);

  /// Returns the brick's only label, or nothing when it has several.  REQUIRES: the brick is held.
  [[nodiscard]] std::optional<Label> uniform_label(Index3 brick) const;

  /// Reads a box that may reach outside the volume, where voxels are kExterior.
  /// REQUIRES: its bricks are written; out.size() == box.voxels().
  void read(const Box3& box, std::span<Label> out) const;

 private:
  static constexpr std::uint64_t kInFile = std::uint64_t{1} << 63;

  [[nodiscard]] std::size_t row(Index3 brick) const;
  void copy_part(Index3 brick, const Box3& part, const Box3& box, std::span<Label> out) const;

  Index3 shape_;
  Index3 bricks_;
  Box3 held_;
  std::size_t label_bytes_;
  std::vector<std::uint64_t> entries_;  ///< label of a uniform brick, or kInFile + offset
  std::atomic<std::uint64_t> file_size_ = 0;
  UnlinkedFile file_;
};

}  // namespace mw::io
