// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Edge removal by dynamic programming and the 2-3 flip.
#include "kernels/optimise/flips.h"

#include <algorithm>

#include "kernels/quality/mesh_quality.h"

namespace mw {

void Flipper::replace(const std::vector<LocalTet>& old_tets,
                      const std::vector<LocalTet>& new_tets) {
  for (const LocalTet& t : old_tets) mesh_.remove_tet(t);
  for (const LocalTet& t : new_tets) mesh_.add_tet(t);
}

double Flipper::worst_of_ring(LocalVertex p, LocalVertex q) const {
  double worst = 1.0;
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const LocalTet t{{p, q, ring_.vertices[i], ring_.ends[i]}, ring_.labels[i]};
    worst = std::min(worst, radius_ratio(mesh_, metric_, t));
  }
  return worst;
}

double Flipper::triangle_value(LocalVertex p, LocalVertex q, std::size_t i, std::size_t j,
                               std::size_t k) const {
  const LocalVertex a = ring_.vertices[i], b = ring_.vertices[j], c = ring_.vertices[k];
  const double upper = radius_ratio(mesh_, metric_, LocalTet{{a, b, c, q}, 0});
  if (upper <= 0.0) return upper;
  return std::min(upper, radius_ratio(mesh_, metric_, LocalTet{{a, c, b, p}, 0}));
}

double Flipper::best_triangulation(LocalVertex p, LocalVertex q, double enough) {
  const std::size_t n = ring_.size();
  for (std::size_t i = 0; i + 1 < n; ++i) value_[i][i + 1] = 1.0;
  for (std::size_t gap = 2; gap < n; ++gap) {
    for (std::size_t i = 0; i + gap < n; ++i) {
      const std::size_t k = i + gap;
      value_[i][k] = -1.0;
      for (std::size_t j = i + 1; j < k; ++j) {
        const double sides = std::min(value_[i][j], value_[j][k]);
        if (sides <= enough || sides <= value_[i][k]) continue;
        const double v = std::min(sides, triangle_value(p, q, i, j, k));
        if (v > value_[i][k]) {
          value_[i][k] = v;
          apex_[i][k] = j;
        }
      }
    }
  }
  return value_[0][n - 1];
}

bool Flipper::collect_triangles(LocalVertex p, LocalVertex q, std::size_t i, std::size_t k) {
  if (k - i < 2) return true;
  const std::size_t j = apex_[i][k];
  const LocalVertex a = ring_.vertices[i], b = ring_.vertices[j], c = ring_.vertices[k];
  const Label label = ring_.labels[0];
  const LocalTet upper{{a, b, c, q}, label}, lower{{a, c, b, p}, label};
  if (!is_positive(mesh_, upper) || !is_positive(mesh_, lower)) return false;
  new_tets_.push_back(upper);
  new_tets_.push_back(lower);
  return collect_triangles(p, q, i, j) && collect_triangles(p, q, j, k);
}

bool Flipper::remove_edge(LocalVertex p, LocalVertex q) {
  if (!collect_ring(mesh_, p, q, ring_) || ring_.size() > kMaxRing) return false;
  for (Label label : ring_.labels) {
    if (label != ring_.labels[0] || label == kExterior) return false;
  }
  const double enough = worst_of_ring(p, q) + kLeastGain;
  if (best_triangulation(p, q, enough) <= enough) return false;
  new_tets_.clear();
  if (!collect_triangles(p, q, 0, ring_.size() - 1)) return false;
  old_tets_.clear();
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    old_tets_.push_back({{p, q, ring_.vertices[i], ring_.ends[i]}, ring_.labels[i]});
  }
  replace(old_tets_, new_tets_);
  return true;
}

bool Flipper::remove_face(LocalVertex a, LocalVertex b, LocalVertex c, LocalVertex d) {
  const LocalTet* found = nullptr;
  LocalTet beyond;
  Label label = kExterior;
  for (const LinkTriangle& t : mesh_.star(b)) {
    if (!t.has(c) || !t.has(d)) continue;
    if (t.has(a)) {
      label = t.label;
    } else {
      beyond = {{b, t.a, t.b, t.c}, t.label};
      found = &beyond;
    }
  }
  if (found == nullptr || label != beyond.label || label == kExterior) return false;
  LocalVertex e = beyond.vertices[1];
  for (LocalVertex v : beyond.vertices) {
    if (v != b && v != c && v != d) e = v;
  }
  old_tets_.assign({LocalTet{{a, b, c, d}, label}, beyond});
  new_tets_.assign({LocalTet{{e, a, b, d}, label}, LocalTet{{e, a, d, c}, label},
                    LocalTet{{e, a, c, b}, label}});
  double present = 1.0, next = 1.0;
  for (const LocalTet& t : old_tets_) present = std::min(present, radius_ratio(mesh_, metric_, t));
  for (const LocalTet& t : new_tets_) {
    next = std::min(next, radius_ratio(mesh_, metric_, t));
    if (next <= present + kLeastGain) return false;
  }
  for (const LocalTet& t : new_tets_) {
    if (!is_positive(mesh_, t)) return false;
  }
  replace(old_tets_, new_tets_);
  return true;
}

}  // namespace mw
