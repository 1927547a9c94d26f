// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Interfaces by maps.
#include "tests/oracle/interface_bends.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>
#include <set>

namespace mw::audit::test {
namespace {

using Eigen::Vector3d;
using Triangle = std::set<std::uint64_t>;
using Edge = std::set<std::uint64_t>;

/// A triangle of two labels, its unit normal out of the lower one.
struct Side {
  std::pair<Label, Label> labels;
  Vector3d normal;
};

Vector3d vector(const Position& p) {
  return {p[0], p[1], p[2]};
}

}  // namespace

double InterfaceBends::percentile(double share) const {
  double total = 0, below = 0;
  for (const Bend& b : bends) total += b.length;
  for (const Bend& b : bends) {
    below += b.length;
    if (below >= share * total) return b.degrees;
  }
  return 0;
}

double InterfaceBends::share_above(double degrees) const {
  double total = 0, above = 0;
  for (const Bend& b : bends) {
    total += b.length;
    if (b.degrees > degrees) above += b.length;
  }
  return total > 0 ? above / total : 0;
}

InterfaceBends interface_bends(const AuditMesh& mesh) {
  std::map<Triangle, std::vector<std::size_t>> tets_on;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (const std::uint64_t apex : mesh.tets[t]) {
      Triangle face(mesh.tets[t].begin(), mesh.tets[t].end());
      face.erase(apex);
      tets_on[face].push_back(t);
    }
  }
  const auto at = [&](std::uint64_t v) { return vector(mesh.vertices[v]); };
  InterfaceBends out;
  std::map<Edge, std::vector<Side>> sides_at;
  for (const auto& [face, tets] : tets_on) {
    if (tets.size() != 2 || mesh.labels[tets[0]] == mesh.labels[tets[1]]) continue;
    const std::size_t low = mesh.labels[tets[0]] < mesh.labels[tets[1]] ? 0 : 1;
    const std::vector<std::uint64_t> v(face.begin(), face.end());
    Vector3d normal = (at(v[1]) - at(v[0])).cross(at(v[2]) - at(v[0]));
    ++out.triangles;
    out.area += normal.norm() / 2;
    Vector3d middle = Vector3d::Zero();
    for (const std::uint64_t corner : mesh.tets[tets[low]]) middle += at(corner) / 4;
    if (normal.dot(at(v[0]) - middle) < 0) normal = -normal;
    const Side side{{mesh.labels[tets[low]], mesh.labels[tets[1 - low]]}, normal.normalized()};
    for (const Edge& edge : {Edge{v[0], v[1]}, Edge{v[1], v[2]}, Edge{v[0], v[2]}}) {
      sides_at[edge].push_back(side);
    }
  }
  for (const auto& [edge, sides] : sides_at) {
    if (sides.size() != 2 || sides[0].labels != sides[1].labels) continue;
    const double cosine = std::clamp(sides[0].normal.dot(sides[1].normal), -1.0, 1.0);
    out.bends.push_back({std::acos(cosine) * 180 / std::numbers::pi,
                         (at(*edge.begin()) - at(*edge.rbegin())).norm()});
  }
  std::sort(out.bends.begin(), out.bends.end(),
            [](const Bend& a, const Bend& b) { return a.degrees < b.degrees; });
  return out;
}

}  // namespace mw::audit::test
