// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Ranges of a value, and what is in each.
#include "io/mesh/grouped/material_sets.h"

#include <algorithm>
#include <cmath>

#include "io/file/errors.h"
#include "kernels/core/vector3.h"

namespace mw::io {
namespace {

std::size_t column_of(const GroupedMesh& mesh, const std::string& name) {
  const std::vector<std::string>& names = mesh.header().values;
  const auto at = std::find(names.begin(), names.end(), name);
  if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
  fail_usage("--materials ", name, ": tets have no values of that name");
}

double volume_of(GroupedMesh& mesh, std::uint64_t tet) {
  const TetRows rows = mesh.tet(tet);
  return volume6(mesh.node(rows[0]), mesh.node(rows[1]), mesh.node(rows[2]), mesh.node(rows[3])) /
         6;
}

}  // namespace

MaterialSets::MaterialSets(GroupedMesh& mesh, const MaterialRule& rule)
    : mesh_(mesh), rule_(rule), column_(column_of(mesh, rule.values)), materials_(rule.count) {
  bool is_first = true;
  for (std::uint64_t t = 0; t < mesh.tet_count() && !rule.range; ++t) {
    const double value = mesh.value(t, column_);
    if (std::isnan(value)) continue;
    least_ = is_first ? value : std::min(least_, value);
    most_ = is_first ? value : std::max(most_, value);
    is_first = false;
  }
  if (rule.range) {
    least_ = (*rule.range)[0];
    most_ = (*rule.range)[1];
  }
  for (std::uint64_t t = 0; t < mesh.tet_count(); ++t) {
    const std::uint32_t number = material_of(t);
    if (number == 0) continue;
    Material& material = materials_[number - 1];
    const double volume = volume_of(mesh, t);
    ++material.tets;
    material.volume += volume;
    material.mean += volume * mesh.value(t, column_);
  }
  for (Material& material : materials_) {
    if (material.volume > 0) material.mean /= material.volume;
  }
}

/// Returns where the material begins; for count + 1, where the last one ends.
double MaterialSets::bound(std::uint32_t material) const {
  if (material > rule_.count) return most_;
  return least_ + (most_ - least_) * (static_cast<double>(material - 1) / rule_.count);
}

std::uint32_t MaterialSets::material_of(std::uint64_t tet) {
  const double value = mesh_.value(tet, column_);
  if (std::isnan(value)) return 0;
  // This finds the last material whose bound is not above the value.
  std::uint32_t lo = 1, hi = rule_.count;
  while (lo < hi) {
    const std::uint32_t middle = lo + (hi - lo + 1) / 2;
    if (bound(middle) <= value) {
      lo = middle;
    } else {
      hi = middle - 1;
    }
  }
  return lo;
}

std::string MaterialSets::name(std::uint32_t material) const {
  return text(rule_.values, "_", material);
}

std::vector<std::string> MaterialSets::names() const {
  std::vector<std::string> out;
  for (std::uint32_t m = 1; m <= count(); ++m) out.push_back(name(m));
  return out;
}

void MaterialSets::append_table(AtomicFile& file) const {
  file.append(std::string_view("material,set,from,to,mean,tets,volume\n"));
  for (std::uint32_t m = 1; m <= count(); ++m) {
    const Material& material = facts(m);
    file.append(
        text(m, ",", material.tets > 0 ? name(m) : "", ",", bound(m), ",", bound(m + 1), ","));
    if (material.tets > 0) file.append(text(material.mean));
    file.append(text(",", material.tets, ",", material.volume, "\n"));
  }
}

std::filesystem::path material_table_path(const std::filesystem::path& mesh) {
  return mesh.string() + ".materials.csv";
}

}  // namespace mw::io
