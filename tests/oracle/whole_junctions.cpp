// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Betti numbers from one piece, and a merge of two lists.
#include "tests/oracle/whole_junctions.h"

#include "kernels/audit/topology/parts_union.h"

namespace mw::audit::test {
namespace {

Places with_betti(const JunctionsPiece& piece, const Cavities& cavities) {
  Places out;
  for (const JunctionTally& tally : piece.tallies) {
    const auto found = cavities.find(tally.labels);
    const std::int64_t b2 = found == cavities.end() ? 0 : found->second;
    const Betti betti{tally.components, tally.components + b2 - tally.euler, b2};
    (tally.kind == JunctionKind::kInterface ? out.interfaces : out.meetings)
        .push_back({tally.labels, betti});
  }
  return out;
}

std::vector<JunctionChange> changes(const std::vector<JunctionBetti>& before,
                                    const std::vector<JunctionBetti>& after) {
  std::vector<JunctionChange> out;
  auto b = before.begin();
  auto a = after.begin();
  while (b != before.end() || a != after.end()) {
    const bool lost = a == after.end() || (b != before.end() && b->labels < a->labels);
    const bool made = b == before.end() || (a != after.end() && a->labels < b->labels);
    JunctionChange change{lost ? b->labels : a->labels, {}, {}};
    if (!made) change.before = (b++)->betti;
    if (!lost) change.after = (a++)->betti;
    if (change.before != change.after) out.push_back(change);
  }
  return out;
}

}  // namespace

Places junctions_of_volume(const VoxelLabels& volume, std::size_t label_count) {
  PartsUnion parts(label_count);
  parts.add(voxel_parts(whole(volume), label_count).piece);
  return with_betti(voxel_junctions(whole(volume), label_count), parts.cavities());
}

Places junctions_of_mesh(const AuditMesh& mesh, std::size_t label_count) {
  const MeshStars stars(mesh);
  PartsUnion parts(label_count);
  parts.add(mesh_parts(stars, label_count).piece);
  return with_betti(mesh_junctions(stars, label_count), parts.cavities());
}

JunctionReport compare_junctions(const Places& before, const Places& after) {
  return {.interfaces = before.interfaces.size(),
          .meetings = before.meetings.size(),
          .interfaces_changed = changes(before.interfaces, after.interfaces),
          .meetings_changed = changes(before.meetings, after.meetings)};
}

}  // namespace mw::audit::test
