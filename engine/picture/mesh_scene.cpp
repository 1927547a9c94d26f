// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Collects what is seen of a mesh.
#include "engine/picture/draw.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/file/errors.h"
#include "kernels/core/error.h"
#include "kernels/core/vector3.h"

namespace mw::picture {
namespace {

Vec3 vec(const io::Position& p) {
  return {p[0], p[1], p[2]};
}

/// Returns the area of the box's six sides.
double area_of(const io::MeshBox& box) {
  const auto& [x, y, z] = box.edges;
  return 2 * (norm(cross(x, y)) + norm(cross(y, z)) + norm(cross(z, x)));
}

/// Visits a polygon as triangles around its first corner; its own sides are edges of the mesh.
void fan(const Piece& piece, SceneTriangle triangle, const MeshScene::Visit& visit) {
  for (std::size_t i = 1; i + 1 < piece.count; ++i) {
    triangle.corners = {piece.corners[0], piece.corners[i], piece.corners[i + 1]};
    triangle.lined = {true, i + 2 == piece.count, i == 1};
    visit(triangle);
  }
}

}  // namespace

Colour label_colour(RawLabel label, const io::LabelNames& names) {
  const io::LabelName* const row = names.find(label);
  if (row == nullptr || !row->colour) return palette_colour(label);
  const io::Colour& colour = *row->colour;
  return {colour[0], colour[1], colour[2]};
}

std::optional<Label> surrounding_label(io::GroupedMesh& mesh) {
  if (mesh.table().size() < 2) return std::nullopt;
  std::vector<double> areas(mesh.table().size());  // twice those on the box
  for (const io::FacetGroup& group : mesh.facet_groups()) {
    if (group.side == io::Side::kInterface || group.side == io::Side::kOuter) continue;
    for (std::uint64_t number = group.facets.begin; number < group.facets.end; ++number) {
      const auto [a, b, c] = mesh.facet(number).rows;
      areas[group.first] +=
          normal_of({vec(mesh.node(a)), vec(mesh.node(b)), vec(mesh.node(c))}).norm();
    }
  }
  const double all = 2 * area_of(mesh.box());
  for (Label rank = 0; rank < areas.size(); ++rank) {
    if (3 * areas[rank] > 2 * all && std::isfinite(areas[rank])) return rank;
  }
  return std::nullopt;
}

View default_view(const std::optional<CutPosition>& cut) {
  if (!cut) return view_from(-55, 24);
  if (cut->axis == 0) return view_from(-28, 20);
  return cut->axis == 1 ? view_from(-62, 20) : view_from(-60, 52);
}

CutPlane cut_plane(const io::MeshBox& box, const CutPosition& position, const View& view) {
  const Vec3 edge = vec(box.edges[position.axis]);
  CutPlane plane{.normal = edge, .offset = edge.dot(vec(box.origin) + position.share * edge)};
  if (edge.dot(view.viewer) < 0) plane = {.normal = -edge, .offset = -plane.offset};
  return plane;
}

void MeshScene::each(const Visit& visit) {
  for (const io::FacetGroup& group : mesh_.facet_groups()) for_each_facet(group, visit);
  for (Label rank = 0; plane_ && rank < shown_.size(); ++rank) {
    if (shown_[rank]) for_each_section(rank, visit);
  }
}

void MeshScene::for_each_facet(const io::FacetGroup& group, const Visit& visit) {
  const bool one = shown_[group.first];
  const bool other = group.second != kExterior && shown_[group.second];
  if (one == other) return;
  SceneTriangle triangle{.colour = colour(one ? group.first : group.second)};
  for (std::uint64_t number = group.facets.begin; number < group.facets.end; ++number) {
    const auto [a, b, c] = mesh_.facet(number).rows;
    const std::array<Vec3, 3> corners{vertex(a), one ? vertex(b) : vertex(c),
                                      one ? vertex(c) : vertex(b)};
    triangle.normal = normal_of(corners);
    if (plane_) {
      fan(clipped(corners, *plane_), triangle, visit);
    } else {
      triangle.corners = corners;
      triangle.lined = {true, true, true};
      visit(triangle);
    }
  }
}

void MeshScene::for_each_section(Label rank, const Visit& visit) {
  const SceneTriangle triangle{.colour = colour(rank)};
  const io::RowRange tets = mesh_.label_tets()[rank];
  for (std::uint64_t number = tets.begin; number < tets.end; ++number) {
    const auto [a, b, c, d] = mesh_.tet(number);
    fan(cross_section({vertex(a), vertex(b), vertex(c), vertex(d)}, *plane_), triangle, visit);
  }
}

Vec3 MeshScene::vertex(std::uint64_t row) {
  Vec3 point = vec(mesh_.node(row));
  if (!point.allFinite()) {
    throw Error(ErrorKind::kInput, io::text("vertex ", row, " is not at a finite place"));
  }
  return point;
}

CutPosition middle_cut(MeshScene& scene, const io::MeshBox& box, std::size_t axis) {
  const Vec3 origin = vec(box.origin), edge = vec(box.edges[axis]);
  double min = std::numeric_limits<double>::infinity(), max = -min;
  scene.each([&](const SceneTriangle& triangle) {
    for (const Vec3& corner : triangle.corners) {
      const double share = edge.dot(corner - origin) / edge.squaredNorm();
      min = std::min(min, share);
      max = std::max(max, share);
    }
  });
  return {.axis = axis, .share = (min + max) / 2};
}

}  // namespace mw::picture
