// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sums, shares and labels of a run, over its processes.
#include "engine/team/team_run.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "engine/forecast/run_forecast.h"
#include "engine/labels/label_scan.h"
#include "engine/window/window_memory.h"
#include "io/file/errors.h"
#include "kernels/core/error.h"

namespace mw::engine {
namespace {

template <typename T>
std::vector<T> of_all(Team& team, const T& mine) {
  std::vector<T> out;
  for (const auto& said : team.gather(bytes_of(&mine, 1))) out.push_back(list_of<T>(said).at(0));
  return out;
}

/// Returns "rank 0 has 'name = a', rank 2 has 'name = b'" for the first line that differs.
std::string difference(const std::string& first, const std::string& other, int rank) {
  std::istringstream a(first), b(other);
  std::string line, differing;
  while (std::getline(a, line)) {
    if (!std::getline(b, differing) || line != differing) {
      return io::text("rank 0 has '", line, "', rank ", rank, " has '", differing, "'");
    }
  }
  return io::text("rank ", rank, " has more settings than rank 0");
}

std::vector<double> row_costs(const RunLayout& layout, const MeshSettings& settings,
                              const BoundaryFaces& faces) {
  const Index3 windows = layout.grid(0).windows();
  const WindowOrder order = layout.order(0);
  const MarchWork work(faces, order, settings, {.is_last = layout.marches() == 1});
  std::vector<double> costs(static_cast<std::size_t>(windows.y * windows.z));
  for_each_index(windows, [&](Index3 w) {
    costs[static_cast<std::size_t>(w.z * windows.y + w.y)] += work.of(w);
  });
  return costs;
}

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

void agree(Team& team, const std::string& identity) {
  const std::vector<std::string> all = team.gather(identity);
  for (std::size_t rank = 1; rank < all.size(); ++rank) {
    if (all[rank] == all[0]) continue;
    io::fail_usage("the processes of this run do not mesh the same: " +
                   difference(all[0], all[rank], static_cast<int>(rank)) +
                   "; start all of them with one command line and one version");
  }
}

void wait_for_all(Team& team) {
  static_cast<void>(team.gather(std::string()));
}

Partition deal_windows(Team& team, const RunLayout& layout, const MeshSettings& settings,
                       const BoundaryFaces& faces) {
  std::vector<std::byte> mine;
  if (team.is_first()) {
    const Partition dealt(layout, settings.order, team.ranks(), row_costs(layout, settings, faces));
    mine = bytes_of(dealt.owners().data(), dealt.owners().size());
  }
  return {layout, list_of<std::uint32_t>(team.gather(std::move(mine)).at(0))};
}

VisitStats sum_of_all(Team& team, const VisitStats& mine) {
  VisitStats sum;
  for (const VisitStats& one : of_all(team, mine)) sum += one;
  return sum;
}

std::vector<ProcessFacts> facts_of_all(Team& team, const ProcessFacts& mine) {
  return of_all(team, mine);
}

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
