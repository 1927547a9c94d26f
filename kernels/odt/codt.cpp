// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Iterates vertex moves, a triangulation and the proof of what it changes.  Circumcentres times
// volumes need no division.
#include "kernels/odt/codt.h"

#include <bit>

#include "kernels/odt/rebuild.h"
#include "kernels/quality/quality.h"
#include "kernels/quality/star_batch.h"

namespace mw {
namespace {

constexpr int kSteinerBit = 63;

/// Positions of Steiner points on the lattice; only the first `ids` points can have one.
std::vector<std::optional<Point>> on_lattice(const PlcFrame& frame, const Triangulation& made,
                                             std::uint64_t ids) {
  std::vector<std::optional<Point>> out;
  for (const PlcPoint& p : made.added) {
    out.push_back(out.size() < ids ? frame.to_lattice(p) : std::nullopt);
  }
  return out;
}

class Window {
 public:
  Window(TetMesh& mesh, CarriedSamples& samples, Point box, const Metric& metric,
         const CodtOptions& options)
      : mesh_(mesh), samples_(samples), box_(box), metric_(metric), options_(options) {
    rebuild(mesh_, samples_, mesh_.tets(), {}, box_);
  }

  /// False when there was no triangulation.
  bool iterate(const Triangulate& triangulate, CodtStats& stats) {
    ++stats.iterations;
    stats.moves += odt_sweep(mesh_, metric_, options_.quality_floor);
    const WindowPlc before = window_plc(mesh_, metric_);
    const std::optional<Triangulation> made = triangulate(before.plc);
    if (!made) return false;
    const auto added = on_lattice(before.frame, *made, options_.ids.count - ids_given_);
    const Replacement after =
        replace_proved(mesh_, metric_, before.content, added, *made, options_.quality_floor);
    stats.replaced += after.stats;
    const std::vector<BlockVertex> vertices = new_vertices(added, after.used);
    stats.added = ids_given_;
    rebuild(mesh_, samples_, after.tets, vertices, box_);
    return true;
  }

 private:
  /// Makes one vertex a point, so that rows stay.  Unused ones get no id; rebuild() drops them.
  std::vector<BlockVertex> new_vertices(std::span<const std::optional<Point>> added,
                                        std::span<const std::uint8_t> used) {
    std::vector<BlockVertex> out(added.size());
    for (std::size_t i = 0; i < added.size(); ++i) {
      if (used[i] == 0) continue;
      out[i].id = options_.ids.first + ids_given_++;
      out[i].position = *added[i];
      out[i].quadric.add_point(1.0);
    }
    return out;
  }

  TetMesh& mesh_;
  CarriedSamples& samples_;
  Point box_;
  const Metric& metric_;
  const CodtOptions& options_;
  std::uint64_t ids_given_ = 0;
};

}  // namespace

SteinerIds steiner_ids(std::uint64_t window, std::uint64_t windows) {
  const int bits = kSteinerBit - static_cast<int>(std::bit_width(windows - 1));
  return {VertexId{1} << kSteinerBit | window << bits, std::uint64_t{1} << bits};
}

CodtStats& CodtStats::operator+=(const CodtStats& other) {
  windows += other.windows;
  iterations += other.iterations;
  moves += other.moves;
  added += other.added;
  fallbacks += other.fallbacks;
  replaced += other.replaced;
  return *this;
}

double odt_energy(const TetMesh& mesh, const Metric& metric) {
  double sum = 0.0;
  for (const LocalTet& t : mesh.tets()) {
    const auto& v = t.vertices;
    const TetEdges e = tet_edges(metric, mesh.position(v[0]), mesh.position(v[1]),
                                 mesh.position(v[2]), mesh.position(v[3]));
    sum += e.a.dot(e.b.cross(e.c)) *
           (e.a.squaredNorm() + e.b.squaredNorm() + e.c.squaredNorm() + (e.b - e.a).squaredNorm() +
            (e.c - e.b).squaredNorm() + (e.a - e.c).squaredNorm());
  }
  return sum;
}

CodtStats codt(TetMesh& mesh, CarriedSamples& samples, Point box, const Metric& metric,
               const CodtOptions& options, const Triangulate& triangulate) {
  if (mesh.tets().empty()) return {};
  CodtStats stats{.windows = 1};
  Window window(mesh, samples, box, metric, options);
  double before = odt_energy(mesh, metric);
  for (int i = 0; i < options.iterations; ++i) {
    if (!window.iterate(triangulate, stats)) {
      ++stats.fallbacks;
      break;
    }
    const double after = odt_energy(mesh, metric);
    if (!(after < (1.0 - options.min_gain) * before)) break;
    before = after;
  }
  return stats;
}

namespace {

constexpr double kMinStep = 0.1;

/// The way from v to the mean of circumcentres.  With edges a, b, c from v the circumcentre times
/// six-fold volume is half of |a|^2 b x c + |b|^2 c x a + |c|^2 a x b.
Vec3 way_to_optimum(const TetMesh& mesh, const Metric& metric, LocalVertex v) {
  Vec3 sum = Vec3::Zero();
  double volume = 0.0;
  for (const LinkTriangle& t : mesh.star(v)) {
    const TetEdges e = tet_edges(metric, mesh.position(v), mesh.position(t.a), mesh.position(t.b),
                                 mesh.position(t.c));
    const Vec3 bc = e.b.cross(e.c);
    sum += e.a.squaredNorm() * bc + e.b.squaredNorm() * e.c.cross(e.a) +
           e.c.squaredNorm() * e.a.cross(e.b);
    volume += e.a.dot(bc);
  }
  return sum / (2.0 * volume);
}

bool may_be_at(const TetMesh& mesh, const Metric& metric, LocalVertex v, Point x, double min) {
  for (const LinkTriangle& t : mesh.star(v)) {
    const Point a = mesh.position(t.a), b = mesh.position(t.b), c = mesh.position(t.c);
    if (volume6(x, a, b, c) <= 0) return false;
    if (min > 0.0 && radius_ratio(tet_edges(metric, x, a, b, c)) < min) return false;
  }
  return true;
}

/// star is scratch.
bool move_vertex(TetMesh& mesh, const Metric& metric, LocalVertex v, double quality_floor,
                 StarBatch& star) {
  const Point start = mesh.position(v);
  const Vec3 way = way_to_optimum(mesh, metric, v);
  star.collect(mesh, metric, v);
  const double min = std::min(quality_floor, star.shape_at(Vec3::Zero()).worst);
  for (double step = 1.0; step > kMinStep; step *= 0.5) {
    const Point x = metric.moved(start, step * way);
    if (x == start) return false;
    if (!may_be_at(mesh, metric, v, x, min)) continue;
    mesh.move(v, x, mesh.quadric(v).shifted(metric.vector(start, x)));
    return true;
  }
  return false;
}

}  // namespace

std::uint64_t odt_sweep(TetMesh& mesh, const Metric& metric, double quality_floor) {
  std::uint64_t moves = 0;
  StarBatch star;
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    const bool inner =
        mesh.is_alive(v) && mesh.is_free(v) && mesh.planes(v) == 0 && !mesh.on_interface(v);
    if (inner) moves += move_vertex(mesh, metric, v, quality_floor, star) ? 1U : 0U;
  }
  return moves;
}

}  // namespace mw
