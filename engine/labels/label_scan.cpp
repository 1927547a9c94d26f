// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A set of labels a thread, then one of all.
#include "engine/labels/label_scan.h"

#include <tbb/enumerable_thread_specific.h>

#include "engine/labels/reading_tiles.h"
#include "engine/march/march.h"
#include "engine/system/tbb_for.h"
#include "io/labels/label_set.h"

namespace mw::engine {
namespace {

struct Scan {
  io::LabelSet labels;
  std::vector<RawLabel> tile;
};

}  // namespace

io::LabelTable collect_labels(const io::LabelVolume& volume, int threads) {
  const io::VolumeInfo& info = volume.info();
  if (info.scaled || is_float(info.type)) return io::collect_labels(volume);
  const ReadingTiles tiles(info);
  tbb::enumerable_thread_specific<Scan> scans;
  tbb_for_each_index(thread_count(threads), tiles.count(), [&](Index3 tile) {
    Scan& scan = scans.local();
    const Box3 box = tiles.box(tile);
    scan.tile.resize(static_cast<std::size_t>(box.voxels()));
    volume.read(box, scan.tile);
    scan.labels.insert(scan.tile);
  });
  std::vector<RawLabel> all;
  for (const Scan& scan : scans) {
    const std::vector<RawLabel> some = scan.labels.values();
    all.insert(all.end(), some.begin(), some.end());
  }
  return {std::move(all), has_signed_labels(info)};
}

}  // namespace mw::engine
