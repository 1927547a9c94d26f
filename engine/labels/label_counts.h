// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is counted in a volume's labels before windows are visited, also part by part: faces between
// different labels by brick, which shows where the work is, and a number that tells whether two
// volumes hold the same labels.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/labels/reading_tiles.h"
#include "io/labels/label_table.h"
#include "io/volume/label_volume.h"
#include "kernels/core/label.h"

namespace mw::engine {

/// Faces between two voxels of one brick with different labels.  Those between bricks are left out,
/// so that the counts are a function of the labels alone: what is read at once, and so how much is
/// seen around a brick, depends on how the volume is stored.  Memory: 2 bytes for 16^3 voxels.
class BoundaryFaces {
 public:
  BoundaryFaces() = default;
  /// Begins with no faces.
  explicit BoundaryFaces(Index3 volume);

  /// Counts the faces of a brick, whose voxels are given, x fastest.
  /// REQUIRES: they are all its voxels in the volume.  Thread safety: different bricks may be
  /// counted at once.
  void count(Index3 brick, std::span<const Label> voxels);

  /// Returns the number of faces of each brick, x fastest.
  [[nodiscard]] std::span<const std::uint16_t> counts() const { return faces_; }
  /// Adds the counts of the bricks from number `first` on, which another process has counted.
  void add(std::size_t first, std::span<const std::uint16_t> counts);

  /// Returns the number of faces in a box, as if those of each brick were spread evenly over it.
  [[nodiscard]] double in(const Box3& box) const;

 private:
  [[nodiscard]] Box3 box_of(Index3 brick) const;
  [[nodiscard]] std::size_t row(Index3 brick) const {
    return static_cast<std::size_t>((brick.z * bricks_.y + brick.y) * bricks_.x + brick.x);
  }

  Index3 volume_;
  Index3 bricks_;
  std::vector<std::uint16_t> faces_;
};

/// A volume that takes a fingerprint of what is read through it: a sum over voxels, which does not
/// depend on the boxes they are read in.  It is of the content, not of name, size and time of the
/// file: a copy or a conversion is the same input, a file edited in place is not; and all labels
/// are read once at the start of a run anyway.  It guards against mistakes, not against malice.
class FingerprintVolume : public io::VolumeView {
 public:
  using VolumeView::VolumeView;
  void read(const Box3& box, std::span<RawLabel> out) const override;

  /// Returns the sum over a box alone, which is read for it and not added to sum().
  [[nodiscard]] std::uint64_t of(const Box3& box) const;

  /// Returns the sum over what was read here; add() takes that of what another process has read.
  [[nodiscard]] std::uint64_t sum() const { return sum_; }
  void add(std::uint64_t sum) { sum_ += sum; }

  /// Returns the fingerprint as 16 hexadecimal digits.  REQUIRES: every voxel has been read exactly
  /// once, here or by another process.
  [[nodiscard]] std::string text() const;

 private:
  mutable std::atomic<std::uint64_t> sum_ = 0;
};

/// Sums of whole numbers over bricks, each counted once, so that parts add up to the whole.
struct LabelCounts {
  /// Begins with no counts.
  LabelCounts(Index3 shape, std::size_t labels) : faces(shape), voxels(labels) {}

  /// Counts a brick that was read.  mine are the brick's voxels; only is its label if it has just
  /// one.  Thread safety: different bricks may be counted at once.
  void count(Index3 brick, std::span<const Label> mine, std::optional<Label> only);

  BoundaryFaces faces;                ///< shows where there is much to do
  std::vector<std::uint64_t> voxels;  ///< by dense label
};

/// Counts one part of the volume's reading tiles; the number of threads does not change the result.
/// The sum over all parts is what PreparedLabels counts in the whole volume.
/// Memory: 4 MiB a thread, 2 bytes a brick of the volume and 8 a label.
[[nodiscard]] LabelCounts counts_of_part(const io::DenseVolume& volume, int threads,
                                         const SequencePart& part);

}  // namespace mw::engine
