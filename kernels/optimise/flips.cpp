// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Edge removal by dynamic programming.
#include "kernels/optimise/flips.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "kernels/quality/quality.h"
#include "kernels/quality/star_batch.h"

namespace mw {

void Flipper::replace() {
  for (const LocalTet& t : old_tets_) mesh_.remove_tet(t);
  for (const LocalTet& t : new_tets_) mesh_.add_tet(t);
}

/// Also sets the radius ratio that new tets must reach, by the worst old one and `decent`.
double Flipper::energy_of_old_tets(double decent) {
  double worst = 1.0, sum = 0.0;
  TetLanes group;
  std::size_t used = 0;
  const auto add_group = [&] {
    const StoredLanes ratios = radius_ratios(group, metric_);
    for (std::size_t k = 0; k < used; ++k) {
      worst = std::min(worst, ratios[k]);
      sum += shape_energy(ratios[k], 0.0);
    }
    used = 0;
  };
  for (const LocalTet& t : old_tets_) {
    if (t.label == kExterior) continue;
    const auto& v = t.vertices;
    group.set(used++, mesh_.position(v[0]), mesh_.position(v[1]), mesh_.position(v[2]),
              mesh_.position(v[3]));
    if (used == kLanes) add_group();
  }
  if (used != 0) add_group();
  min_ = min_allowed(worst, decent, quality_floor_);
  return sum;
}

double Flipper::min_energy_worth_trying() const {
  constexpr double kForEachNewTet = 1.3;
  std::size_t tets = 0;
  for (const Polygon& polygon : polygons_) {
    if (polygon.label != kExterior) tets += 2 * (polygon.last - polygon.first - 1);
  }
  return kForEachNewTet * static_cast<double>(tets);
}

/// Adds to each triangle that is tried the energies of its tets, four tets at a time.
void Flipper::add_energies(LocalVertex p, LocalVertex q) {
  constexpr std::size_t kTogether = kLanes / 2;
  for (std::size_t first = 0; first < tried_.size(); first += kTogether) {
    const auto some = std::span(tried_).subspan(first, std::min(kTogether, tried_.size() - first));
    TetLanes tets;
    for (std::size_t t = 0; t < some.size(); ++t) {
      const auto at = [&](std::size_t i) { return mesh_.position(ring_vertex(i)); };
      const Point a = at(some[t].i), b = at(some[t].j), c = at(some[t].k);
      tets.set(2 * t, a, b, c, mesh_.position(q));
      tets.set(2 * t + 1, a, c, b, mesh_.position(p));
    }
    const StoredLanes ratios = radius_ratios(tets, metric_);
    for (std::size_t t = 0; t < some.size(); ++t) {
      some[t].energy += shape_energy(ratios[2 * t], min_);
      some[t].energy += shape_energy(ratios[2 * t + 1], min_);
    }
  }
}

double Flipper::best_triangulation(LocalVertex p, LocalVertex q, const Polygon& polygon,
                                   double limit) {
  constexpr double kMinOfTriangle = 2.0;  // two regular tets
  const auto [first, last, label] = polygon;
  for (std::size_t i = first; i < last; ++i) energy_[i][i + 1] = 0.0;
  for (std::size_t gap = 2; gap <= last - first; ++gap) {
    const double elsewhere = kMinOfTriangle * static_cast<double>(last - first - gap);
    const double max = limit - (label == kExterior ? 0.0 : elsewhere);
    tried_.clear();
    for (std::size_t i = first, k = i + gap; k <= last; ++i, ++k) {
      energy_[i][k] = std::numeric_limits<double>::infinity();
      for (std::size_t j = i + 1; j < k; ++j) {
        const double energy = energy_[i][j] + energy_[j][k];
        if (energy < max) tried_.push_back({i, j, k, energy});
      }
    }
    if (label != kExterior) add_energies(p, q);
    for (const auto& [i, j, k, energy] : tried_) {
      if (energy >= max || energy >= energy_[i][k]) continue;
      energy_[i][k] = energy;
      apex_[i][k] = j;
    }
  }
  return energy_[first][last];
}

bool Flipper::collect_triangles(LocalVertex p, LocalVertex q, const Polygon& polygon) {
  const auto [i, k, label] = polygon;
  if (k - i < 2) return true;
  const std::size_t j = apex_[i][k];
  const LocalVertex a = ring_vertex(i), b = ring_vertex(j), c = ring_vertex(k);
  const LocalTet upper{{a, b, c, q}, label}, lower{{a, c, b, p}, label};
  if (label != kExterior && (!is_positive(mesh_, upper) || !is_positive(mesh_, lower))) {
    return false;
  }
  new_tets_.push_back(upper);
  new_tets_.push_back(lower);
  return collect_triangles(p, q, {i, j, label}) && collect_triangles(p, q, {j, k, label});
}

/// Makes one polygon when all tets of the ring bear one label, and two when there are two labels,
/// each on one stretch.  Turns the ring so that the first stretch starts it.
bool Flipper::cut_into_polygons() {
  polygons_.clear();
  const std::size_t n = ring_.size();
  std::vector<Label>& labels = ring_.labels;
  std::size_t start = 0, changes = 0;
  Label before = labels[n - 1];
  for (std::size_t i = 0; i < n; ++i) {
    const bool changed = labels[i] != std::exchange(before, labels[i]);
    if (!changed) continue;
    start = i;
    ++changes;
  }
  if (changes == 0) {
    polygons_.push_back({0, n - 1, labels[0]});
    return labels[0] != kExterior;
  }
  if (changes != 2) return false;
  const auto turn = [start](auto& v) {
    std::rotate(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(start), v.end());
  };
  turn(ring_.vertices);
  turn(ring_.ends);
  turn(labels);
  const auto stretch = static_cast<std::size_t>(
      std::find(labels.begin(), labels.end(), labels[n - 1]) - labels.begin());
  polygons_.push_back({0, stretch, labels[0]});
  polygons_.push_back({stretch, n, labels[n - 1]});
  return true;
}

bool Flipper::has_cap() const {
  return std::any_of(polygons_.begin(), polygons_.end(),
                     [](const Polygon& polygon) { return polygon.is_cap(); });
}

/// True if all tets at edge (p, q) are loaded and have this label.
bool Flipper::has_only(LocalVertex p, LocalVertex q, Label label) {
  return collect_ring(mesh_, p, q, other_ring_) &&
         std::all_of(other_ring_.labels.begin(), other_ring_.labels.end(),
                     [label](Label other) { return other == label; });
}

bool Flipper::surface_allows(LocalVertex p, LocalVertex q) {
  if (polygons_.size() == 1) return true;
  for (const Polygon& cap : polygons_) {
    if (!cap.is_cap()) continue;
    if (!has_only(ring_vertex(cap.first), ring_vertex(cap.last), cap.label)) return false;
  }
  const std::array<LocalVertex, 2> ab{ring_vertex(0), ring_vertex(polygons_[1].first)};
  const Label first = polygons_[0].label, second = polygons_[1].label;
  const bool in_plane =
      (mesh_.planes(p) & mesh_.planes(q) & mesh_.planes(ab[0]) & mesh_.planes(ab[1])) != 0;
  if (first == kExterior || second == kExterior) return in_plane;
  if (on_side_of(first, second) != second && !in_plane) return false;
  // The new tets of the first polygon are (a, ., b, q) and (a, b, ., p).
  if (guard_ == nullptr || !is_between_labels()) return true;
  const std::array<TriangleKey, 2> old{triangle_key(p, q, ab[0]), triangle_key(p, q, ab[1])};
  const std::array<FlippedTriangle, 2> fresh{{{ab[1], ab[0], p}, {ab[0], ab[1], q}}};
  return guard_->allows_flip(mesh_, old, fresh, first, second);
}

bool Flipper::is_between_labels() const {
  return polygons_.size() == 2 && polygons_[0].label != kExterior &&
         polygons_[1].label != kExterior &&
         without_side(polygons_[0].label) != without_side(polygons_[1].label);
}

bool Flipper::collect_polygons(LocalVertex p, LocalVertex q, std::size_t max_ring) {
  if (!collect_ring(mesh_, p, q, ring_) || ring_.size() > max_ring) return false;
  if (!cut_into_polygons()) return false;
  old_tets_.clear();
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    old_tets_.push_back({{p, q, ring_.vertices[i], ring_.ends[i]}, ring_.labels[i]});
  }
  return true;
}

