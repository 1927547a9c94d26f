// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/team_labels.h"

#include <algorithm>
#include <array>

#include "engine/labels/label_scan.h"
#include "engine/team/team.h"
#include "engine/window/window_memory.h"
#include "io/file/errors.h"
#include "kernels/core/error.h"

namespace mw::engine {
namespace {

/// Returns an error as text that begins with its kind.
std::string text_of(const Error& error) {
  return static_cast<char>('0' + static_cast<int>(error.kind())) + std::string(error.what());
}

void throw_the_first(const std::vector<std::string>& errors) {
  for (const std::string& e : errors) {
    if (!e.empty()) throw Error(static_cast<ErrorKind>(e[0] - '0'), e.substr(1));
  }
}

std::uint64_t of_first_tile(const FingerprintVolume& volume, const SequencePart& part) {
  const std::vector<Box3> tiles = ReadingTiles(volume.info()).boxes(part);
  return tiles.empty() ? 0 : volume.of(tiles.front());
}

/// Each rank compares the first tile of the next rank's part with what that rank read.
void refuse_other_volumes(Team& team, const FingerprintVolume& volume) {
  const int ranks = team.ranks();
  if (ranks == 1) return;
  const auto next = [ranks](int rank) { return (rank + 1) % ranks; };
  const std::array<std::uint64_t, 2> mine{of_first_tile(volume, {team.rank(), ranks}),
                                          of_first_tile(volume, {next(team.rank()), ranks})};
  const auto all = team.gather(bytes_of(mine.data(), mine.size()));
  for (int rank = 0; rank < ranks; ++rank) {
    const auto seen = list_of<std::uint64_t>(all[static_cast<std::size_t>(rank)]);
    const auto other = list_of<std::uint64_t>(all[static_cast<std::size_t>(next(rank))]);
    if (seen.at(1) == other.at(0)) continue;
    io::fail_usage("the processes of this run do not mesh the same: ranks " + std::to_string(rank) +
                   " and " + std::to_string(next(rank)) +
                   " read other labels; give all of them the same volume");
  }
}

/// Counts of faces from the first brick that has some to the last: a rank's part is a slab.
struct SomeFaces {
  std::uint64_t first = 0;
  std::vector<std::uint16_t> counts;
};

SomeFaces without_ends(const BoundaryFaces& faces) {
  const auto all = faces.counts();
  const auto is_some = [](std::uint16_t n) { return n != 0; };
  const auto begin = std::find_if(all.begin(), all.end(), is_some);
  const auto end = std::find_if(all.rbegin(), std::make_reverse_iterator(begin), is_some).base();
  return {static_cast<std::uint64_t>(begin - all.begin()), {begin, end}};
}

BoundaryFaces sum_of_all(Team& team, const BoundaryFaces& mine, Index3 volume) {
  const SomeFaces some = without_ends(mine);
  const auto firsts = team.gather(bytes_of(&some.first, 1));
  const auto counts = team.gather(bytes_of(some.counts.data(), some.counts.size()));
  BoundaryFaces sum(volume);
  for (std::size_t rank = 0; rank < counts.size(); ++rank) {
    sum.add(list_of<std::uint64_t>(firsts[rank]).at(0), list_of<std::uint16_t>(counts[rank]));
  }
  return sum;
}

std::vector<std::uint64_t> sum_of_all(Team& team, const std::vector<std::uint64_t>& mine) {
  std::vector<std::uint64_t> sum(mine.size());
  for (const auto& said : team.gather(bytes_of(mine.data(), mine.size()))) {
    const auto more = list_of<std::uint64_t>(said);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more.at(i);
  }
  return sum;
}

}  // namespace

io::LabelTable collect_together(Team& team, FingerprintVolume& volume, int threads) {
  std::vector<RawLabel> labels;
  std::string failed;
  try {
    labels = labels_of_part(volume, threads, {team.rank(), team.ranks()});
  } catch (const Error& error) {
    failed = text_of(error);
  }
  throw_the_first(team.gather(failed));
  refuse_other_volumes(team, volume);
  const std::uint64_t mine = volume.sum();
  const auto sums = team.gather(bytes_of(&mine, 1));
  std::vector<RawLabel> all;
  int rank = 0;
  for (const auto& said : team.gather(bytes_of(labels.data(), labels.size()))) {
    const auto some = list_of<RawLabel>(said);
    all.insert(all.end(), some.begin(), some.end());
    const auto number = static_cast<std::size_t>(rank);
    if (rank++ != team.rank()) volume.add(list_of<std::uint64_t>(sums[number]).at(0));
  }
  return {std::move(all), has_signed_labels(volume.info())};
}

LabelCounts count_together(Team& team, const io::DenseVolume& volume, int threads) {
  LabelCounts counts = counts_of_part(volume, threads, {team.rank(), team.ranks()});
  counts.faces = sum_of_all(team, counts.faces, volume.info().shape);
  counts.voxels = sum_of_all(team, counts.voxels);
  return counts;
}

LabelNeed labels_needed(const RunLayout& layout, const Partition& partition, int rank,
                        const MeshSettings& settings) {
  LabelNeed need;
  for (std::uint32_t march = 0; march < layout.marches(); ++march) {
    Box3 boxes;
    const WindowGrid& grid = layout.grid(march);
    const Index3 windows = grid.windows();
    for_each_index(Index3{1, windows.y, windows.z}, [&](Index3 w) {
      if (partition.rank_of({march, w}) != rank) return;
      const Index3 last{windows.x - 1, w.y, w.z};  // rows stay whole
      boxes = hull(boxes, hull(grid.window_box(w), grid.window_box(last)));
    });
    // Only the first march makes blocks from labels; later ones take stored blocks.
    if (march == 0) need.starts = boxes;
    if (boxes == Box3{} || !settings.max_distance) continue;
    const std::int64_t halo = content_halo(grid, *settings.max_distance);
    need.near = hull(need.near, intersection(grown(boxes, halo), {{0, 0, 0}, grid.volume()}));
  }
  return need;
}

}  // namespace mw::engine
