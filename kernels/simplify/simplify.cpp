// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The contraction loop: candidates of a vertex, cheapest first, through the filters.
#include "kernels/simplify/simplify.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "kernels/mesh/failed_pairs.h"
#include "kernels/mesh/star_boxes.h"
#include "kernels/mesh/tet_mesh.h"
#include "kernels/simplify/contraction.h"
#include "kernels/simplify/contraction_filters.h"
#include "kernels/simplify/vertex_queue.h"
#include "kernels/size/edge_limits.h"
#include "kernels/surface/line_edges.h"
#include "kernels/topology/link_condition.h"

namespace mw {
namespace {

/// Finds the edges of a vertex that are worth trying.  Only reads the mesh; the scratch is its own,
/// so several may be at work on one mesh.
class CandidateFinder {
 public:
  CandidateFinder(const TetMesh& mesh, const Metric& metric, const FinishedVertices& finished)
      : mesh_(mesh),
        metric_(metric),
        finished_(finished),
        failed_(mesh.vertex_count()),
        seen_(mesh.vertex_count() + 1) {}

  /// Returns the candidates of v, valid until the next call.  An edge between two vertices that
  /// never changed belongs to its smaller end that is not finished; the others are looked at from
  /// both sides.
  const std::vector<Contraction>& collect(LocalVertex v) {
    collect_neighbours(v);
    candidates_.clear();
    taken_ = 0;
    for (LocalVertex w : neighbours_) {
      const bool mine = w > v || mesh_.version(v) != 0 || finished_.has(w);
      if (!mine || !mesh_.is_free(w) || !labels_allow(v, w)) continue;
      if (failed_.contains(mesh_, v, w)) continue;
      if (const auto c = plan_contraction(mesh_, metric_, v, w)) candidates_.push_back(*c);
    }
    return candidates_;
  }

  /// Returns the cheapest of what was collected last and not yet taken; null where all were taken.
  /// (Most vertices try few of their candidates, so all of them are not sorted.)
  const Contraction* take_cheapest() {
    if (taken_ == candidates_.size()) return nullptr;
    const auto next = candidates_.begin() + static_cast<std::ptrdiff_t>(taken_++);
    std::iter_swap(next, std::min_element(next, candidates_.end(), is_cheaper));
    return &*next;
  }

  /// Makes collect() leave out the edge until one of its ends changes.
  void forget(const Contraction& c) { failed_.insert(mesh_, c.keep, c.drop); }

 private:
  /// The last call that met a vertex, and the labels around the edge to it.
  struct Seen {
    std::uint64_t labels = 0;
    std::uint32_t call = 0;
  };

  static bool is_cheaper(const Contraction& a, const Contraction& b) {
    if (a.cost != b.cost) return a.cost < b.cost;
    const auto ids = [](const Contraction& c) { return std::minmax(c.keep, c.drop); };
    return ids(a) < ids(b);
  }

  void collect_neighbours(LocalVertex v) {
    neighbours_.clear();
    ++call_;
    Label label = kExterior;
    std::uint64_t bit = mesh_.label_bit(label);
    for (const LinkTriangle& t : mesh_.star(v)) {
      if (t.label != label) {
        label = t.label;
        bit = mesh_.label_bit(label);
      }
      for (LocalVertex w : {t.a, t.b, t.c}) {
        Seen& seen = seen_[w];
        if (seen.call == call_) {
          seen.labels |= bit;
          continue;
        }
        seen = {bit, call_};
        if (w != mesh_.infinity()) neighbours_.push_back(w);
      }
    }
  }

  /// Does the part of the topology test that label signatures decide: a label at both ends must lie
  /// around the edge, and an edge inside one label never joins two boundary vertices.  Labels that
  /// share a bit may cause a needless refusal; what passes is tested in full later.
  [[nodiscard]] bool labels_allow(LocalVertex v, LocalVertex w) const {
    const std::uint64_t edge = seen_[w].labels;
    if ((mesh_.label_signature(v) & mesh_.label_signature(w) & ~edge) != 0) return false;
    const bool several = (edge & (edge - 1)) != 0 || mesh_.is_in_inner_plane(v, w);
    return several || mesh_.order(v) == 1 || mesh_.order(w) == 1;
  }

