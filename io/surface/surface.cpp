// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facets of a mesh as a surface with vertices of its own.
#include "io/surface/surface.h"

#include <algorithm>
#include <cmath>

#include "io/file/scratch/external_sort.h"
#include "io/surface/apart_places.h"
#include "io/surface/vertex_sheets.h"
#include "kernels/core/vector3.h"

namespace mw::io {
namespace {

/// Records of a row of the mesh, a sheet and a corner.
using CornersByVertex = ExternalSort<3>;
/// Records of a corner and a vertex of the surface.
using VerticesByCorner = ExternalSort<2>;

void add_corners(const SurfaceSource& source, const ShellPlan& plan, CornersByVertex& corners) {
  std::uint64_t corner = 0;
  for_each_facet(source.mesh, plan, [&](const Triangle& rows) {
    for (const std::uint64_t row : rows) corners.add({row, 0, corner++});
  });
}

SurfaceShell shell_of(const GroupedMesh& mesh, const ShellPlan& plan) {
  SurfaceShell shell{.label = plan.label, .runs = {}};
  for (const ShellPart& part : plan.parts) {
    const FacetGroup& group = mesh.facet_groups()[part.group];
    shell.runs.push_back({.side = group.side,
                          .inside = inside_of(mesh, part),
                          .outside = part.turned ? group.first : group.second,
                          .triangles = group.facets.size()});
  }
  return shell;
}

}  // namespace

Surface::Surface(const SurfaceSource& source, std::shared_ptr<const SurfaceLabels> labels,
                 const std::vector<ShellPlan>& plans, Touching touching)
    : vertices_(source.folder), triangles_(source.folder) {
  header_.labels = std::move(labels);
  header_.frame = source.mesh.header().record.frame;
  header_.shift = source.shift;
  header_.shortest_edge = source.mesh.shortest_edge();
  for (const ShellPlan& plan : plans) add_shell(source, plan, touching);
}

void Surface::add_shell(const SurfaceSource& source, const ShellPlan& plan, Touching touching) {
  CornersByVertex corners(source.folder, kSurfaceSortBytes);
  if (touching == Touching::kJoined) {
    add_corners(source, plan, corners);
  } else {
    each_sheet_corner(source, plan, [&](const SheetCorner& at) {
      corners.add({at.row, at.sheet, at.corner});
    });
  }
  header_.shells.push_back(shell_of(source.mesh, plan));
  std::uint64_t next = vertices_.size() / sizeof(Position);
  VerticesByCorner vertices(source.folder, kSurfaceSortBytes);
  VertexCopies copies;
  corners.each_group<1>([&](std::span<const CornersByVertex::Record> at_row) {
    const Position position = minus(source.mesh.node(at_row[0][0]), source.shift);
    for (const double x : position) header_.largest = std::max(header_.largest, std::abs(x));
    const bool is_one = at_row.front()[1] == at_row.back()[1];
    for (std::size_t i = 0; i < at_row.size(); ++i) {
      const auto& [row, sheet, corner] = at_row[i];
      if (i == 0 || sheet != at_row[i - 1][1]) {
        vertices_.append(std::as_bytes(std::span(position)));
        ++header_.shells.back().vertices;
        ++next;
      }
      vertices.add({corner, next - 1});
      if (touching != Touching::kApart || is_one) continue;
      copies[next - 1].row = row;
      copies[next - 1].corners.push_back(corner);
    }
  });
  vertices.each([&](const VerticesByCorner::Record& record) {
    triangles_.append(std::as_bytes(std::span(&record[1], 1)));
  });
  moved_.merge(places_apart(source, plan, copies));
}

void Surface::write_vertices(SurfaceSink& sink) {
  std::uint64_t first = 0;
  auto next = moved_.begin();
  std::vector<Position> batch;
  vertices_.each_batch<Position>([&](std::span<const Position> positions) {
    batch.assign(positions.begin(), positions.end());
    for (; next != moved_.end() && next->first < first + batch.size(); ++next) {
      batch[next->first - first] = next->second;
    }
    first += batch.size();
    sink.write_vertices(batch);
  });
}

void Surface::write(SurfaceSink& sink) {
  sink.begin(header_);
  write_vertices(sink);
  triangles_.each_batch<Triangle>([&](const auto& batch) { sink.write_triangles(batch); });
  sink.finish();
}

namespace {

bool is_on_box(Side side) {
  return side != Side::kInterface && side != Side::kOuter;
}

}  // namespace

ShellPlans::ShellPlans(const GroupedMesh& mesh, bool closed)
    : mesh_(mesh), by_label_(mesh.table().size()) {
  const FacetGroups& groups = mesh.facet_groups();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (is_on_box(groups[g].side) && !closed) continue;
    by_label_[groups[g].first].push_back({.group = g});
    if (groups[g].side == Side::kInterface) {
      by_label_[groups[g].second].push_back({.group = g, .turned = true});
    }
  }
}

ShellPlan ShellPlans::of_label(Label rank) const {
  return {.label = rank, .parts = by_label_[rank]};
}

ShellPlan ShellPlans::of_pair(Label one, Label other) const {
  const auto [low, high] = std::minmax(one, other);
  ShellPlan plan;
  for (const ShellPart& part : by_label_[low]) {
    const FacetGroup& group = mesh_.facet_groups()[part.group];
    if (!part.turned && group.side == Side::kInterface && group.second == high) {
      plan.parts.push_back(part);
    }
  }
  return plan;
}

ShellPlan ShellPlans::of_interfaces() const {
  ShellPlan plan;
  for (std::size_t g = 0; g < mesh_.facet_groups().size(); ++g) {
    if (!is_on_box(mesh_.facet_groups()[g].side)) plan.parts.push_back({.group = g});
  }
  return plan;
}

std::vector<ShellPlan> ShellPlans::of_each_interface() const {
  std::vector<ShellPlan> plans;
  for (const ShellPart& part : of_interfaces().parts) {
    plans.push_back({.label = {}, .parts = {part}});
  }
  return plans;
}

}  // namespace mw::io
