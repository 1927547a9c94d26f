// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers of facet groups, for formats that have no names.
#include "io/mesh/grouped/facet_numbers.h"

#include "io/file/errors.h"
#include "io/names/csv_records.h"

namespace mw::io {
namespace {

constexpr std::int64_t kFirstInterface = kSides;

}  // namespace

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
