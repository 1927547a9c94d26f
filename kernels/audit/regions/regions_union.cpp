// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Counts the sets of all tiles, less one each time that two of them are one.
#include "kernels/audit/regions/regions.h"

#include <algorithm>
#include <limits>

#include "kernels/core/error.h"

namespace mw::audit {
namespace {

RegionBetti betti_of(const RegionTally& tally) {
  const auto& [parts, regions, inner, outer] = tally.sets;
  if (parts == 0) return {};
  const std::int64_t hollows = outer - regions, holes = inner - parts;
  // The Euler characteristic of an open set in three dimensions is minus the sum over its cells.
  return {.closed = {regions, regions + hollows - tally.closed, hollows},
          .open = {parts, parts + holes + tally.only, holes}};
}

}  // namespace

std::uint32_t RegionsUnion::add(const RegionsPiece& piece) {
  if (open_.size() + piece.open.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorKind::kResource, "audit: more than 2^32 parts of labels; audit a --crop");
  }
  for (const RegionTally& part : piece.tallies) {
    RegionTally& sum = tallies_[part.label];
    for (std::size_t kind = 0; kind < kRegionKinds; ++kind) sum.sets[kind] += part.sets[kind];
    sum.closed += part.closed;
    sum.only += part.only;
  }
  const auto first = static_cast<std::uint32_t>(open_.size());
  open_.insert(open_.end(), piece.open.begin(), piece.open.end());
  return first;
}

DisjointSets& RegionsUnion::sets() {
  if (!sets_) sets_.emplace(open_.size());
  return *sets_;
}

void RegionsUnion::unite(std::uint32_t a, std::uint32_t b) {
  if (sets().find(a) == sets().find(b)) return;
  sets().unite(a, b);
  const OpenSet& set = open_[a];
  --tallies_[set.label].sets[static_cast<std::size_t>(set.kind)];
}

void RegionsUnion::meet(std::span<RegionsPiece::Meeting> meetings) {
  for (RegionsPiece::Meeting& m : meetings) m.part = sets().find(m.part);
  std::sort(meetings.begin(), meetings.end(),
            [](const auto& a, const auto& b) { return a.part < b.part; });
  for (std::size_t i = 1; i < meetings.size(); ++i) {
    if (meetings[i].part == meetings[i - 1].part) unite(meetings[i].inner, meetings[i - 1].inner);
  }
}

std::vector<RegionBetti> RegionsUnion::betti() const {
  std::vector<RegionBetti> out;
  for (const RegionTally& tally : tallies_) out.push_back(betti_of(tally));
  return out;
}

std::vector<RegionBetti> region_betti(const AuditMesh& mesh, std::size_t label_count) {
  RegionsUnion regions(label_count);
  regions.add(regions_of(MeshStars(mesh), label_count));
  return regions.betti();
}

}  // namespace mw::audit
