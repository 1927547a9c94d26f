// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds patches by union-find over triangles; verdicts are kept at their roots.
#include "kernels/odt/replacement.h"

#include "kernels/core/disjoint_sets.h"
#include "kernels/core/sort_distinct.h"
#include "kernels/odt/tet_faces.h"
#include "kernels/quality/quality.h"

namespace mw {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

/// Positions of the mesh's vertices and of those added.
class Positions {
 public:
  Positions(const TetMesh& mesh, std::span<const std::optional<Point>> added)
      : mesh_(mesh), added_(added) {}

  [[nodiscard]] bool has(LocalVertex v) const {
    return v < mesh_.vertex_count() ||
           (v - mesh_.vertex_count() < added_.size() && added_[v - mesh_.vertex_count()]);
  }
  /// REQUIRES: has(v).
  [[nodiscard]] Point of(LocalVertex v) const {
    return v < mesh_.vertex_count() ? mesh_.position(v) : *added_[v - mesh_.vertex_count()];
  }

 private:
  const TetMesh& mesh_;
  std::span<const std::optional<Point>> added_;
};

bool within_exact_range(const std::array<Point, 4>& p) {
  const auto narrow = [&p](auto coordinate) {
    const auto [lo, hi] =
        std::minmax({coordinate(p[0]), coordinate(p[1]), coordinate(p[2]), coordinate(p[3])});
    return hi - lo <= kMaxTetExtent;
  };
  return narrow([](Point q) { return std::int64_t{q.x}; }) &&
         narrow([](Point q) { return std::int64_t{q.y}; }) &&
         narrow([](Point q) { return std::int64_t{q.z}; });
}

/// Returns the tet made positive, or nothing if it is flat, too large or not on the lattice.
std::optional<LocalTet> positive_tet(const Positions& positions,
                                     const std::array<std::uint32_t, 4>& rows, Label label) {
  std::array<Point, 4> p;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!positions.has(rows[i])) return std::nullopt;
    p[i] = positions.of(rows[i]);
  }
  if (!within_exact_range(p)) return std::nullopt;
  const std::int64_t volume = volume6(p[0], p[1], p[2], p[3]);
  if (volume == 0) return std::nullopt;
  LocalTet tet{{rows[0], rows[1], rows[2], rows[3]}, label};
  if (volume < 0) std::swap(tet.vertices[2], tet.vertices[3]);
  return tet;
}

/// All tets, the old ones first.
struct AllTets {
  std::vector<LocalTet> tets;
  std::vector<std::uint32_t> regions;
  std::uint32_t old_count = 0;

  [[nodiscard]] bool is_old(std::uint32_t t) const { return t < old_count; }
};

/// New tets that cannot be used at all are left out; the holes that they leave are found later.
AllTets all_tets(const Positions& positions, const RegionTets& content, const Triangulation& made) {
  AllTets all{content.tets, content.regions, static_cast<std::uint32_t>(content.tets.size())};
  const std::size_t count = std::min(made.tets.size(), made.regions.size());
  for (std::size_t t = 0; t < count; ++t) {
    const std::uint32_t region = made.regions[t];
    if (region >= content.labels.size()) continue;
    if (const auto tet = positive_tet(positions, made.tets[t], content.labels[region])) {
      all.tets.push_back(*tet);
      all.regions.push_back(region);
    }
  }
  return all;
}

/// Classes of tets, and which of them are proved.
class Patches {
 public:
  explicit Patches(const AllTets& all)
      : all_(all), sets_(all.tets.size()), refused_(all.tets.size(), 0) {
    meet_at_triangles();
    refuse_mixed_regions();
    refuse_lost_vertices();
    for (std::uint32_t t = 0; t < all_.tets.size(); ++t) refused_[root(t)] |= refused_[t];
  }

  [[nodiscard]] std::uint32_t root(std::uint32_t t) { return sets_.find(t); }
  [[nodiscard]] bool is_refused(std::uint32_t t) { return refused_[root(t)] != 0; }

 private:
  /// The tets at a triangle, by whether they are new, then by side.
  using Meeting = std::array<std::array<std::uint32_t, 2>, 2>;

  void refuse(std::uint32_t t) { refused_[t] = 1; }

  void meet_at_triangles() {
    std::vector<TetFace> faces;
    faces.reserve(4 * all_.tets.size());
    for (std::uint32_t t = 0; t < all_.tets.size(); ++t) {
      for (int corner = 0; corner < 4; ++corner) faces.push_back(tet_face(all_.tets[t], corner, t));
    }
    for_each_triangle(faces, [this](auto first, auto last) {
      Meeting at{{{kNone, kNone}, {kNone, kNone}}};
      for (auto f = first; f != last; ++f) {
        std::uint32_t& slot = at[all_.is_old(f->tet) ? 0 : 1][f->side];
        if (slot != kNone) refuse(f->tet);
        if (slot != kNone) refuse(slot);
        slot = f->tet;
      }
      settle(at);
    });
  }

