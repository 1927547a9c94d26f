// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The ring of tetrahedra around an edge, from the star of one end.
#include "kernels/topology/edge_ring.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>

#include "kernels/core/lanes.h"

namespace mw {
namespace {

/// How many entries are looked at together, which is as many as a word has bits for.
constexpr std::size_t kTogether = 16;

constexpr std::array<std::size_t, 3> kNext{1, 2, 0};

LaneInts is_corner(const LinkTriangle& t, LocalVertex q) {
  static_assert(sizeof t == sizeof(LaneInts) && offsetof(LinkTriangle, label) == 12);
  LaneInts entry;
  std::memcpy(&entry, &t, sizeof entry);
  return entry == static_cast<std::int32_t>(q);
}

/// Returns four bits for each entry, which tell the corners that are q.
std::uint64_t corners_at(std::span<const LinkTriangle> entries, LocalVertex q) {
  constexpr std::uint64_t kAllCorners = 0x7777'7777'7777'7777U;  // a label may be q's number
  std::uint64_t found = 0;
  std::size_t i = 0;
  for (; i + 4 <= entries.size(); i += 4) {
    const LinkTriangle* t = &entries[i];
    const std::uint64_t bits =
        lane_bits(is_corner(t[0], q), is_corner(t[1], q), is_corner(t[2], q), is_corner(t[3], q));
    found |= bits << (4 * i);
  }
  for (; i < entries.size(); ++i) {
    found |= std::uint64_t{lane_bits(is_corner(entries[i], q))} << (4 * i);
  }
  return found & kAllCorners;
}

void resize(EdgeRing& ring, std::size_t n) {
  ring.vertices.resize(n);
  ring.ends.resize(n);
  ring.labels.resize(n);
}

}  // namespace

/// No predictor can tell which entries have q, so there is no branch for each entry.
void collect_ring_tets(const TetMesh& mesh, LocalVertex p, LocalVertex q, EdgeRing& ring) {
  const auto star = mesh.star(p);
  std::size_t n = 0;
  for (std::size_t first = 0; first < star.size(); first += kTogether) {
    const auto entries = star.subspan(first, std::min(kTogether, star.size() - first));
    for (std::uint64_t found = corners_at(entries, q); found != 0; found &= found - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(found));
      const auto corners = std::bit_cast<std::array<std::uint32_t, 4>>(entries[bit / 4]);
      if (n == ring.size()) resize(ring, n + 1);
      // (p, q, r, s) is positive for the two corners r, s that follow q.
      ring.vertices[n] = corners[kNext[bit % 4]];
      ring.ends[n] = corners[kNext[kNext[bit % 4]]];
      ring.labels[n] = entries[bit / 4].label;
      ++n;
    }
  }
  if (n != ring.size()) resize(ring, n);
}

bool collect_ring(const TetMesh& mesh, LocalVertex p, LocalVertex q, EdgeRing& ring) {
  collect_ring_tets(mesh, p, q, ring);
  std::vector<LocalVertex>& start = ring.vertices;
  std::vector<LocalVertex>& ends = ring.ends;
  const std::size_t n = ring.size();
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