bool Flipper::replace_within(LocalVertex p, LocalVertex q, double budget) {
  new_tets_.clear();
  for (const Polygon& polygon : polygons_) {
    budget -= best_triangulation(p, q, polygon, budget - kMinGain);
    if (!(budget > kMinGain) || !collect_triangles(p, q, polygon)) return false;
  }
  const auto keeps_lengths = [&](const LocalTet& t) { return limits_.allow_tet(t); };
  if (!std::all_of(new_tets_.begin(), new_tets_.end(), keeps_lengths)) return false;
  if (!inner_.allows_replacement(old_tets_, new_tets_) || !surface_allows(p, q)) return false;
  replace();
  if (guard_ != nullptr && is_between_labels()) guard_->commit();
  return true;
}

bool Flipper::remove_edge(LocalVertex p, LocalVertex q) {
  if (mesh_.star(q).size() < mesh_.star(p).size()) std::swap(p, q);
  if (!collect_polygons(p, q, kMaxRing) || has_cap()) return false;
  const double energy = energy_of_old_tets(kDecentRatio);
  return energy - min_energy_worth_trying() > kMinGain && replace_within(p, q, energy);
}

bool Flipper::flip_surface(LocalVertex p, LocalVertex q, double surface_gain) {
  if (mesh_.star(q).size() < mesh_.star(p).size()) std::swap(p, q);
  if (!collect_polygons(p, q, kMaxSurfaceRing) || !is_between_labels()) return false;
  return replace_within(p, q, energy_of_old_tets(kFloorOnSurface) + surface_gain);
}

