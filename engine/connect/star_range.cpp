// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/connect/star_range.h"

#include <algorithm>
#include <numeric>

#include "engine/connect/tet_faces.h"
#include "kernels/core/sort_distinct.h"

namespace mw::engine {
namespace {

/// A corner of a tet, by their numbers.
struct Corner {
  std::uint32_t tet = 0;
  std::uint32_t corner = 0;
};

/// What is counted at a vertex.
struct StarCounts {
  std::size_t tets = 0;
  std::size_t inner_faces = 0;  ///< pairs of tets that share a face at the vertex
  std::size_t sets = 0;         ///< of tets that such faces join
  std::size_t others = 0;       ///< vertices at the other ends of edges
  bool has_one_label = true;
  bool is_cut = false;  ///< whether the mesh comes apart at one of the faces

  [[nodiscard]] bool is_closed() const { return 2 * inner_faces == 3 * tets; }
  /// True if the star is a ball around the vertex or a half ball, so that no edge has two fans.
  /// The faces opposite to the vertex then form one connected surface, whose Euler characteristic
  /// is at most 2, or 1 if it has a border; only a sphere or a disc has that much, as each place
  /// where the surface is pinched takes at least one from it.
  [[nodiscard]] bool is_plain() const {
    const std::size_t faces = 3 * tets - inner_faces;
    return sets == 1 && others + tets == faces + (is_closed() ? 2 : 1);
  }
};

class RangeLooker {
 public:
  RangeLooker(const StarRange& range, const StarRules& rules)
      : range_(range),
        rules_(rules),
        may_cut_(rules.split.any()),
        mesh_(local_tets(range.tets, {range.first_row, kRows})),
        earlier_(earlier_tets(mesh_, kRows)),
        seen_(mesh_.rows.size(), kNoTet),
        sets_of_tets_(range.tets.size()) {}

  StarFindings look() {
    note_faces();
    take_corners();
    for (std::size_t v = 0; v < kRows; ++v) {
      const std::span<const Corner> star(corners_.data() + first_corner_[v],
                                         corners_.data() + first_corner_[v + 1]);
      if (!star.empty()) look_at(star);
    }
    sort_distinct(found_.joints);
    sort_distinct(found_.insides);
    sort_distinct(found_.watched);
    return std::move(found_);
  }

 private:
  /// Vertices of lower numbers are those of the range.
  static constexpr std::uint32_t kRows = kRowsARange;

  /// Notes what each face that two tets share says about pieces and labels.
  void note_faces() {
    for (std::uint32_t t = 0; t < earlier_.size(); ++t) {
      for (const std::uint32_t other : earlier_[t]) {
        if (other == kNoTet) continue;
        const PieceJoint joint{range_.pieces[other], range_.pieces[t], may_cut_ && cuts(other, t)};
        if (joint.one != joint.other) found_.joints.push_back(joint);
        watch(range_.labels[other], range_.labels[t]);
      }
    }
  }

  [[nodiscard]] bool cuts(std::uint32_t one, std::uint32_t other) const {
    return rules_.split.cuts(range_.labels[one], range_.labels[other]);
  }

  void watch(RawLabel one, RawLabel other) {
    if (one == other || rules_.watched.empty()) return;
    const LabelPair wanted = std::minmax(one, other);
    const auto pair = std::lower_bound(rules_.watched.begin(), rules_.watched.end(), wanted);
    if (pair == rules_.watched.end() || *pair != wanted) return;
    found_.watched.push_back(static_cast<std::size_t>(pair - rules_.watched.begin()));
  }

  /// Lists the corners at each vertex of the range.
  void take_corners() {
    first_corner_.assign(kRows + 1, 0);
    each_corner([&](std::uint32_t v, Corner) { ++first_corner_[v + 1]; });
    std::partial_sum(first_corner_.begin(), first_corner_.end(), first_corner_.begin());
    corners_.resize(first_corner_.back());
    std::vector<std::size_t> next = first_corner_;
    each_corner([&](std::uint32_t v, Corner corner) { corners_[next[v]++] = corner; });
  }

