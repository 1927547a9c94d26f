// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which facets of a mesh make a surface.
#include "io/surface/shell_plan.h"

#include <algorithm>

namespace mw::io {
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
