// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which sets go on in other tiles, and by what they are known there.
#include "kernels/audit/regions/region_sets.h"

#include <limits>

#include "kernels/audit/topology/mesh_parts.h"

namespace mw::audit {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Numbers of the sets that a tet is in; to those of its triangles the opposite vertex is added.
constexpr unsigned kPartOfTet = 0, kRegionOfTet = 1, kInnerOfTet = 4, kOuterOfTet = 8,
                   kSetsOfTet = 16;

}  // namespace

RegionSides::RegionSides(const MeshStars& stars, Label exterior)
    : begin_(std::size_t{stars.vertex_count()} + 1) {
  visit_whole_faces(stars, [&](const MeshFace& face) {
    for (const FaceSide& side : face.sides) {
      const Label label = class_of_tet(stars, exterior, side.tet);
      const auto same = std::count_if(
          face.sides.begin(), face.sides.end(),
          [&](const FaceSide& other) { return class_of_tet(stars, exterior, other.tet) == label; });
      if (same == 1 && label < exterior) all_.push_back({face.vertices, side.tet});
    }
  });
  sort_by_vertex();
}

void RegionSides::sort_by_vertex() {
  for (const RegionSide& side : all_) {
    for (const std::uint32_t v : side.vertices) ++begin_[v + 1];
  }
  for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
  at_.resize(begin_.back());
  std::vector<std::uint64_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t i = 0; i < size(); ++i) {
    for (const std::uint32_t v : all_[i].vertices) at_[next[v]++] = i;
  }
}

RegionSets::RegionSets(const MeshStars& stars, Label exterior)
    : stars_(stars),
      exterior_(exterior),
      sides_(stars, exterior),
      parts_(parts_of_mesh(stars, exterior)),
      open_parts_(parts_.part_class.size()),
      touching_(parts_.part_class.size()),
      within_(sides_.size()),
      without_(sides_.size()) {
  for (std::uint32_t tet = 0; tet < stars_.mesh().tets.size(); ++tet) {
    if (is_shared(tet)) open_parts_[part_of(tet)] = true;
  }
}

/// True if another tile has the tet too, and its label is looked at.
bool RegionSets::is_shared(std::uint32_t tet) const {
  return class_of(tet) < exterior_ && !stars_.leaves_out(tet) && stars_.tile().is_shared(tet);
}

bool RegionSets::is_shared_side(std::uint32_t side) const {
  const auto& corners = sides_[side].vertices;
  return !std::all_of(corners.begin(), corners.end(),
                      [&](std::uint32_t v) { return stars_.owns(v); });
}

/// Counts the sets of one kind by label; those with an open member get a number.
template <class LabelOf>
RegionSets::Numbers RegionSets::number(RegionKind kind, DisjointSets& sets,
                                       const std::vector<bool>& is_open, LabelOf label_of) {
  Numbers numbers(is_open.size(), kNone);
  for (std::uint32_t i = 0; i < is_open.size(); ++i) {
    const Label label = label_of(i);
    const std::uint32_t root = sets.find(i);
    if (label >= exterior_) continue;
    if (root == i) ++tallies_[label].sets[static_cast<std::size_t>(kind)];
    if (!is_open[i] || numbers[root] != kNone) continue;
    numbers[root] = static_cast<std::uint32_t>(out_.open.size());
    out_.open.push_back({label, kind});
  }
  return numbers;
}

RegionSets::Numbers RegionSets::number_parts_and_regions() {
  const auto label_of = [this](std::uint32_t part) { return class_of_part(part); };
  DisjointSets alone(open_parts_.size());
  Numbers parts = number(RegionKind::kPart, alone, open_parts_, label_of);
  const Numbers regions = number(RegionKind::kRegion, touching_, open_parts_, label_of);
  for (std::uint32_t tet = 0; tet < stars_.mesh().tets.size(); ++tet) {
    if (!is_shared(tet)) continue;
    share(tet, kPartOfTet, parts[part_of(tet)]);
    share(tet, kRegionOfTet, regions[touching_.find(part_of(tet))]);
  }
  return parts;
}

void RegionSets::number_boundaries(const Numbers& parts) {
  const auto label_of = [this](std::uint32_t side) { return class_of_side(side); };
  std::vector<bool> is_open(sides_.size());
  for (std::uint32_t i = 0; i < sides_.size(); ++i) is_open[i] = is_shared_side(i);
  const Numbers outer = number(RegionKind::kOuter, without_, is_open, label_of);
  for (const RegionsPiece::Meeting& m : meetings_) is_open[m.inner] = true;
  const Numbers inner = number(RegionKind::kInner, within_, is_open, label_of);
  for (std::uint32_t i = 0; i < sides_.size(); ++i) {
    if (!is_shared_side(i)) continue;
    const auto& [corners, tet] = sides_[i];
    const unsigned apex = apex_of(stars_.mesh().tets[tet], corners);
    share(tet, kInnerOfTet + apex, inner[within_.find(i)]);
    share(tet, kOuterOfTet + apex, outer[without_.find(i)]);
  }
  for (const RegionsPiece::Meeting& m : meetings_) {
    out_.meetings.push_back({m.vertex, parts[m.part], inner[within_.find(m.inner)]});
  }
}

void RegionSets::take_tallies() {
  for (Label label = 0; label < exterior_; ++label) {
    tallies_[label].label = label;
    const bool occurs = tallies_[label].sets[static_cast<std::size_t>(RegionKind::kPart)] > 0;
    if (occurs) out_.tallies.push_back(tallies_[label]);
  }
}

RegionsPiece RegionSets::conclude(std::vector<RegionTally> tallies) {
  tallies_ = std::move(tallies);
  const Numbers parts = number_parts_and_regions();
  number_boundaries(parts);
  take_tallies();
  return std::move(out_);
}

void RegionSets::share(std::uint32_t tet, unsigned which, std::uint32_t set) {
  out_.shared.push_back({stars_.tile().tet_id(tet) * kSetsOfTet + which, set});
}

}  // namespace mw::audit
