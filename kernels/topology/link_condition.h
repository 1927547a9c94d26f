// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The topology test of an edge contraction, in place of the paper's Algorithm 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/topology/edge_ring.h"
#include "kernels/topology/kept_topology.h"

namespace mw {

/// A symmetric relation on at most 64 labels, given by their places in some list.
class LabelPairs {
 public:
  using Mask = std::uint64_t;

  void reset(std::size_t labels) { with_.assign(labels, 0); }
  /// Pairs a and b; does nothing for a == b.
  void add(std::size_t a, std::size_t b) {
    if (a == b) return;
    with_[a] |= Mask{1} << b;
    with_[b] |= Mask{1} << a;
  }
  /// All labels that are paired with a, by place.
  [[nodiscard]] Mask with(std::size_t a) const { return with_[a]; }

 private:
  std::vector<Mask> with_;
};

/// Decides whether contracting edge (p, q) keeps the homotopy type of the closed region of every
/// label and of the closure of its complement, exterior included; by duality that fixes the Betti
/// numbers of closed and open regions alike (promise P1).  KeptTopology::kInterfaces keeps more.
/// kernels/topology/README.md proves both, "The condition for labels" and "The condition for
/// interfaces".
///
/// kLabels.  Source: Sec 5.3.3 asks for this in Case 3; its Algorithm 1 does not ensure it (it
/// breaks Betti numbers on real data).  Here, for every label L with L at p and at q, and for both
/// Y = closed region of L and Y = closure of all the rest:
///   Lk_Y(p) n Lk_Y(q) = Lk_Y(pq), and pq in Y                                (link condition)
///   each L-tet around pq keeps an L-tet across one of its two other faces            (purity)
/// The second is the first for the complement, so nothing is tested twice.
///
/// kInterfaces also keeps the homotopy type, for every set S of labels, of the place M_S where all
/// of S meet (in a triangle, edge or vertex), and for every pair A, B that of its interface I_AB =
/// closure of the triangles between A and B.  Write L(s) for the labels of the tets at a simplex s,
/// e = pq, and t for a vertex or edge of the ring or nothing:
///   (1) L(et) = L(pt) or L(et) = L(qt), for every t
///   (2) e in I_AB wherever p and q are.
/// Cases 1 and 2 satisfy (1) and (2), because all labels at an inner end are one.
///
/// REQUIRES: p, q free and joined by an edge; all surviving tets will be strictly positive.  That
///           makes Lk(p) n Lk(q) lie in the ring around pq, so that bit masks over it suffice.
/// ENSURES:  mesh unchanged; same verdict for (p, q) and (q, p); never true for a contraction that
///           changes a Betti number, or pinches the boundary of a label where it was not; may be
///           false for one that does neither.
/// Cost: O(stars + labels * ring); kInterfaces: O(stars + ring), rarely a sort of both stars.
class LinkCondition {
 public:
  /// Where a label is on several sides (kFirstSide), it counts as several labels, or as one.
  enum class Sides { kApart, kTogether };

  explicit LinkCondition(const TetMesh& mesh, KeptTopology kept = KeptTopology::kLabels,
                         Sides sides = Sides::kApart)
      : kept_(kept),
        compared_(sides == Sides::kApart ? kExterior : without_side(kExterior)),
        slots_(mesh.vertex_count() + 1, kNoSlot) {}

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
  [[nodiscard]] bool all_labels_allow() const;
  [[nodiscard]] bool label_allows(std::size_t index) const;
  [[nodiscard]] bool meetings_allow();
  [[nodiscard]] bool interfaces_allow(const TetMesh& mesh, LocalVertex p, LocalVertex q);
  void collect_pairs(const TetMesh& mesh, LocalVertex v, LabelPairs& pairs);

  /// A tet at a triangle (v, a, b) of a star; its label is an index into labels_.
  struct FaceSide {
    LocalVertex a = 0;
    LocalVertex b = 0;
    int label = 0;
    friend auto operator<=>(const FaceSide&, const FaceSide&) = default;
  };

  KeptTopology kept_;
  Label compared_;  ///< bits of labels that count
  EdgeRing ring_;
  std::vector<std::uint8_t> slots_;
  std::vector<Label> labels_;
  Side p_, q_;
  LabelPairs edge_pairs_, pairs_p_, pairs_q_;
  std::vector<FaceSide> sides_;
};

}  // namespace mw