  const TetMesh& mesh_;
  const Metric& metric_;
  const FinishedVertices& finished_;
  FailedPairs failed_;
  std::vector<Seen> seen_;
  std::uint32_t call_ = 0;
  std::vector<LocalVertex> neighbours_;
  std::vector<Contraction> candidates_;
  std::size_t taken_ = 0;  ///< how many of them were taken; these come first
};

/// REQUIRES: not empty.
double least_cost(const std::vector<Contraction>& candidates) {
  return std::min_element(
             candidates.begin(), candidates.end(),
             [](const Contraction& a, const Contraction& b) { return a.cost < b.cost; })
      ->cost;
}

/// Files the vertex under the cost of its cheapest candidate.
void push_cheapest(CandidateFinder& finder, LocalVertex v, VertexQueue& queue) {
  const std::vector<Contraction>& candidates = finder.collect(v);
  if (!candidates.empty()) queue.push(v, least_cost(candidates));
}

/// Are edges contracted up to sizes, and not down to a number of vertices?
bool is_sized(const SimplifyOptions& options) {
  return options.demands.sizes != nullptr && options.enough_vertices == 0;
}

/// What an edge is contracted for: its cost, or for the sake of a line of three labels.
enum class Aim { kCost, kTouch, kShortLine };

/// Vertices that are to be looked at again, each once, in the order in which they came.
class WaitingVertices {
 public:
  explicit WaitingVertices(std::size_t vertices) : waits_(vertices, 0) {}

  [[nodiscard]] bool has(LocalVertex v) const { return v < waits_.size() && waits_[v] != 0; }
  /// REQUIRES: v is less than the number of vertices.
  void add(LocalVertex v) {
    if (waits_[v] == 0) list_.push_back(v);
    waits_[v] = 1;
  }
  /// Returns all that wait, after which none does.
  [[nodiscard]] std::vector<LocalVertex> take() {
    for (const LocalVertex v : list_) waits_[v] = 0;
    return std::exchange(list_, {});
  }

 private:
  std::vector<std::uint8_t> waits_;
  std::vector<LocalVertex> list_;
};

class Simplifier {
 public:
  Simplifier(TetMesh& mesh, const Metric& metric, const SimplifyOptions& options,
             DistanceGuard* guard)
      : mesh_(mesh),
        metric_(metric),
        options_(options),
        guard_(guard),
        queue_(mesh.vertex_count()),
        finished_(mesh, options.finished),
        finder_(mesh, metric, finished_),
        shape_(mesh, metric, options),
        limits_(mesh, metric, options.demands.sizes),
        limits_of_lines_(EdgeLimits::of_moves(mesh, metric, options.demands.sizes)),
        failed_on_lines_(is_sized(options) ? mesh.vertex_count() / 4 : 0),
        touches_(is_sized(options) ? mesh.vertex_count() : 0),
        inner_(mesh, options.demands.inner),
        topology_(mesh, options.topology),
        topology_on_box_(mesh, KeptTopology::kInterfaces),
        topology_across_(mesh, options.topology, LinkCondition::Sides::kTogether),
        topology_of_sides_(mesh, options.topology),
        bends_(mesh, metric, guard == nullptr ? nullptr : &guard->labels()) {}

  SimplifyStats run() {
    if (is_sized(options_)) contract_on_lines(Aim::kTouch);
    options_.seeding(mesh_.vertex_count(), [this](std::size_t first, std::size_t last) {
      CandidateFinder scout(mesh_, metric_, finished_);
      for (auto v = static_cast<LocalVertex>(first); v < last; ++v) {
        if (mesh_.is_free(v) && !finished_.has(v)) push_cheapest(scout, v, queue_);
      }
    });
    std::vector<LocalVertex> round;
    while (queue_.take_round(round)) {
      for (const LocalVertex v : touches_.take()) contract_line_edges(v, Aim::kTouch);
      for (LocalVertex v : round) {
        const std::size_t left = mesh_.vertex_count() - stats_.contracted;
        if (left <= options_.enough_vertices) return stats_;
        if (mesh_.is_alive(v)) visit(v);
      }
    }
    if (is_sized(options_)) contract_on_lines(Aim::kShortLine);
    return stats_;
  }

 private:
  void visit(LocalVertex v) {
    const double bound = queue_.current_bound();
    const std::vector<Contraction>& candidates = finder_.collect(v);
    if (candidates.empty()) return;
    if (const double least = least_cost(candidates); least > bound) {
      queue_.push(v, least);
      return;
    }
    while (const Contraction* const c = finder_.take_cheapest()) {
      if (c->cost > bound) {
        queue_.push(v, c->cost);
        return;
      }
      if (try_contraction(*c)) {
        queue_.push(c->keep, 0.0);
        return;
      }
      finder_.forget(*c);
    }
  }