std::span<const LinkTriangle> Flipper::find_dimple(LocalVertex v,
                                                   std::span<const FanTriangle> fan) {
  dimple_.clear();
  if (fan.size() > kMostInDimple + 2) return {};
  const auto star = mesh_.star(v);
  const auto is_low = [low = fan[0].low](const LinkTriangle& t) {
    return without_side(t.label) == low;
  };
  const auto low_tets = static_cast<std::size_t>(std::count_if(star.begin(), star.end(), is_low));
  const std::size_t few = std::min(low_tets, star.size() - low_tets);
  if (few + 2 != fan.size()) return {};
  for (const LinkTriangle& t : star) {
    if (is_low(t) == (few == low_tets)) dimple_.push_back(t);
  }
  const auto is_in_fan = [fan](LocalVertex w) {
    return std::any_of(fan.begin(), fan.end(),
                       [w](const FanTriangle& t) { return t.a == w || t.b == w; });
  };
  // Without a vertex between them, n - 2 triangles across from n of the interface are one disc.
  const bool may_go = std::all_of(dimple_.begin(), dimple_.end(), [&](const LinkTriangle& t) {
    return is_in_fan(t.a) && is_in_fan(t.b) && is_in_fan(t.c) && goes_on_beyond(v, t);
  });
  if (!may_go) dimple_.clear();
  return dimple_;
}

/// True if the label of a tet at v goes on across its triangle, and around each edge that the
/// triangle shares with another one of the dimple.
bool Flipper::goes_on_beyond(LocalVertex v, const LinkTriangle& t) {
  const auto beyond = mesh_.star(t.a);
  const bool is_across = std::any_of(beyond.begin(), beyond.end(), [&](const LinkTriangle& u) {
    return u.label == t.label && u.has(t.b) && u.has(t.c) && !u.has(v);
  });
  const auto is_inside = [&](LocalVertex p, LocalVertex q) {
    const auto has_edge = [&](const LinkTriangle& u) { return u.has(p) && u.has(q); };
    return std::count_if(dimple_.begin(), dimple_.end(), has_edge) == 1 || has_only(p, q, t.label);
  };
  return is_across && is_inside(t.a, t.b) && is_inside(t.b, t.c) && is_inside(t.c, t.a);
}

bool Flipper::flip_dimple(LocalVertex v, std::span<const FanTriangle> fan) {
  const Label sided = dimple_[0].label, label = without_side(sided);
  const Label beyond = on_side_of(sided, fan[0].low == label ? fan[0].high : fan[0].low);
  std::vector<TriangleKey> old;
  for (const FanTriangle& t : fan) old.push_back(triangle_key(v, t.a, t.b));
  std::vector<FlippedTriangle> fresh;
  for (const LinkTriangle& t : dimple_) fresh.push_back({t.a, t.b, t.c});
  if (guard_ != nullptr && !guard_->allows_flip(mesh_, old, fresh, sided, beyond)) return false;
  for (const auto& [a, b, c] : fresh) mesh_.relabel({{v, a, b, c}, sided}, beyond);
  if (guard_ != nullptr) guard_->commit();
  return true;
}

}  // namespace mw
