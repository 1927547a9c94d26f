// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What groups of tets and facets are called in files that know names, and their numbers in the
// others.
#include "io/mesh/grouped/group_names.h"

#include <cctype>
#include <map>

#include "io/file/errors.h"
#include "io/names/csv_names.h"

namespace mw::io {
namespace {

std::string plain_digits(const LabelTable& table, Label rank) {
  std::string digits = label_digits(table, rank);
  if (digits.front() == '-') digits.front() = 'M';
  return digits;
}

constexpr std::int64_t kFirstInterface = kSides;

}  // namespace

const char* side_name(Side side) {
  constexpr std::array<const char*, kSides> kNames{"interface", "x_min", "x_max", "y_min",
                                                   "y_max",     "z_min", "z_max", "outer"};
  return kNames[static_cast<std::size_t>(side)];
}

std::string label_digits(const LabelTable& table, Label rank) {
  const RawLabel raw = table.raw(rank);
  return table.is_signed() ? text(static_cast<std::int64_t>(raw)) : text(raw);
}

GroupNames::GroupNames(const GroupedMesh& mesh) {
  const LabelTable& table = mesh.table();
  std::map<std::string, std::size_t> uses;
  for (Label rank = 0; rank < table.size(); ++rank) ++uses[mesh.names().name(table.raw(rank))];
  for (Label rank = 0; rank < table.size(); ++rank) {
    const std::string& name = mesh.names().name(table.raw(rank));
    const std::string digits = label_digits(table, rank);
    if (name.empty()) {
      volumes_.push_back("label_" + digits);
    } else {
      volumes_.push_back(uses[name] > 1 ? text(name, " (", digits, ")") : name);
    }
  }
}

std::string GroupNames::facets(const FacetGroup& group) const {
  if (group.side != Side::kInterface) return side_name(group.side);
  return volume(group.first) + "|" + volume(group.second);
}

std::string plain_volume_name(const LabelTable& table, Label rank) {
  return "LABEL_" + plain_digits(table, rank);
}

std::string plain_facet_name(const LabelTable& table, const FacetGroup& group) {
  if (group.side == Side::kInterface) {
    return "FACE_" + plain_digits(table, group.first) + "_" + plain_digits(table, group.second);
  }
  std::string name = side_name(group.side);
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

std::vector<NumberedFacets> number_facets(const GroupedMesh& mesh) {
  const GroupNames names(mesh);
  std::vector<NumberedFacets> out;
  std::int64_t next = kFirstInterface;
  for (const FacetGroup& group : mesh.facet_groups()) {
    const bool interface = group.side == Side::kInterface;
    if (!interface && !out.empty() && out.back().side == group.side) {
      out.back().facets.end = group.facets.end;
      continue;
    }
    out.push_back({.number = interface ? next++ : static_cast<std::int64_t>(group.side),
                   .name = names.facets(group),
                   .side = group.side,
                   .first = interface ? group.first : kExterior,
                   .second = group.second,
                   .facets = group.facets});
  }
  return out;
}

std::filesystem::path facet_table_path(const std::filesystem::path& mesh) {
  return std::filesystem::path(mesh).replace_extension(".facets.csv");
}

void append_facet_table(AtomicFile& file, const LabelTable& table,
                        const std::vector<NumberedFacets>& facets) {
  file.append("number,name,side,first,second\n");
  const auto label = [&](Label rank) {
    return rank == kExterior ? std::string() : label_digits(table, rank);
  };
  for (const NumberedFacets& run : facets) {
    file.append(text(run.number, ",", csv_quoted(run.name), ",", side_name(run.side), ",",
                     label(run.first), ",", label(run.second), "\n"));
  }
}

}  // namespace mw::io
