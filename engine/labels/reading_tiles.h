// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The boxes in which a whole volume is read, and the bricks in them; lets one thread that reads a
// volume far away have several requests in flight.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "io/labels/brick_volume.h"
#include "io/labels/label_table.h"
#include "io/volume/label_volume.h"
#include "kernels/core/label.h"

namespace mw::engine {

/// Voxels along each edge of a brick.
inline constexpr std::int64_t kBrick = io::BrickVolume::kEdge;

/// One of `count` parts that a sequence is cut into; their sizes differ by at most one.
struct SequencePart {
  int index = 0;
  int count = 1;

  [[nodiscard]] std::int64_t begin(std::int64_t things) const { return things * index / count; }
  [[nodiscard]] std::int64_t end(std::int64_t things) const { return things * (index + 1) / count; }
};

/// Boxes of whole bricks (io::BrickVolume) that cover a volume, each read at once.  They follow the
/// volume's chunks, if it has some, so that chunks are not unpacked twice; otherwise they are long
/// rows.
class ReadingTiles {
 public:
  /// The most voxels of a tile.
  static constexpr std::int64_t kMaxVoxels = 1 << 18;

  explicit ReadingTiles(const io::VolumeInfo& volume);

  /// Returns the number of tiles along each axis.
  [[nodiscard]] Index3 count() const;
  /// Returns the box of a tile.  ENSURES: it begins with a brick, and ends with one or with the
  /// volume.
  [[nodiscard]] Box3 box(Index3 tile) const;
  /// Returns the tiles that have voxels of a box.  REQUIRES: the box is inside the volume.
  [[nodiscard]] Box3 over(const Box3& box) const;
  /// Returns the boxes of one part of all tiles, x fastest; together they are about a slab.
  [[nodiscard]] std::vector<Box3> boxes(const SequencePart& part) const;

 private:
  Index3 shape_;
  Index3 edges_;
};

/// Returns the bricks that a box of voxels touches.  REQUIRES: no coordinate is below 0.
[[nodiscard]] Box3 bricks_over(const Box3& voxels);

/// Copies the voxels of a brick out of a larger box.
void cut_brick(const LabelBox& from, const Box3& brick, std::vector<Label>& out);

/// Reads a part of a volume of dense labels.
template <class Volume>
[[nodiscard]] LabelBox read_labels(const Volume& volume, const Box3& box) {
  LabelBox out{box, std::vector<Label>(static_cast<std::size_t>(box.voxels()))};
  volume.read(box, out.labels);
  return out;
}

using OnBrick = std::function<void(Index3 brick, const Box3& box, std::span<const Label> voxels)>;

/// Calls visit for each brick of a tile.
/// REQUIRES: the tile begins at a brick, and ends at one or with the volume.
void for_each_brick(const LabelBox& tile, const OnBrick& visit);

/// A volume far away (io::VolumeInfo::is_far) whose reads are shared by several threads, tile by
/// tile (ReadingTiles), until end().  Other volumes are read as they are, and so are those whose
/// voxels may be no labels, so that the error names the first such voxel.
/// Memory: as scanner_count() has it.
class SharedReads : public io::VolumeView {
 public:
  /// The volume outlives it.  memory is the budget of which the threads take a part.
  explicit SharedReads(const io::LabelVolume& volume,
                       std::uint64_t memory = std::uint64_t{256} << 20U);

  /// From here on a thread reads alone: there are several that read.
  void end() { readers_ = 1; }
  void read(const Box3& box, std::span<RawLabel> out) const override;

 private:
  std::atomic<int> readers_;
};

}  // namespace mw::engine
