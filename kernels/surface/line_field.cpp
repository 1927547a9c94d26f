// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Counts the labels around the edges of a star, and interpolates along lines.
#include "kernels/surface/line_field.h"

#include <algorithm>

#include "kernels/core/sort_distinct.h"

namespace mw {
namespace {

/// A label around the edge from a vertex to `end`.
struct EdgeLabel {
  LocalVertex end = 0;
  Label label = 0;

  friend auto operator<=>(const EdgeLabel&, const EdgeLabel&) = default;
};

/// Finds the far ends of the edges at v that have three labels around them or more, ascending.
void find_line_edges(const TetMesh& mesh, LocalVertex v, std::vector<EdgeLabel>& around,
                     std::vector<LocalVertex>& ends) {
  around.clear();
  ends.clear();
  for (const LinkTriangle& t : mesh.star(v)) {
    for (const LocalVertex w : {t.a, t.b, t.c}) {
      if (w != mesh.infinity()) around.push_back({w, without_side(t.label)});
    }
  }
  sort_distinct(around);
  for (std::size_t i = 0; i + 2 < around.size(); ++i) {
    const LocalVertex w = around[i].end;
    if (around[i + 2].end == w && (ends.empty() || ends.back() != w)) ends.push_back(w);
  }
}

/// The known vertices of a line around the one that is looked for, which is at 0.
class Curve {
 public:
  /// along: the length of the line from 0, negative on one side.
  void add(const Vec3& place, double along) {
    places_[count_] = place;
    along_[count_++] = along;
  }
  /// Returns the value at 0 of the polynomial through all that were added (Lagrange).
  [[nodiscard]] Vec3 at_zero() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < count_; ++i) {
      double weight = 1.0;
      for (std::size_t j = 0; j < count_; ++j) {
        if (j != i) weight *= along_[j] / (along_[j] - along_[i]);
      }
      sum += weight * places_[i];
    }
    return sum;
  }

 private:
  std::array<Vec3, 4> places_;
  std::array<double, 4> along_{};
  std::size_t count_ = 0;
};

}  // namespace

void LineField::find(const TetMesh& mesh) {
  constexpr int kLabelsOfLine = 3;
  neighbours_.resize(mesh.vertex_count());
  std::vector<EdgeLabel> around;
  std::vector<LocalVertex> ends;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    neighbours_[v] = {v, v};
    if (!mesh.is_alive(v) || !mesh.is_free(v) || mesh.order(v) < kLabelsOfLine) continue;
    find_line_edges(mesh, v, around, ends);
    if (ends.size() == 2) neighbours_[v] = {ends[0], ends[1]};
  }
}

/// Returns the neighbour of v on the other side than `from`.
std::optional<LocalVertex> LineField::beyond(LocalVertex v, LocalVertex from) const {
  if (!has(v)) return std::nullopt;
  return neighbours_[v][neighbours_[v][0] == from ? 1 : 0];
}

std::optional<LinePlace> LineField::place(const TetMesh& mesh, const Metric& metric,
                                          LocalVertex v) const {
  if (!has(v)) return std::nullopt;
  const auto [p, q] = neighbours_[v];
  const std::optional<LocalVertex> before = beyond(p, v), after = beyond(q, v);
  if (!before && !after) return std::nullopt;
  const Point origin = mesh.position(v);
  const auto to = [&](LocalVertex w) { return metric.vector(origin, mesh.position(w)); };
  const Vec3 to_p = to(p), to_q = to(q), way = to_q - to_p;
  const double chord = way.norm(), mean = 0.5 * (to_p.norm() + to_q.norm());
  if (!(chord > 0.0)) return std::nullopt;
  // Lengths count as half the mean at least: the curve would swing out beside a short edge.
  const auto length = [mean](const Vec3& edge) { return std::max(edge.norm(), 0.5 * mean); };
  const double at_p = -length(to_p), at_q = length(to_q);
  Curve curve;
  curve.add(to_p, at_p);
  curve.add(to_q, at_q);
  if (before) curve.add(to(*before), at_p - length(to(*before) - to_p));
  if (after) curve.add(to(*after), at_q + length(to(*after) - to_q));
  return LinePlace{curve.at_zero(), way / chord, mean};
}

}  // namespace mw