  template <class Visit>
  void each_corner(Visit visit) const {
    for (std::uint32_t t = 0; t < mesh_.corners.size(); ++t) {
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t v = mesh_.corners[t][k];
        if (v < kRows) visit(v, Corner{t, k});
      }
    }
  }

  void look_at(std::span<const Corner> star) {
    const StarCounts counts = count(star);
    if (counts.is_closed() && counts.has_one_label) {
      found_.insides.push_back(range_.labels[star[0].tet]);
    }
    if (!counts.is_cut && counts.is_plain()) return;
    for (const Corner& at : star) {
      StarRecord record{0, 0, 0, 0, range_.places[at.tet], range_.labels[at.tet]};
      for (std::size_t k = 0, next = 1; k < 4; ++k) {
        record[k == at.corner ? 0 : next++] = mesh_.rows[mesh_.corners[at.tet][k]];
      }
      found_.pinched.push_back(record);
    }
  }

  [[nodiscard]] StarCounts count(std::span<const Corner> star) {
    StarCounts out{.tets = star.size()};
    const std::uint32_t vertex = mesh_.corners[star[0].tet][star[0].corner];
    const RawLabel label = range_.labels[star[0].tet];
    std::size_t inner_faces = 0, others = 0, sets = star.size();
    for (const Corner& at : star) {
      sets_of_tets_[at.tet] = at.tet;
      if (range_.labels[at.tet] != label) out.has_one_label = false;
    }
    for (const Corner& at : star) {
      const auto& ends = mesh_.corners[at.tet];
      const auto& earlier = earlier_[at.tet];
      // The edge to a corner, and the face at the vertex without that corner.
      for (std::size_t k = 0; k < ends.size(); ++k) {
        if (k == at.corner) continue;
        others += seen_[ends[k]] != vertex ? 1U : 0U;
        seen_[ends[k]] = vertex;
        if (earlier[k] == kNoTet) continue;
        ++inner_faces;
        if (may_cut_ && cuts(earlier[k], at.tet)) out.is_cut = true;
        if (sets > 1 && unite(earlier[k], at.tet)) --sets;
      }
    }
    out.inner_faces = inner_faces;
    out.others = others;
    out.sets = sets;
    return out;
  }

  /// Returns whether the tets were in different sets.
  bool unite(std::uint32_t one, std::uint32_t other) {
    const std::uint32_t first = set_of(one), second = set_of(other);
    sets_of_tets_[std::max(first, second)] = std::min(first, second);
    return first != second;
  }

  [[nodiscard]] std::uint32_t set_of(std::uint32_t tet) {
    while (sets_of_tets_[tet] != tet) {
      tet = sets_of_tets_[tet] = sets_of_tets_[sets_of_tets_[tet]];
    }
    return tet;
  }

  const StarRange& range_;
  const StarRules& rules_;
  bool may_cut_;
  LocalTets mesh_;
  EarlierTets earlier_;
  std::vector<std::size_t> first_corner_;  ///< by vertex of the range, and one behind the last
  std::vector<Corner> corners_;
  std::vector<std::uint32_t> seen_;          ///< by vertex: at which vertex it was counted last
  std::vector<std::uint32_t> sets_of_tets_;  ///< parents; those of the star at hand are valid
  StarFindings found_;
};

}  // namespace

StarFindings look_at_stars(const StarRange& range, const StarRules& rules) {
  return RangeLooker(range, rules).look();
}

void each_star(std::span<const StarRecord> records,
               const std::function<void(std::uint64_t row, std::vector<StarTet>& star)>& visit) {
  std::vector<StarTet> star;
  for (std::size_t at = 0; at < records.size();) {
    const std::uint64_t vertex = records[at][0];
    star.clear();
    for (; at < records.size() && records[at][0] == vertex; ++at) {
      const auto& [row, a, b, c, place, label] = records[at];
      star.push_back({{a, b, c}, place, label});
    }
    visit(vertex, star);
  }
}

}  // namespace mw::engine
