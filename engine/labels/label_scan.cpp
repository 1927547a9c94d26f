// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Each thread collects a set of labels, and these are joined.
#include "engine/labels/label_scan.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>

#include "engine/system/crew.h"
#include "io/labels/label_table.h"

namespace mw::engine {
namespace {

struct Scan {
  io::LabelSet labels;
  std::vector<RawLabel> tile;
};

/// Returns the box of the part's planes across the volume's slowest axis.
Box3 planes(const io::VolumeInfo& info, const SequencePart& part) {
  Box3 out{{0, 0, 0}, info.shape};
  std::int64_t& lo = info.z_fastest ? out.lo.x : out.lo.z;
  std::int64_t& hi = info.z_fastest ? out.hi.x : out.hi.z;
  lo = part.begin(hi);
  hi = part.end(hi);
  return out;
}

}  // namespace

int reader_count(const io::LabelVolume& volume, int threads, const ReaderRoom& room) {
  const int wanted = std::max(thread_count(threads), volume.info().is_far ? io::kFarReaders : 1);
  return io::readers_that_fit(volume, wanted, room);
}

int scanner_count(const io::LabelVolume& volume, int threads, std::uint64_t memory) {
  constexpr std::uint64_t kSetBytes = 80U << 10U;
  constexpr std::uint64_t kTileBytes = ReadingTiles::kMaxVoxels * sizeof(RawLabel);
  return reader_count(volume, threads, {.each = kTileBytes + kSetBytes, .memory = memory});
}

std::vector<RawLabel> labels_of_part(const io::LabelVolume& volume, int threads,
                                     const SequencePart& part) {
  const io::VolumeInfo& info = volume.info();
  if (info.scaled || is_float(info.type)) return io::labels_in(volume, planes(info, part));
  const std::vector<Box3> tiles = ReadingTiles(info).boxes(part);
  const Index3 count{static_cast<std::int64_t>(tiles.size()), 1, 1};
  tbb::enumerable_thread_specific<Scan> scans;
  tbb_for_each_index(thread_count(threads), count, [&](Index3 tile) {
    Scan& scan = scans.local();
    const Box3& box = tiles[static_cast<std::size_t>(tile.x)];
    scan.tile.resize(static_cast<std::size_t>(box.voxels()));
    volume.read(box, scan.tile);
    scan.labels.insert(scan.tile);
  });
  std::vector<RawLabel> all;
  for (const Scan& scan : scans) {
    const std::vector<RawLabel> some = scan.labels.values();
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

io::LabelTable collect_labels(const io::LabelVolume& volume, int threads) {
  return {labels_of_part(volume, threads, {}), has_signed_labels(volume.info())};
}

}  // namespace mw::engine
