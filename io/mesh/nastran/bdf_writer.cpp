// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Cards are those of the MSC Nastran Quick Reference Guide.
#include "io/mesh/nastran/bdf_writer.h"

#include "io/file/errors.h"
#include "io/mesh/grouped/fixed_fields.h"
#include "io/mesh/grouped/group_names.h"

namespace mw::io {
namespace {

constexpr std::size_t kColumns = 72;      // in a line of the case control
constexpr std::size_t kFieldColumns = 8;  // in a small field
constexpr int kDigits = 9;                // behind the point of a coordinate

/// Returns the text at the left of a field, which has room for it.
std::string field(std::string text, std::size_t columns = kFieldColumns) {
  text.resize(columns, ' ');
  return text;
}

std::string number_field(std::uint64_t number, std::size_t columns = kFieldColumns) {
  return field(std::to_string(number), columns);
}

void write_bdf_set(TabledFile& file, GroupedMesh& mesh, std::size_t number,
                   const NamedFacets& set) {
  file.line(text("$ SET ", number, ": nodes of ", set.name));
  std::string row = text("SET ", number, " = ");
  bool is_first = true;
  for_each_facet_node(mesh, set.group.facets, [&](std::uint64_t node) {
    const std::string item = std::to_string(node + 1);
    if (!is_first) row += ',';
    if (row.size() + item.size() + 1 > kColumns) {
      file.line(row);
      row = "  ";
    }
    row += item;
    is_first = false;
  });
  file.line(row);
}

void write_bdf_nodes(TabledFile& file, GroupedMesh& mesh) {
  for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
    const Position p = mesh.node(row);
    const auto coordinate = [&](std::size_t axis) {
      return fixed_coordinate(file.name, p[axis], 2 * kFieldColumns, kDigits);
    };
    file.line(field("GRID*") + number_field(row + 1, 2 * kFieldColumns) +
              field("", 2 * kFieldColumns) + coordinate(0) + coordinate(1) + "*");
    file.line(field("*") + coordinate(2));
  }
}

void write_bdf_part(TabledFile& file, GroupedMesh& mesh, RowRange tets, std::int64_t number,
                    const std::string& name) {
  constexpr std::size_t kNodesOfFirstLine = 6;
  const std::string part = number_field(static_cast<std::uint64_t>(number));
  file.line(text("$ PSOLID ", number, ": ", name));
  file.line(field("PSOLID") + part + part);
  file.line(field("MAT1") + part + field("1.0") + field("") + field("0.3"));
  for (std::uint64_t t = tets.begin; t < tets.end; ++t) {
    std::string row = field("CTETRA") + number_field(t + 1) + part;
    std::size_t nodes = 0;
    for (const std::uint64_t node : mesh.tet_nodes(t)) {
      if (nodes++ == kNodesOfFirstLine) {
        file.line(row + "+");  // the tenth field, which begins at column 73
        row = field("+");
      }
      row += number_field(node + 1);
    }
    file.line(row);
  }
}

/// Writes a pressure of 1 on the faces of tets on one side of a set, which no job sees until it
/// takes the load of this number.  A face of a tet is told by a corner of it and the corner off it.
void write_bdf_pressures(TabledFile& file, GroupedMesh& mesh, std::size_t number,
                         const NamedFacets& set, bool of_second) {
  file.line(text("$ PLOAD4 ", number, ": faces of ", of_second ? set.other : set.name));
  const std::string load = number_field(number);
  const RowRange& facets = set.group.facets;
  for (std::uint64_t f = facets.begin; f < facets.end; ++f) {
    const Facet facet = of_second ? mesh.of_second(mesh.facet(f)) : mesh.facet(f);
    const std::uint64_t off = *(mesh.tet_nodes(facet.tet).begin() + facet.opposite);
    file.line(field("PLOAD4") + load + number_field(facet.tet + 1) + field("1.0") +
              field("", 3 * kFieldColumns) + number_field(facet.rows[0] + 1) +
              number_field(off + 1));
  }
}

/// Writes the pressures of all sets, those of an interface on both sides.
void write_bdf_loads(TabledFile& file, GroupedMesh& mesh, const PlainNames& names) {
  std::size_t number = 0;
  for_each_named(mesh, names, [&](const NamedFacets& set) {
    write_bdf_pressures(file, mesh, ++number, set, false);
    if (!set.other.empty()) write_bdf_pressures(file, mesh, ++number, set, true);
  });
}

}  // namespace

void write_bdf(TabledFile& file, GroupedMesh& mesh) {
  check_number(file.name, std::max(mesh.node_count(), mesh.tet_count()),
               {.max = kMaxFieldNumber, .subject = "Nastran has", .others = ".exo or .vtkhdf"});
  check_digits(file.name, mesh, kDigits + 1);
  const LabelNumbers numbers(mesh.table(), {.max = kMaxFieldNumber});
  const PlainNames names(mesh);
  file.line(text("$ mwmesh: tetrahedra of ", mesh.table().size(),
                 " labels; materials are placeholders."));
  file.line("CEND");
  std::size_t number = 0;
  for_each_named(mesh, names,
                 [&](const NamedFacets& set) { write_bdf_set(file, mesh, ++number, set); });
  file.line("BEGIN BULK");
  write_bdf_nodes(file, mesh);
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    write_bdf_part(file, mesh, mesh.label_tets()[rank], numbers[rank], names.volume(rank));
  }
  write_bdf_loads(file, mesh, names);
  file.line("ENDDATA");
  file.commit(mesh, numbers);
}

}  // namespace mw::io
