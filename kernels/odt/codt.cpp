// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Iterates vertex moves, a triangulation and the proof of what it changes.
#include "kernels/odt/codt.h"

#include <bit>

#include "kernels/odt/rebuild.h"
#include "kernels/quality/quality.h"

namespace mw {
namespace {

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
  const int bits = kCopyBits - static_cast<int>(std::bit_width(windows - 1));
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

// More than five parameters: a window as optimise() has it, and what is new to it.
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

}  // namespace mw
