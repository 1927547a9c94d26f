// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Regions by union-find over shared triangles.
#include "kernels/odt/window_plc.h"

#include <cmath>

#include "kernels/core/disjoint_sets.h"
#include "kernels/odt/tet_faces.h"

namespace mw {
namespace {

constexpr std::uint32_t kNoRegion = 0xffffffffU;

Point lower_corner(const TetMesh& mesh) {
  Point lo = mesh.position(0);
  for (LocalVertex v = 1; v < mesh.vertex_count(); ++v) {
    const Point p = mesh.position(v);
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
  }
  return lo;
}

/// Finds the facets; tets beside any other triangle are of one region.
DisjointSets join_regions(const std::vector<LocalTet>& tets, Plc& plc) {
  std::vector<TetFace> faces;
  faces.reserve(4 * tets.size());
  for (std::uint32_t t = 0; t < tets.size(); ++t) {
    for (int corner = 0; corner < 4; ++corner) faces.push_back(tet_face(tets[t], corner, t));
  }
  DisjointSets sets(tets.size());
  for_each_triangle(faces, [&](auto first, auto last) {
    if (last - first == 2 && tets[first->tet].label == tets[first[1].tet].label) {
      sets.unite(first->tet, first[1].tet);
    } else {
      plc.facets.push_back(first->vertices);
    }
  });
  return sets;
}

/// Numbers regions in the order of their first tets.
void number_regions(RegionTets& content, DisjointSets& sets) {
  std::vector<std::uint32_t> number(content.tets.size(), kNoRegion);
  for (std::uint32_t t = 0; t < content.tets.size(); ++t) {
    std::uint32_t& region = number[sets.find(t)];
    if (region == kNoRegion) {
      region = static_cast<std::uint32_t>(content.labels.size());
      content.labels.push_back(content.tets[t].label);
    }
    content.regions.push_back(region);
  }
}

/// The middle of each region's largest tet, which is far from facets and cheap to find.
std::vector<PlcPoint> seeds_of(const TetMesh& mesh, const RegionTets& content,
                               const PlcFrame& frame) {
  std::vector<PlcPoint> seeds(content.labels.size());
  std::vector<std::int64_t> largest(content.labels.size(), 0);
  for (std::size_t t = 0; t < content.tets.size(); ++t) {
    const auto& v = content.tets[t].vertices;
    const std::int64_t volume =
        volume6(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]), mesh.position(v[3]));
    const std::uint32_t region = content.regions[t];
    if (volume <= largest[region]) continue;
    largest[region] = volume;
    PlcPoint middle{};
    for (LocalVertex w : v) {
      const PlcPoint p = frame.to_plc(mesh.position(w));
      for (std::size_t i = 0; i < 3; ++i) middle[i] += 0.25 * p[i];
    }
    seeds[region] = middle;
  }
  return seeds;
}

}  // namespace

PlcPoint PlcFrame::to_plc(Point p) const {
  return {(p.x - lower_.x) * scale_[0], (p.y - lower_.y) * scale_[1], (p.z - lower_.z) * scale_[2]};
}

std::optional<Point> PlcFrame::to_lattice(const PlcPoint& p) const {
  std::array<std::int32_t, 3> offset{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double units = std::floor(p[i] / scale_[static_cast<Eigen::Index>(i)] + 0.5);
    if (!(units >= 0.0 && units <= 2.0 * kMaxTetExtent)) return std::nullopt;
    offset[i] = static_cast<std::int32_t>(units);
  }
  return Point{lower_.x + offset[0], lower_.y + offset[1], lower_.z + offset[2]};
}

WindowPlc window_plc(const TetMesh& mesh, const Metric& metric) {
  WindowPlc out{{mesh.tets(), {}, {}}, PlcFrame(lower_corner(mesh), metric), {}};
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    out.plc.points.push_back(out.frame.to_plc(mesh.position(v)));
  }
  DisjointSets sets = join_regions(out.content.tets, out.plc);
  number_regions(out.content, sets);
  out.plc.seeds = seeds_of(mesh, out.content, out.frame);
  return out;
}

}  // namespace mw
