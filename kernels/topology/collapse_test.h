// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The topology test of an edge contraction (topology.md D.3, in place of the paper's Algorithm 1).
#pragma once

#include "kernels/topology/edge_ring.h"

namespace mw {

/// Decides whether contracting edge (p, q) keeps the homotopy type of the closed region of every
/// label and of the closure of its complement, exterior included; by duality that fixes the Betti
/// numbers of closed and open regions alike (promise P1).
///
/// Source: Sec 5.3.3 asks for this in Case 3; its Algorithm 1 does not ensure it (it breaks Betti
/// numbers on real data).  Here, for every label L with L at p and at q, and for both Y = closed
/// region of L and Y = closure of all the rest:
///   Lk_Y(p) n Lk_Y(q) = Lk_Y(pq), and pq in Y                                (link condition)
///   each L-tet around pq keeps an L-tet across one of its two other faces            (purity)
/// The second is the first for the complement, so nothing is tested twice.
///
/// REQUIRES: p, q free and joined by an edge; all surviving tets will be strictly positive.  That
///           makes Lk(p) n Lk(q) lie in the ring around pq, so that bit masks over it suffice.
/// ENSURES:  mesh unchanged; same verdict for (p, q) and (q, p); never true for a contraction that
///           changes a Betti number; may be false for one that does not.
/// Cost: O(stars + labels * ring).
class CollapseTest {
 public:
  explicit CollapseTest(const TetMesh& mesh) : slots_(mesh.vertex_count() + 1, kNoSlot) {}

  [[nodiscard]] bool keeps_topology(const TetMesh& mesh, LocalVertex p, LocalVertex q);

 private:
  static constexpr std::uint8_t kNoSlot = 255;
  static constexpr std::size_t kMaxRing = 64;
  static constexpr std::size_t kMaxLabels = 64;
  using Mask = std::uint64_t;

  /// What one end of the edge sees of the ring.
  struct Side {
    Mask labels = 0;                           ///< labels at the end, by index into labels_
    std::array<Mask, kMaxRing> vertex_labels;  ///< labels around edge (end, ring vertex i)
    std::array<Label, kMaxRing> beyond;        ///< label across face (end, ring i, ring i + 1)
  };

  [[nodiscard]] bool look_from(const TetMesh& mesh, LocalVertex end, LocalVertex other, Side& side);
  [[nodiscard]] int label_index(Label label);
  [[nodiscard]] bool label_allows(std::size_t index) const;

  EdgeRing ring_;
  std::vector<std::uint8_t> slots_;
  std::vector<Label> labels_;
  Side p_, q_;
};

}  // namespace mw