  /// Contracts all line edges (LineEdges) that are touches, or that are short, wherever that leaves
  /// good tets, at any cost.  Touches come before all else, because edges around them are short at
  /// first, and limits would refuse longer ones later; those that fail are tried again at each
  /// round, if one of their ends has changed.  Short edges come last, as they are what shapes have
  /// refused so far.
  void contract_on_lines(Aim aim) {
    for (LocalVertex v = 0; v < mesh_.vertex_count(); ++v) contract_line_edges(v, aim);
  }

  void contract_line_edges(LocalVertex v, Aim aim) {
    aim_ = aim;
    while (mesh_.is_alive(v) && mesh_.is_free(v) && contract_line_edge(v)) {
    }
    aim_ = Aim::kCost;
  }

  bool contract_line_edge(LocalVertex v) {
    if (mesh_.order(v) < kLabelsOfLine) return false;
    const std::span<const LocalVertex> found = lines_.at(mesh_, v);
    line_ends_.assign(found.begin(), found.end());
    return std::any_of(line_ends_.begin(), line_ends_.end(),
                       [&](LocalVertex w) { return try_line_edge(v, w); });
  }

  bool try_line_edge(LocalVertex v, LocalVertex w) {
    if (!mesh_.is_free(w) || (finished_.has(v) && finished_.has(w))) return false;
    const bool is_touch = aim_ == Aim::kTouch;
    if (is_touch ? !lines_.is_touch(mesh_, v, w) : !limits_.is_short(v, w)) return false;
    if (is_touch) touches_.add(v);
    if (failed_on_lines_.contains(mesh_, v, w)) return false;
    const std::optional<Contraction> c = plan_contraction(mesh_, metric_, v, w);
    // Of touches that stay most do so for their topology, which is asked before many places are.
    if (c && keeps_topology(*c) && try_contraction(*c)) return true;
    failed_on_lines_.insert(mesh_, v, w);
    return false;
  }

  /// The most that a place may cost.
  [[nodiscard]] double bound() const {
    return aim_ == Aim::kCost ? queue_.current_bound() : std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] bool keeps_lengths(const Contraction& c) const {
    const EdgeLimits& limits = aim_ == Aim::kCost ? limits_ : limits_of_lines_;
    return limits.allow_star(c.drop, c.keep, c.position) &&
           (!c.moves || limits.allow_star(c.keep, c.drop, c.position));
  }

  /// The verdict on edges and tets at the place of c alone.
  StarVerdict judge_junction(const Contraction& c) {
    return keeps_lengths(c) ? shape_.judge(c) : StarVerdict::kTooLong;
  }

  /// Junctions leave their places only where bends tell whether that is good.
  [[nodiscard]] bool may_go_elsewhere(const Contraction& c) const {
    return c.has_others && (c.moves || options_.keep_smooth);
  }

  /// Returns the verdict on the planned place.  When that is refused, c becomes the first of its
  /// other places that is good and as cheap as this round demands.  With the paper's filter, which
  /// goes with the paper's place, no others are tried.
  StarVerdict judge(Contraction& c) {
    const StarVerdict verdict = judge_junction(c);
    if (verdict == StarVerdict::kGood || !may_go_elsewhere(c) || options_.edge_variance) {
      return verdict;
    }
    for (const Contraction& other : other_positions(mesh_, metric_, c)) {
      if (other.cost > bound()) continue;
      if (judge_junction(other) != StarVerdict::kGood) continue;
      c = other;
      return StarVerdict::kGood;
    }
    if (aim_ != Aim::kTouch) return verdict;
    for (const Contraction& other : positions_around(mesh_, metric_, c)) {
      if (judge_junction(other) != StarVerdict::kGood) continue;
      c = other;
      return StarVerdict::kGood;
    }
    return verdict;
  }

  /// True when c leaves no fold at its place, or at another good one, which c then takes.
  bool find_smooth_position(Contraction& c) {
    if (bends_.stays_smooth(c)) return true;
    if (!may_go_elsewhere(c)) return false;
    for (const Contraction& other : other_positions(mesh_, metric_, c)) {
      if (other.position == c.position || other.cost > bound()) continue;
      if (!bends_.stays_smooth(other) || judge_junction(other) != StarVerdict::kGood) continue;
      c = other;
      return true;
    }
    return false;
  }

