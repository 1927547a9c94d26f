// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Each pass over the tets finds cavities that share no tet, and then makes a new mesh.
#include "kernels/inner/inner_vertices.h"

#include <algorithm>
#include <set>

#include "kernels/odt/rebuild.h"
#include "kernels/topology/edge_ring.h"

namespace mw {
namespace {

constexpr int kPasses = 2;
/// A cavity that leaves this radius ratio is taken without a look at others.
constexpr double kGoodRatio = 0.45;
/// In this many cavities of a tet a place is searched for.
constexpr std::size_t kSearches = 3;

using TetKey = std::array<LocalVertex, 4>;

TetKey key_of(const LocalTet& tet) {
  TetKey key = tet.vertices;
  std::sort(key.begin(), key.end());
  return key;
}

Point between(Point a, Point b) {
  return {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2, a.z + (b.z - a.z) / 2};
}

/// One pass, which reads the mesh and collects what is to be replaced.
class Pass {
 public:
  Pass(const TetMesh& mesh, const Metric& metric, const InnerDemand& demand,
       const InnerOptions& options)
      : mesh_(mesh), metric_(metric), demand_(demand), options_(options) {}

  void run() {
    for (const LocalTet& tet : mesh_.tets()) {
      if (!lacks_inner(tet) || gone_.contains(key_of(tet)) || waits(tet)) continue;
      choices_.clear();
      try_edges(tet);
      try_triangles(tet);
      choose();
    }
  }

  [[nodiscard]] const std::vector<Point>& added() const { return added_; }

  /// All tets; rows of added vertices follow those of the mesh.
  [[nodiscard]] std::vector<LocalTet> tets() const {
    std::vector<LocalTet> out = mesh_.tets();
    std::erase_if(out, [&](const LocalTet& t) { return gone_.contains(key_of(t)); });
    out.insert(out.end(), made_.begin(), made_.end());
    return out;
  }

 private:
  struct Choice {
    Cavity cavity;
    CavityPosition found;
  };

  [[nodiscard]] bool lacks_inner(const LocalTet& tet) const {
    return demand_.wants(tet.label) &&
           std::all_of(tet.vertices.begin(), tet.vertices.end(),
                       [&](LocalVertex v) { return is_surely_on_boundary(mesh_, v); });
  }
  /// True if a later call sees all that this one sees of the tet.
  [[nodiscard]] bool waits(const LocalTet& tet) const {
    return std::any_of(options_.later.begin(), options_.later.end(), [&](const LatticeBox& box) {
      return std::all_of(tet.vertices.begin(), tet.vertices.end(),
                         [&](LocalVertex v) { return has_star_inside(v, box); });
    });
  }

  [[nodiscard]] bool has_star_inside(LocalVertex v, const LatticeBox& box) const {
    const auto is_inside = [&](LocalVertex w) {
      if (w == mesh_.infinity()) return true;
      const Point p = mesh_.position(w);
      return p.x >= box.lo.x && p.y >= box.lo.y && p.z >= box.lo.z && p.x <= box.hi.x &&
             p.y <= box.hi.y && p.z <= box.hi.z;
    };
    const auto star = mesh_.star(v);
    return std::all_of(star.begin(), star.end(), [&](const LinkTriangle& t) {
      return is_inside(t.a) && is_inside(t.b) && is_inside(t.c);
    });
  }

  void offer(std::vector<LocalTet> tets, Point start) {
    const auto is_gone = [&](const LocalTet& t) { return gone_.contains(key_of(t)); };
    if (std::any_of(tets.begin(), tets.end(), is_gone)) return;
    Cavity cavity(mesh_, metric_, std::move(tets));
    const std::optional<CavityPosition> position = cavity.first_position(start);
    if (position) choices_.push_back({std::move(cavity), *position});
  }

  /// Searches for better places in the cavities that begin best, and takes the best of them.
  void choose() {
    std::vector<Choice*> order;
    for (Choice& c : choices_) order.push_back(&c);
    std::stable_sort(order.begin(), order.end(), [](const Choice* a, const Choice* b) {
      return a->found.worst > b->found.worst;
    });
    order.resize(std::min(order.size(), kSearches));
    Choice* best = nullptr;
    for (Choice* const c : order) {
      const auto position = c->cavity.best_position(c->found, options_.limits);
      if (!position || (best != nullptr && position->worst <= best->found.worst)) continue;
      best = c;
      best->found = *position;
      if (position->worst >= kGoodRatio) break;
    }
    if (best != nullptr) take(*best);
  }

