// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Link condition and purity as bit masks over the ring of the edge, or over labels.
#include "kernels/topology/link_condition.h"

#include <algorithm>

namespace mw {

int LinkCondition::label_index(Label label) {
  const auto found = std::find(labels_.begin(), labels_.end(), label);
  const auto index = static_cast<int>(found - labels_.begin());
  if (found == labels_.end()) labels_.push_back(label);
  return index;
}

bool LinkCondition::look_from(const TetMesh& mesh, LocalVertex end, LocalVertex other, Side& side) {
  const std::size_t n = ring_.size();
  side.labels = 0;
  std::fill_n(side.vertex_labels.begin(), n, Mask{0});
  Label label = 0;
  Mask bit = 0;
  for (const LinkTriangle& t : mesh.star(end)) {
    if (bit == 0 || (t.label & compared_) != label) {
      label = t.label & compared_;
      const int index = label_index(label);
      if (labels_.size() > kMaxLabels) return false;
      bit = Mask{1} << index;
    }
    side.labels |= bit;
    const std::array<std::size_t, 3> slot{slots_[t.a], slots_[t.b], slots_[t.c]};
    for (std::size_t s : slot) {
      if (s != kNoSlot) side.vertex_labels[s] |= bit;
    }
    if (t.has(other)) continue;
    // A remainder would take a division.
    const auto after = [n](std::size_t s) { return s + 1 == n ? 0 : s + 1; };
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t s = slot[i], r = slot[i == 2 ? 0 : i + 1];
      if (s == kNoSlot || r == kNoSlot) continue;
      if (after(s) == r) side.beyond[s] = label;
      if (after(r) == s) side.beyond[r] = label;
    }
  }
  return true;
}

bool LinkCondition::label_allows(std::size_t index) const {
  const Label label = labels_[index];
  const Mask bit = Mask{1} << index;
  const std::size_t n = ring_.size();
  const Mask all = n == kMaxRing ? ~Mask{0} : (Mask{1} << n) - 1;
  Mask tets = 0, faces_p = 0, faces_q = 0, in_p = 0, in_q = 0, out_p = 0, out_q = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Mask here = Mask{1} << i;
    if (ring_.labels[i] == label) tets |= here;
    if (p_.beyond[i] == label) faces_p |= here;
    if (q_.beyond[i] == label) faces_q |= here;
    if ((p_.vertex_labels[i] & bit) != 0) in_p |= here;
    if ((q_.vertex_labels[i] & bit) != 0) in_q |= here;
    if ((p_.vertex_labels[i] & ~bit) != 0) out_p |= here;
    if ((q_.vertex_labels[i] & ~bit) != 0) out_q |= here;
  }
  const auto closure = [&](Mask of) { return (of | of << 1 | of >> (n - 1)) & all; };

  // The closed region of the label.
  if (tets == 0) return false;
  if ((faces_p & faces_q & ~tets) != 0) return false;
  if ((in_p & in_q) != closure(tets)) return false;
  // The closure of all the rest; it contains an end unless the label fills the end's star.
  if (p_.labels == bit || q_.labels == bit) return true;
  const Mask rest = all & ~tets;
  if (rest == 0) return false;
  if ((~faces_p & ~faces_q & tets) != 0) return false;
  return (out_p & out_q) == closure(rest);
}

bool LinkCondition::all_labels_allow() const {
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    const Mask bit = Mask{1} << i;
    if ((p_.labels & q_.labels & bit) != 0 && !label_allows(i)) return false;
  }
  return true;
}

/// Tests condition (1) and fills edge_pairs_.
bool LinkCondition::meetings_allow() {
  const std::size_t n = ring_.size();
  edge_pairs_.reset(labels_.size());
  Mask edge = 0;
  auto before = static_cast<std::size_t>(label_index(ring_.labels[n - 1]));
  for (std::size_t i = 0; i < n; ++i) {
    const Label label = ring_.labels[i];
    if (p_.beyond[i] != label && q_.beyond[i] != label) return false;
    const auto here = static_cast<std::size_t>(label_index(label));
    const Mask face = Mask{1} << here | Mask{1} << before;
    if (face != p_.vertex_labels[i] && face != q_.vertex_labels[i]) return false;
    edge |= face;
    edge_pairs_.add(before, here);
    before = here;
  }
  return edge == p_.labels || edge == q_.labels;
}

/// Tests condition (2).  Only labels that meet at the edge but in no triangle need the stars.
bool LinkCondition::interfaces_allow(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
  const Mask edge = p_.labels & q_.labels;
  const auto apart = [&](std::size_t a) {
    const Mask bit = Mask{1} << a;
    return (edge & bit) != 0 ? edge & ~bit & ~edge_pairs_.with(a) : Mask{0};
  };
  Mask any = 0;
  for (std::size_t a = 0; a < labels_.size(); ++a) any |= apart(a);
  if (any == 0) return true;
  collect_pairs(mesh, p, pairs_p_);
  collect_pairs(mesh, q, pairs_q_);
  for (std::size_t a = 0; a < labels_.size(); ++a) {
    if ((apart(a) & pairs_p_.with(a) & pairs_q_.with(a)) != 0) return false;
  }
  return true;
}

void LinkCondition::collect_pairs(const TetMesh& mesh, LocalVertex v, LabelPairs& pairs) {
  sides_.clear();
  for (const LinkTriangle& t : mesh.star(v)) {
    const int label = label_index(t.label & compared_);
    for (const auto& [a, b] :
         {std::minmax(t.a, t.b), std::minmax(t.b, t.c), std::minmax(t.c, t.a)}) {
      sides_.push_back({a, b, label});
    }
  }
  std::sort(sides_.begin(), sides_.end());
  pairs.reset(labels_.size());
  for (std::size_t i = 0; i + 1 < sides_.size(); i += 2) {
    pairs.add(static_cast<std::size_t>(sides_[i].label),
              static_cast<std::size_t>(sides_[i + 1].label));
  }
}

bool LinkCondition::keeps_topology(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
  if (!collect_ring(mesh, p, q, ring_) || ring_.size() > kMaxRing) return false;
  labels_.clear();
  for (Label& label : ring_.labels) label &= compared_;
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    slots_[ring_.vertices[i]] = static_cast<std::uint8_t>(i);
  }
  const bool seen = look_from(mesh, p, q, p_) && look_from(mesh, q, p, q_);
  for (LocalVertex v : ring_.vertices) slots_[v] = kNoSlot;
  if (!seen) return false;
  if (kept_ == KeptTopology::kLabels) return all_labels_allow();
  return meetings_allow() && interfaces_allow(mesh, p, q);
}

}  // namespace mw
