// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/team/team_run.h"

#include <sstream>

#include "engine/forecast/run_work.h"
#include "engine/team/team.h"
#include "io/file/errors.h"

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

}  // namespace mw::engine