  void try_edges(const LocalTet& tet) {
    const auto& v = tet.vertices;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        if (!collect_ring(mesh_, v[i], v[j], ring_)) continue;
        const bool inside = std::all_of(ring_.labels.begin(), ring_.labels.end(),
                                        [&](Label label) { return label == tet.label; });
        if (!inside) continue;
        std::vector<LocalTet> tets;
        for (std::size_t k = 0; k < ring_.size(); ++k) {
          tets.push_back({{v[i], v[j], ring_.vertices[k], ring_.ends[k]}, tet.label});
        }
        offer(std::move(tets), between(mesh_.position(v[i]), mesh_.position(v[j])));
      }
    }
  }

  /// The tet with each of its neighbours of the same label, with all of them, and alone.
  void try_triangles(const LocalTet& tet) {
    std::vector<LocalTet> all{tet};
    for (int corner = 0; corner < 4; ++corner) {
      const std::optional<LocalTet> beyond = neighbour(tet, corner);
      if (!beyond || beyond->label != tet.label) continue;
      all.push_back(*beyond);
      const LinkTriangle f = link_triangle(tet, corner);
      const Point a = mesh_.position(f.a), b = mesh_.position(f.b), c = mesh_.position(f.c);
      offer({tet, *beyond}, third_of(a, b, c));
    }
    const auto& v = tet.vertices;
    const Point middle = between(between(mesh_.position(v[0]), mesh_.position(v[1])),
                                 between(mesh_.position(v[2]), mesh_.position(v[3])));
    if (all.size() > 2) offer(all, middle);
    offer({tet}, middle);
  }

  static Point third_of(Point a, Point b, Point c) {
    const auto third = [](std::int32_t u, std::int32_t v, std::int32_t w) {
      return static_cast<std::int32_t>((std::int64_t{u} + v + w) / 3);
    };
    return {third(a.x, b.x, c.x), third(a.y, b.y, c.y), third(a.z, b.z, c.z)};
  }

  /// The tet beyond the triangle opposite a corner, if it is loaded.
  [[nodiscard]] std::optional<LocalTet> neighbour(const LocalTet& tet, int corner) const {
    const LinkTriangle f = link_triangle(tet, corner);
    const LocalVertex here = tet.vertices[static_cast<std::size_t>(corner)];
    for (const LinkTriangle& t : mesh_.star(f.a)) {
      if (t.label == kExterior || t.has(here) || !t.has(f.b) || !t.has(f.c)) continue;
      return LocalTet{{f.a, t.a, t.b, t.c}, t.label};
    }
    return std::nullopt;
  }

  void take(const Choice& choice) {
    const auto row = mesh_.vertex_count() + static_cast<LocalVertex>(added_.size());
    added_.push_back(choice.found.position);
    for (const LocalTet& t : choice.cavity.tets()) gone_.insert(key_of(t));
    const std::vector<LocalTet> around = choice.cavity.tets_around(row);
    made_.insert(made_.end(), around.begin(), around.end());
  }

  const TetMesh& mesh_;
  const Metric& metric_;
  const InnerDemand& demand_;
  const InnerOptions& options_;
  EdgeRing ring_;
  std::vector<Choice> choices_;  ///< for the tet at hand
  std::set<TetKey> gone_;
  std::vector<Point> added_;
  std::vector<LocalTet> made_;
};

}  // namespace

// More than five parameters: those of codt(), with a demand for its triangulation.
std::uint64_t add_inner_vertices(TetMesh& mesh, CarriedSamples& samples, Point box,
                                 const Metric& metric, const InnerDemand& demand,
                                 const InnerOptions& options) {
  if (mesh.vertex_count() == 0) return 0;
  // Canonical order makes the result independent of what was done to the mesh.
  rebuild(mesh, samples, mesh.tets(), {}, box);
  std::uint64_t given = 0;
  for (int i = 0; i < kPasses; ++i) {
    Pass pass(mesh, metric, demand, options);
    pass.run();
    if (pass.added().empty() || pass.added().size() > options.ids.count - given) break;
    std::vector<BlockVertex> added;
    for (const Point p : pass.added()) {
      added.push_back({options.ids.first + given++, p, {}});
      added.back().quadric.add_point(1.0);
    }
    rebuild(mesh, samples, pass.tets(), added, box);
  }
  return given;
}

}  // namespace mw
