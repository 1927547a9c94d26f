// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lets one thread that reads a volume far away have several requests in flight.
#pragma once

#include <atomic>

#include "io/volume/label_volume.h"

namespace mw::engine {

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
