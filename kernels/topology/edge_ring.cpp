// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The ring of tetrahedra around an edge, from the star of one end.
#include "kernels/topology/edge_ring.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

#include "kernels/core/lanes.h"

namespace mw {
namespace {

/// As t.has(q), in one comparison.
bool has(const LinkTriangle& t, LocalVertex q) {
  static_assert(sizeof t == sizeof(LaneInts) && offsetof(LinkTriangle, label) == 12);
  constexpr unsigned kCorners = 7;
  LaneInts entry;
  std::memcpy(&entry, &t, sizeof entry);
  return (lane_bits(entry == static_cast<std::int32_t>(q)) & kCorners) != 0;
}

/// The directed link edge (r, s) of a star entry at p that contains q: (p, q, r, s) is positive.
std::pair<LocalVertex, LocalVertex> opposite(const LinkTriangle& t, LocalVertex q) {
  if (t.a == q) return {t.b, t.c};
  if (t.b == q) return {t.c, t.a};
  return {t.a, t.b};
}

}  // namespace

bool collect_ring(const TetMesh& mesh, LocalVertex p, LocalVertex q, EdgeRing& ring) {
  ring.vertices.clear();
  ring.labels.clear();
  ring.ends.clear();
  std::vector<LocalVertex>& start = ring.vertices;
  std::vector<LocalVertex>& ends = ring.ends;
  const auto star = mesh.star(p);
  // Which entries have q cannot be foretold, so no branch asks.
  ring.rows.resize(std::max(ring.rows.size(), star.size()));
  std::size_t n = 0;
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    ring.rows[n] = i;
    n += has(star[i], q) ? 1U : 0U;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const LinkTriangle& t = star[ring.rows[i]];
    const auto [r, s] = opposite(t, q);
    start.push_back(r);
    ends.push_back(s);
    ring.labels.push_back(t.label);
  }
  if (n < 3) return false;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    std::size_t next = i + 1;
    while (next < n && start[next] != ends[i]) ++next;
    if (next == n) return false;
    std::swap(start[i + 1], start[next]);
    std::swap(ends[i + 1], ends[next]);
    std::swap(ring.labels[i + 1], ring.labels[next]);
  }
  return ends[n - 1] == start[0];
}

}  // namespace mw
