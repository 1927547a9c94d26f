// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/shared_scan.h"

#include <array>

#include "engine/labels/label_scan.h"
#include "engine/team/plain_bytes.h"
#include "kernels/core/error.h"

namespace mw::engine {
namespace {

/// An error as text, its kind first.
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

/// Each rank looks at the beginning of its part and of the next rank's.
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
    throw Error(ErrorKind::kUsage, "the processes of this run do not mesh the same: ranks " +
                                       std::to_string(rank) + " and " + std::to_string(next(rank)) +
                                       " read other labels; give all of them the same volume");
  }
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

}  // namespace mw::engine
