// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The contraction loop: candidates of a vertex, cheapest first, through the filters.
#include "kernels/simplify/simplify.h"

#include <algorithm>
#include <bit>

#include "kernels/mesh/vertex_marks.h"
#include "kernels/simplify/contraction.h"
#include "kernels/simplify/shape_filter.h"
#include "kernels/simplify/vertex_queue.h"
#include "kernels/topology/collapse_test.h"

namespace mw {
namespace {

/// Remembers pairs that failed, until one of them changes.  Direct-mapped and of fixed size: a lost
/// entry costs one more try, and the same one in every run.
class FailedPairs {
 public:
  FailedPairs() : entries_(kSize) {}

  [[nodiscard]] bool contains(const TetMesh& mesh, LocalVertex p, LocalVertex q) const {
    return entries_[slot(p, q)] == entry(mesh, p, q);
  }
  void insert(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
    entries_[slot(p, q)] = entry(mesh, p, q);
  }

 private:
  static constexpr std::size_t kSize = std::size_t{1} << 14;
  struct Entry {
    LocalVertex p = 0, q = 0;
    std::uint32_t version_p = 0, version_q = 0;
    friend bool operator==(const Entry&, const Entry&) = default;
  };

  static std::size_t slot(LocalVertex p, LocalVertex q) {
    const std::uint64_t key = std::uint64_t{std::min(p, q)} << 32 | std::max(p, q);
    return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15ULL >> 50);
  }
  static Entry entry(const TetMesh& mesh, LocalVertex p, LocalVertex q) {
    if (p > q) std::swap(p, q);
    return {p, q, mesh.version(p), mesh.version(q)};
  }

  std::vector<Entry> entries_;
};

class Simplifier {
 public:
  Simplifier(TetMesh& mesh, const Metric& metric, const SimplifyOptions& options,
             DistanceGuard* guard)
      : mesh_(mesh),
        metric_(metric),
        options_(options),
        guard_(guard),
        topology_(mesh, options.topology),
        edge_labels_(mesh.vertex_count() + 1),
        neighbour_marks_(mesh.vertex_count() + 1) {}

  SimplifyStats run() {
    for (LocalVertex v = 0; v < mesh_.vertex_count(); ++v) {
      if (mesh_.is_free(v)) queue_.push(v, 0.0);
    }
    std::vector<LocalVertex> round;
    while (queue_.take_round(round)) {
      for (LocalVertex v : round) {
        if (mesh_.is_alive(v)) visit(v);
      }
    }
    return stats_;
  }

 private:
  /// Edges of v worth trying, cheapest first.  An edge between two vertices that never changed
  /// belongs to its smaller end; the others are looked at from both sides.
  void collect_candidates(LocalVertex v) {
    collect_neighbours(v);
    candidates_.clear();
    for (LocalVertex w : neighbours_) {
      const bool mine = w > v || mesh_.version(v) != 0;
      if (!mine || !mesh_.is_free(w) || !labels_allow(v, w)) continue;
      if (failed_.contains(mesh_, v, w)) continue;
      if (const auto c = plan_contraction(mesh_, metric_, v, w)) candidates_.push_back(*c);
    }
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Contraction& a, const Contraction& b) {
                if (a.cost != b.cost) return a.cost < b.cost;
                const auto ids = [](const Contraction& c) { return std::minmax(c.keep, c.drop); };
                return ids(a) < ids(b);
              });
  }

  void collect_neighbours(LocalVertex v) {
    neighbours_.clear();
    neighbour_marks_.clear();
    for (const LinkTriangle& t : mesh_.star(v)) {
      for (LocalVertex w : {t.a, t.b, t.c}) {
        if (neighbour_marks_.insert(w)) {
          edge_labels_[w] = 0;
          if (w != mesh_.infinity()) neighbours_.push_back(w);
        }
        edge_labels_[w] |= TetMesh::label_bit(t.label);
      }
    }
  }

  /// The part of the topology test that label signatures decide: a label at both ends must lie
  /// around the edge, and an edge inside one label never joins two boundary vertices.  Hash
  /// collisions can only refuse.
  [[nodiscard]] bool labels_allow(LocalVertex v, LocalVertex w) const {
    const std::uint64_t edge = edge_labels_[w];
    if ((mesh_.label_signature(v) & mesh_.label_signature(w) & ~edge) != 0) return false;
    return std::popcount(edge) > 1 || mesh_.order(v) == 1 || mesh_.order(w) == 1;
  }

  void visit(LocalVertex v) {
    collect_candidates(v);
    const double bound = queue_.current_bound();
    for (const Contraction& c : candidates_) {
      if (c.cost > bound) {
        queue_.push(v, c.cost);
        return;
      }
      if (try_contraction(c)) {
        queue_.push(c.keep, 0.0);
        return;
      }
      failed_.insert(mesh_, c.keep, c.drop);
    }
  }

  bool try_contraction(const Contraction& c) {
    ++stats_.tried;
    switch (judge_shape(mesh_, metric_, c, options_)) {
      case ShapeVerdict::kInverted:
        ++stats_.inverted;
        return false;
      case ShapeVerdict::kLowQuality:
        ++stats_.low_quality;
        return false;
      case ShapeVerdict::kGood:
        break;
    }
    const bool both_on_boundaries = mesh_.order(c.keep) > 1 && mesh_.order(c.drop) > 1;
    if (both_on_boundaries && !topology_.keeps_topology(mesh_, c.keep, c.drop)) {
      ++stats_.topology;
      return false;
    }
    const bool guarded = guard_ != nullptr && both_on_boundaries;
    if (guarded && !guard_->allows_contraction(mesh_, c.keep, c.drop, c.position)) {
      ++stats_.distance;
      return false;
    }
    const Quadric quadric = contracted_quadric(mesh_, metric_, c);
    mesh_.contract(c.keep, c.drop, c.position, quadric);
    if (guarded) guard_->commit();
    ++stats_.contracted;
    return true;
  }

  TetMesh& mesh_;
  const Metric& metric_;
  const SimplifyOptions& options_;
  DistanceGuard* guard_;
  VertexQueue queue_;
  CollapseTest topology_;
  FailedPairs failed_;
  std::vector<std::uint64_t> edge_labels_;
  VertexMarks neighbour_marks_;
  std::vector<LocalVertex> neighbours_;
  std::vector<Contraction> candidates_;
  SimplifyStats stats_;
};

}  // namespace

SimplifyStats& SimplifyStats::operator+=(const SimplifyStats& other) {
  tried += other.tried;
  contracted += other.contracted;
  inverted += other.inverted;
  low_quality += other.low_quality;
  topology += other.topology;
  distance += other.distance;
  return *this;
}

SimplifyStats simplify(TetMesh& mesh, const Metric& metric, const SimplifyOptions& options,
                       DistanceGuard* guard) {
  return Simplifier(mesh, metric, options, guard).run();
}

}  // namespace mw
