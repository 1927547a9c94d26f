// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "kernels/mesh/star_boxes.h"

namespace mw {
namespace {

LatticeBox box_of_star(const TetMesh& mesh, LocalVertex v) {
  LatticeBox box{mesh.position(v), mesh.position(v)};
  for (const LinkTriangle& t : mesh.star(v)) {
    for (const LocalVertex w : {t.a, t.b, t.c}) {
      if (w == mesh.infinity()) continue;
      const Point p = mesh.position(w);
      box.lo = {std::min(box.lo.x, p.x), std::min(box.lo.y, p.y), std::min(box.lo.z, p.z)};
      box.hi = {std::max(box.hi.x, p.x), std::max(box.hi.y, p.y), std::max(box.hi.z, p.z)};
    }
  }
  return box;
}

bool is_within(const LatticeBox& inner, const LatticeBox& outer) {
  return inner.lo.x >= outer.lo.x && inner.lo.y >= outer.lo.y && inner.lo.z >= outer.lo.z &&
         inner.hi.x <= outer.hi.x && inner.hi.y <= outer.hi.y && inner.hi.z <= outer.hi.z;
}

}  // namespace

bool star_is_in_one(const TetMesh& mesh, LocalVertex v, const std::vector<LatticeBox>& boxes) {
  const LatticeBox star = box_of_star(mesh, v);
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const LatticeBox& box) { return is_within(star, box); });
}

FinishedVertices::FinishedVertices(const TetMesh& mesh, const std::vector<LatticeBox>& boxes) {
  if (boxes.empty()) return;
  finished_.assign(mesh.vertex_count(), 0);
  for (LocalVertex v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v) || mesh.version(v) != 0) continue;
    finished_[v] = star_is_in_one(mesh, v, boxes) ? 1 : 0;
  }
}

}  // namespace mw