  /// Joins tets that share a triangle, and refuses those that lack a neighbour.
  void settle(const Meeting& at) {
    const auto& [old, made] = at;
    const auto is_between = [](const auto& pair) { return pair[0] != kNone && pair[1] != kNone; };
    const auto is_free = [](const auto& pair) { return pair[0] == kNone && pair[1] == kNone; };
    if (is_between(made) && is_free(old)) return sets_.unite(made[0], made[1]);
    if (is_between(old) && is_free(made) && all_.regions[old[0]] == all_.regions[old[1]]) {
      return sets_.unite(old[0], old[1]);
    }
    for (std::size_t side = 0; side < 2; ++side) {
      if (old[side] != kNone && made[side] != kNone) {
        sets_.unite(old[side], made[side]);
      } else if (old[side] != kNone) {
        refuse(old[side]);
      } else if (made[side] != kNone) {
        refuse(made[side]);
      }
    }
  }

  void refuse_mixed_regions() {
    for (std::uint32_t t = 0; t < all_.tets.size(); ++t) {
      if (all_.regions[t] != all_.regions[root(t)]) refuse(t);
    }
  }

  /// Refuses patches whose new tets leave out a vertex of the old ones.
  void refuse_lost_vertices() {
    using Use = std::pair<std::uint32_t, LocalVertex>;
    std::array<std::vector<Use>, 2> uses;
    for (std::uint32_t t = 0; t < all_.tets.size(); ++t) {
      auto& list = uses[all_.is_old(t) ? 0 : 1];
      for (LocalVertex v : all_.tets[t].vertices) list.emplace_back(root(t), v);
    }
    for (auto& list : uses) {
      sort_distinct(list);
    }
    std::vector<Use> lost;
    std::set_difference(uses[0].begin(), uses[0].end(), uses[1].begin(), uses[1].end(),
                        std::back_inserter(lost));
    for (const Use& use : lost) refuse(use.first);
  }

  const AllTets& all_;
  DisjointSets sets_;
  std::vector<std::uint8_t> refused_;
};

/// The number of old and of new tets of a patch, and the worst radius ratio of each.
struct PatchShape {
  std::array<std::uint32_t, 2> tets{};
  std::array<double, 2> worst{1.0, 1.0};

  void add(bool is_old, double ratio) {
    const std::size_t i = is_old ? 0 : 1;
    ++tets[i];
    worst[i] = std::min(worst[i], ratio);
  }
  /// True for one old and one new tet, which then have the same four triangles.
  [[nodiscard]] bool is_unchanged() const { return tets[0] == 1 && tets[1] == 1; }
  [[nodiscard]] bool is_allowed(double quality_floor) const {
    return worst[1] >= std::min(quality_floor, worst[0]);
  }
};

double ratio_of(const Positions& positions, const Metric& metric, const LocalTet& t) {
  const auto& v = t.vertices;
  return radius_ratio(tet_edges(metric, positions.of(v[0]), positions.of(v[1]), positions.of(v[2]),
                                positions.of(v[3])));
}

}  // namespace

ReplacementStats& ReplacementStats::operator+=(const ReplacementStats& other) {
  patches += other.patches;
  unproved += other.unproved;
  unimproved += other.unimproved;
  return *this;
}

// More than five parameters: old and new tets, and what both are measured by.
Replacement replace_proved(const TetMesh& mesh, const Metric& metric, const RegionTets& content,
                           std::span<const std::optional<Point>> added, const Triangulation& made,
                           double quality_floor) {
  const Positions positions(mesh, added);
  const AllTets all = all_tets(positions, content, made);
  Patches patches(all);
  std::vector<PatchShape> shapes(all.tets.size());
  for (std::uint32_t t = 0; t < all.tets.size(); ++t) {
    shapes[patches.root(t)].add(all.is_old(t), ratio_of(positions, metric, all.tets[t]));
  }
  Replacement out;
  out.used.assign(added.size(), 0);
  for (std::uint32_t t = 0; t < all.tets.size(); ++t) {
    const std::uint32_t root = patches.root(t);
    const PatchShape& shape = shapes[root];
    const bool proved = !patches.is_refused(t);
    const bool taken = proved && !shape.is_unchanged() && shape.is_allowed(quality_floor);
    if (t == root && shape.tets[0] != 0 && !(proved && shape.is_unchanged())) {
      ++out.stats.patches;
      out.stats.unproved += proved ? 0U : 1U;
      out.stats.unimproved += proved && !taken ? 1U : 0U;
    }
    if (taken == all.is_old(t)) continue;
    out.tets.push_back(all.tets[t]);
    if (!taken) continue;
    for (LocalVertex v : all.tets[t].vertices) {
      if (v >= mesh.vertex_count()) out.used[v - mesh.vertex_count()] = 1;
    }
  }
  return out;
}

}  // namespace mw