  /// REQUIRES: both ends are on boundaries; with keep_smooth, the bends of c were judged.
  bool keeps_distance(const Contraction& c) {
    if (!options_.keep_smooth) {
      return guard_->allows_contraction(mesh_, c.keep, c.drop, c.position);
    }
    return guard_->allows_contraction(mesh_, c.keep, c.drop, c.position, bends_.fan(c.keep),
                                      bends_.fan(c.drop));
  }

  /// On the box interfaces are kept in any case: a thin layer that ends there would else be pinched
  /// off at its end, which the topology of its label allows.  In a plane that the mesh goes
  /// through, both the labels and their parts on either side are kept.
  bool keeps_topology(const Contraction& c) {
    const unsigned planes = mesh_.planes(c.keep) | mesh_.planes(c.drop);
    const unsigned inner = planes & mesh_.inner_planes();
    if (planes != inner && !topology_on_box_.keeps_topology(mesh_, c.keep, c.drop)) return false;
    if (inner != 0) {
      return topology_across_.keeps_topology(mesh_, c.keep, c.drop) &&
             topology_of_sides_.keeps_topology(mesh_, c.keep, c.drop);
    }
    return planes != 0 || topology_.keeps_topology(mesh_, c.keep, c.drop);
  }

  bool try_contraction(Contraction c) {
    ++stats_.tried;
    if (options_.only_short && aim_ == Aim::kCost && !limits_.is_short(c.keep, c.drop))
      return false;
    if (!inner_.allows_contraction(c.keep, c.drop)) {
      ++stats_.no_inner;
      return false;
    }
    switch (judge(c)) {
      case StarVerdict::kInverted:
        ++stats_.inverted;
        return false;
      case StarVerdict::kLowQuality:
        ++stats_.low_quality;
        return false;
      case StarVerdict::kTooLong:
        ++stats_.too_long;
        return false;
      case StarVerdict::kGood:
        break;
    }
    const bool both_on_boundaries = mesh_.order(c.keep) > 1 && mesh_.order(c.drop) > 1;
    if (both_on_boundaries && !keeps_topology(c)) {
      ++stats_.topology;
      return false;
    }
    if (both_on_boundaries && options_.keep_smooth && !find_smooth_position(c)) {
      ++stats_.folded;
      return false;
    }
    const bool guarded = guard_ != nullptr && both_on_boundaries;
    if (guarded && !keeps_distance(c)) {
      ++stats_.distance;
      return false;
    }
    const Quadric quadric = contracted_quadric(mesh_, metric_, c);
    mesh_.contract(c.keep, c.drop, c.position, quadric);
    if (guarded) guard_->commit();
    if (touches_.has(c.drop)) touches_.add(c.keep);
    ++stats_.contracted;
    return true;
  }

  TetMesh& mesh_;
  const Metric& metric_;
  const SimplifyOptions& options_;
  DistanceGuard* guard_;
  VertexQueue queue_;
  FinishedVertices finished_;
  CandidateFinder finder_;
  ShapeFilter shape_;
  EdgeLimits limits_, limits_of_lines_;
  Aim aim_ = Aim::kCost;
  LineEdges lines_;
  std::vector<LocalVertex> line_ends_;
  FailedPairs failed_on_lines_;
  WaitingVertices touches_;
  InnerFilter inner_;
  LinkCondition topology_;
  LinkCondition topology_on_box_;
  LinkCondition topology_across_, topology_of_sides_;
  BendFilter bends_;
  SimplifyStats stats_;
};

}  // namespace

SimplifyStats& SimplifyStats::operator+=(const SimplifyStats& other) {
  tried += other.tried;
  contracted += other.contracted;
  inverted += other.inverted;
  low_quality += other.low_quality;
  too_long += other.too_long;
  no_inner += other.no_inner;
  topology += other.topology;
  folded += other.folded;
  distance += other.distance;
  return *this;
}

SimplifyStats simplify(TetMesh& mesh, const Metric& metric, const SimplifyOptions& options,
                       DistanceGuard* guard) {
  SimplifyStats stats = Simplifier(mesh, metric, options, guard).run();
  if (!is_sized(options) || options.inner_quality <= options.quality_floor) return stats;
  SimplifyOptions rest = options;
  rest.inner_quality = options.quality_floor;
  rest.only_short = true;
  stats += Simplifier(mesh, metric, rest, guard).run();
  return stats;
}

}  // namespace mw
