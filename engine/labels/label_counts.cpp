// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Voxels of labels, summed over bricks by many threads.
#include "engine/labels/label_counts.h"

#include <algorithm>

#include "engine/labels/reading_tiles.h"
#include "engine/system/crew.h"
#include "kernels/core/index.h"

namespace mw::engine {
namespace {

std::optional<Label> only_label(std::span<const Label> voxels) {
  const Label first = voxels[0];
  const bool is_only =
      std::all_of(voxels.begin(), voxels.end(), [&](Label l) { return l == first; });
  return is_only ? std::optional(first) : std::nullopt;
}

}  // namespace

/// Sums of whole numbers do not depend on which thread adds first.
void LabelCounts::count(Index3 brick, std::span<const Label> mine, std::optional<Label> only) {
  if (!only) faces.count(brick, mine);
  const auto add = [&](Label label, std::uint64_t more) {
    std::atomic_ref(voxels[label]).fetch_add(more, std::memory_order_relaxed);
  };
  if (only) return add(*only, mine.size());
  for (auto run = mine.begin(); run != mine.end();) {
    const auto end = std::find_if(run, mine.end(), [&](Label l) { return l != *run; });
    add(*run, static_cast<std::uint64_t>(end - run));
    run = end;
  }
}

LabelCounts counts_of_part(const io::DenseVolume& volume, int threads, const SequencePart& part) {
  LabelCounts out(volume.info().shape, volume.table().size());
  const std::vector<Box3> tiles = ReadingTiles(volume.info()).boxes(part);
  const Index3 count{static_cast<std::int64_t>(tiles.size()), 1, 1};
  tbb_for_each_index(threads, count, [&](Index3 at) {
    const LabelBox tile = read_labels(volume, tiles[static_cast<std::size_t>(at.x)]);
    for_each_brick(tile, [&](Index3 brick, const Box3& /*box*/, std::span<const Label> voxels) {
      out.count(brick, voxels, only_label(voxels));
    });
  });
  return out;
}

}  // namespace mw::engine
