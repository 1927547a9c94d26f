// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds the surface from triangles that occur once, and the place by a search along the axes.
#include "kernels/inner/cavity.h"

#include <algorithm>
#include <array>

#include "kernels/distance/carried_samples.h"
#include "kernels/quality/quality.h"

namespace mw {
namespace {

/// Steps of the search, as shares of the size of the cavity.
constexpr std::array<double, 4> kSteps{0.16, 0.08, 0.04, 0.02};

}  // namespace

Cavity::Cavity(const TetMesh& mesh, const Metric& metric, std::vector<LocalTet> tets)
    : mesh_(mesh), metric_(metric), tets_(std::move(tets)) {
  find_surface();
}

void Cavity::find_surface() {
  std::vector<std::pair<TriangleKey, LinkTriangle>> faces;
  for (const LocalTet& t : tets_) {
    for (int corner = 0; corner < 4; ++corner) {
      const LinkTriangle f = link_triangle(t, corner);
      faces.emplace_back(triangle_key(f.a, f.b, f.c), f);
    }
  }
  std::sort(faces.begin(), faces.end());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (i + 1 < faces.size() && faces[i + 1].first == faces[i].first) {
      ++i;
    } else {
      surface_.push_back(faces[i].second);
    }
  }
}

std::vector<LocalTet> Cavity::tets_around(LocalVertex row) const {
  std::vector<LocalTet> out;
  out.reserve(surface_.size());
  for (const LinkTriangle& f : surface_) out.push_back({{row, f.a, f.b, f.c}, f.label});
  return out;
}

/// The mean of the corners of the surface's triangles; a corner counts once for each triangle.
Point Cavity::middle() const {
  std::array<std::int64_t, 3> sum{};
  for (const LinkTriangle& f : surface_) {
    for (const LocalVertex v : {f.a, f.b, f.c}) {
      const Point p = mesh_.position(v);
      sum[0] += p.x;
      sum[1] += p.y;
      sum[2] += p.z;
    }
  }
  const auto count = static_cast<std::int64_t>(3 * surface_.size());
  return {static_cast<std::int32_t>(sum[0] / count), static_cast<std::int32_t>(sum[1] / count),
          static_cast<std::int32_t>(sum[2] / count)};
}

double Cavity::worst_at(Point x, double enough) const {
  double worst = 1.0;
  for (const LinkTriangle& f : surface_) {
    worst = std::min(worst, radius_ratio(mesh_, metric_, x, f));
    if (worst < enough) return worst;
  }
  for (const LinkTriangle& f : surface_) {
    const Point a = mesh_.position(f.a), b = mesh_.position(f.b), c = mesh_.position(f.c);
    if (volume6(x, a, b, c) <= 0) return 0.0;
  }
  return worst;
}

bool Cavity::keeps_lengths(Point x, const SizeField& sizes) const {
  const double limit = std::min(sizes.at(x), sizes.of_label(tets_[0].label));
  for (const LinkTriangle& f : surface_) {
    for (const LocalVertex v : {f.a, f.b, f.c}) {
      const Point p = mesh_.position(v);
      const double max = sizes.stretch() * std::min(limit, sizes.at(p));
      if (metric_.vector(x, p).squaredNorm() > max * max) return false;
    }
  }
  return true;
}

void Cavity::search(CavityPosition& best) const {
  const double size = metric_.vector(best.position, mesh_.position(surface_[0].a)).norm() +
                      metric_.vector(best.position, mesh_.position(surface_[0].b)).norm();
  for (const double step : kSteps) {
    for (int way = 0; way < 6; ++way) {
      Vec3 offset = Vec3::Zero();
      offset[way / 2] = (way % 2 == 0 ? 1.0 : -1.0) * step * size;
      const Point x = metric_.moved(best.position, offset);
      const double worst = worst_at(x, best.worst);
      if (worst > best.worst) best = {x, worst};
    }
  }
}

std::optional<CavityPosition> Cavity::first_position(Point start) const {
  CavityPosition best{start, worst_at(start, 0.0)};
  const Point other = middle();
  const double there = worst_at(other, best.worst);
  if (there > best.worst) best = {other, there};
  if (best.worst <= 0.0) return std::nullopt;
  return best;
}

std::optional<CavityPosition> Cavity::best_position(CavityPosition first,
                                                    const CavityLimits& limits) const {
  CavityPosition best = first;
  search(best);
  if (best.worst < limits.min_ratio) return std::nullopt;
  if (limits.sizes != nullptr && !keeps_lengths(best.position, *limits.sizes)) return std::nullopt;
  return best;
}

}  // namespace mw
