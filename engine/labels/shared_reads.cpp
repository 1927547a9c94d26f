// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/labels/shared_reads.h"

#include <vector>

#include "engine/labels/label_scan.h"
#include "engine/labels/reading_tiles.h"
#include "engine/system/tbb_for.h"
#include "kernels/core/copy_box.h"

namespace mw::engine {
namespace {

int sharers(const io::LabelVolume& volume, std::uint64_t memory) {
  const io::VolumeInfo& info = volume.info();
  const bool is_in_order = info.scaled || is_float(info.type);
  return info.is_far && !is_in_order ? scanner_count(volume, 1, memory) : 1;
}

}  // namespace

SharedReads::SharedReads(const io::LabelVolume& volume, std::uint64_t memory)
    : VolumeView(volume), readers_(sharers(volume, memory)) {}

void SharedReads::read(const Box3& box, std::span<RawLabel> out) const {
  const int readers = readers_;
  const ReadingTiles tiles(info());
  const Box3 over = readers > 1 ? tiles.over(box) : Box3{};
  if (over.voxels() <= 1) return below().read(box, out);
  tbb_for_each_index(readers, over.shape(), [&](Index3 i) {
    const Box3 part = intersection(tiles.box(over.lo + i), box);
    std::vector<RawLabel> labels(static_cast<std::size_t>(part.voxels()));
    below().read(part, labels);
    copy_box<RawLabel>(part, part, labels, box, out);
  });
}

}  // namespace mw::engine
