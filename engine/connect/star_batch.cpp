// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/connect/star_batch.h"

#include <algorithm>

#include "kernels/core/sort_distinct.h"

namespace mw::engine {
namespace {

/// True if a star whose tets faces join is a ball around the vertex or a half ball, so that no edge
/// has two fans.  The faces opposite to the vertex form a connected surface, whose Euler
/// characteristic is at most 2, or 1 if it has a border; only a sphere or a disc has that much, as
/// each place where the surface is pinched takes at least one from it.
bool is_plain(std::span<const StarTet> star, std::size_t inner_faces) {
  std::vector<std::uint64_t> others;
  others.reserve(3 * star.size());
  for (const StarTet& tet : star) others.insert(others.end(), tet.others.begin(), tet.others.end());
  sort_distinct(others);
  const std::size_t tets = star.size();
  const std::size_t faces = 3 * tets - inner_faces;
  const bool is_closed = 2 * inner_faces == 3 * tets;
  return others.size() + tets == faces + (is_closed ? 2 : 1);
}

/// True for a vertex inside a label: all faces of its tets are shared, and the tets are of one
/// label.
bool is_inside(std::span<const StarTet> star, std::size_t inner_faces) {
  return 2 * inner_faces == 3 * star.size() &&
         std::all_of(star.begin(), star.end(),
                     [&](const StarTet& tet) { return tet.label == star[0].label; });
}

class StarLooker {
 public:
  explicit StarLooker(const StarRules& rules) : rules_(rules) {}

  void look_at(std::uint64_t row, std::span<const StarTet> star) {
    StarSets sets(star.size());
    std::size_t inner_faces = 0;
    bool is_cut = false;
    each_star_face(star, [&](const StarPair& pair) {
      ++inner_faces;
      sets.unite(pair[0], pair[1]);
      is_cut = join(star[pair[0]], star[pair[1]], are_cut(rules_.split, star, pair)) || is_cut;
    });
    if (is_inside(star, inner_faces)) found_.insides.push_back(star[0].label);
    if (!is_cut && sets.count() == 1 && is_plain(star, inner_faces)) return;
    for (const StarTet& tet : star) {
      found_.pinched.push_back(
          {row, tet.others[0], tet.others[1], tet.others[2], tet.tet, tet.label});
    }
  }

  StarFindings found() {
    sort_distinct(found_.insides);
    sort_distinct(found_.watched);
    return std::move(found_);
  }

 private:
  /// Notes that tets have a face in common.  Returns whether they come apart.
  bool join(const StarTet& one, const StarTet& other, bool is_cut) {
    watch(one.label, other.label);
    const PieceJoint joint{.one = piece_at(rules_.first_pieces, one.tet),
                           .other = piece_at(rules_.first_pieces, other.tet),
                           .is_cut = is_cut};
    if (joint.one != joint.other) found_.joints.push_back(joint);
    return is_cut;
  }

  void watch(RawLabel one, RawLabel other) {
    if (one == other || rules_.watched.empty()) return;
    const LabelPair wanted = std::minmax(one, other);
    const auto pair = std::lower_bound(rules_.watched.begin(), rules_.watched.end(), wanted);
    if (pair == rules_.watched.end() || *pair != wanted) return;
    found_.watched.push_back(static_cast<std::size_t>(pair - rules_.watched.begin()));
  }

  const StarRules& rules_;
  StarFindings found_;
};

}  // namespace

StarFindings look_at_stars(std::span<const StarRecord> records, const StarRules& rules) {
  StarLooker looker(rules);
  each_star(records,
            [&](std::uint64_t row, std::vector<StarTet>& star) { looker.look_at(row, star); });
  return looker.found();
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
