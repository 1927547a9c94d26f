// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Parts of all tiles under one numbering, joined, and numbered anew.
#include "kernels/audit/topology/parts_union.h"

#include <limits>
#include <utility>

#include "kernels/audit/topology/part_graph.h"
#include "kernels/core/error.h"

namespace mw::audit {
namespace {

/// Returns the pairs under new numbers, without those whose parts became one.
std::vector<PartPair> renumbered(const std::vector<PartPair>& pairs,
                                 const std::vector<std::uint32_t>& number) {
  PairSet out;
  for (const PartPair& pair : pairs) out.add(number[pair.a], number[pair.b]);
  return out.take();
}

void append(const std::vector<PartPair>& pairs, std::uint32_t first, std::vector<PartPair>& out) {
  for (const PartPair& pair : pairs) out.push_back({first + pair.a, first + pair.b});
}

}  // namespace

std::uint32_t PartsUnion::add(PartsPiece piece) {
  if (part_class_.size() + piece.part_class.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorKind::kResource, "audit: more than 2^32 parts of labels; audit a --crop");
  }
  const auto first = static_cast<std::uint32_t>(part_class_.size());
  part_class_.insert(part_class_.end(), piece.part_class.begin(), piece.part_class.end());
  append(piece.face_pairs, first, face_pairs_);
  append(piece.vertex_pairs, first, vertex_pairs_);
  cells_.insert(cells_.end(), piece.cells.begin(), piece.cells.end());
  total_ += piece.total;
  return first;
}

DisjointSets& PartsUnion::sets() {
  if (sets_) return *sets_;
  sets_.emplace(part_class_.size());
  std::optional<std::uint32_t> exterior;
  for (std::uint32_t part = 0; part < part_class_.size(); ++part) {
    if (part_class_[part] != label_count_) continue;
    if (exterior) sets_->unite(*exterior, part);
    exterior = part;
  }
  return *sets_;
}

void PartsUnion::unite(std::uint32_t a, std::uint32_t b) {
  sets().unite(a, b);
}

EulerSums PartsUnion::sums() const {
  EulerSums out(label_count_ + 2);  // the exterior, and labels that are not the volume's
  for (const ClassCells& cells : cells_) out.add(cells);
  out.total = total_;
  return out;
}

std::vector<RegionBetti> PartsUnion::betti_of_volume() {
  EulerSums euler = sums();
  // The exterior is an open ball, hence one 3-cell; its closure adds the box's surface, chi 2.
  euler.closed[label_count_] = 1;
  euler.only[label_count_] = -1;
  return betti(euler);
}

std::vector<RegionBetti> PartsUnion::betti_of_mesh() {
  EulerSums euler = sums();
  const auto exterior = static_cast<Label>(label_count_);
  euler.add(-1, std::span(&exterior, 1));
  return betti(euler);
}

void PartsUnion::join() {
  if (std::exchange(is_joined_, true)) return;
  sets();
  Parts parts = number_parts(std::move(*sets_), label_count_ + 2,
                             [&](std::size_t part) { return part_class_[part]; });
  part_class_ = std::move(parts.part_class);
  face_pairs_ = renumbered(std::exchange(face_pairs_, {}), parts.of_member);
  vertex_pairs_ = renumbered(std::exchange(vertex_pairs_, {}), parts.of_member);
}

std::vector<RegionBetti> PartsUnion::betti(const EulerSums& euler) {
  join();
  std::vector<RegionBetti> out = betti_of_parts(part_class_, face_pairs_, vertex_pairs_, euler);
  out.resize(label_count_ + 1);
  return out;
}

Cavities PartsUnion::cavities() {
  join();
  return cavities_of_interfaces(part_class_, face_pairs_);
}

}  // namespace mw::audit
