// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Commands and blocks are those of the Ansys Mechanical APDL Programmer's Reference (CDWRITE).
#include "io/mesh/ansys/cdb_writer.h"

#include "io/file/errors.h"
#include "io/mesh/grouped/fixed_fields.h"
#include "io/mesh/grouped/group_names.h"

namespace mw::io {
namespace {

constexpr std::size_t kColumns = 9;
constexpr std::uint64_t kTetType = 1, kFaceType = 2;

/// The triangles of one component.
struct Faces {
  std::string name;
  RowRange facets;
  bool of_second = false;
};

/// Calls visit(Faces) on the components of triangles: an interface has two.
template <class Visit>
void for_each_faces(const GroupedMesh& mesh, const PlainNames& names, Visit visit) {
  for_each_facet_run(mesh, [&](const FacetGroup& run) {
    visit(Faces{names.triangles(run), run.facets});
    if (run.side == Side::kInterface) visit(Faces{names.triangles(run, true), run.facets, true});
  });
}

void write_cdb_head(TabledFile& file, const GroupedMesh& mesh) {
  const bool ten = has_middles(mesh.element());
  file.line(text("/COM,mwmesh: tetrahedra of ", mesh.table().size(), " labels"));
  file.line(
      "/COM,Materials are placeholders.  Components X_MIN and FACE_1_2 are nodes of sides and");
  file.line(
      "/COM,interfaces; F_X_MIN, F_FACE_1_2 their triangles, which no solution sees (MESH200).");
  file.line("/PREP7");
  file.line(ten ? "ET,1,187" : "ET,1,285");
  file.line("ET,2,200");
  file.line(ten ? "KEYOPT,2,1,5" : "KEYOPT,2,1,4");
}

void write_cdb_nodes(TabledFile& file, GroupedMesh& mesh) {
  constexpr std::size_t kRealColumns = 21, kExponent = 3;
  constexpr int kDigits = 13;
  const std::string count = fixed_integer(mesh.node_count(), kColumns);
  file.line(text("NBLOCK,6,SOLID,", count, ",", count));
  file.line("(3i9,6e21.13e3)");
  for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
    std::string out =
        fixed_integer(row + 1, kColumns) + fixed_integer(0, kColumns) + fixed_integer(0, kColumns);
    for (const double x : mesh.node(row)) out += fixed_real(x, kRealColumns, kDigits, kExponent);
    file.line(out);
  }
  file.line("N,R5.3,LOC,       -1,");
}

void write_cdb_element(TabledFile& file, std::uint64_t material, std::uint64_t type,
                       std::uint64_t number, const NodeRows& nodes) {
  constexpr std::size_t kOnFirstLine = 8;
  std::string out;
  // Behind the type are real constants, section, coordinates, death, solid model, shape, number of
  // nodes, and a field that is not used.
  for (const std::uint64_t item :
       {material, type, std::uint64_t{1}, std::uint64_t{1}, std::uint64_t{0}, std::uint64_t{0},
        std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{nodes.size()}, std::uint64_t{0},
        number}) {
    out += fixed_integer(item, kColumns);
  }
  std::size_t written = 0;
  for (const std::uint64_t row : nodes) {
    if (written++ == kOnFirstLine) {
      file.line(out);
      out.clear();
    }
    out += fixed_integer(row + 1, kColumns);
  }
  file.line(out);
}

void write_tets(TabledFile& file, GroupedMesh& mesh, RowRange tets, std::uint64_t material) {
  for (std::uint64_t t = tets.begin; t < tets.end; ++t) {
    write_cdb_element(file, material, kTetType, t + 1, mesh.tet_nodes(t));
  }
}

void write_faces(TabledFile& file, GroupedMesh& mesh, const Faces& faces, std::uint64_t first) {
  for (std::uint64_t f = faces.facets.begin; f < faces.facets.end; ++f) {
    const Facet facet = faces.of_second ? mesh.of_second(mesh.facet(f)) : mesh.facet(f);
    write_cdb_element(file, 1, kFaceType, ++first, mesh.facet_nodes(facet));
  }
}

/// Writes a component of elements.  REQUIRES: there is at least one.
void write_element_component(TabledFile& file, const std::string& name,
                             const std::vector<RowRange>& ranges) {
  constexpr std::size_t kItemColumns = 10, kOnLine = 8;
  std::vector<std::string> items;
  for (const RowRange& elements : ranges) {
    items.push_back(std::to_string(elements.begin + 1));
    // A negative number ends a range.
    if (elements.size() > 1) items.push_back(text("-", elements.end));
  }
  file.line(text("CMBLOCK,", name, ",ELEM,", fixed_integer(items.size(), kItemColumns)));
  file.line("(8i10)");
  std::string row;
  for (std::size_t i = 0; i < items.size(); ++i) {
    row += std::string(kItemColumns - items[i].size(), ' ') + items[i];
    if ((i + 1) % kOnLine != 0 && i + 1 < items.size()) continue;
    file.line(row);
    row.clear();
  }
}

void write_node_component(TabledFile& file, GroupedMesh& mesh, const std::string& name,
                          RowRange facets, bool of_second) {
  constexpr std::size_t kItemColumns = 10, kOnLine = 8;
  std::uint64_t count = 0;
  for_each_facet_node(
      mesh, facets, [&](std::uint64_t /*row*/) { ++count; }, of_second);
  file.line(text("CMBLOCK,", name, ",NODE,", fixed_integer(count, kItemColumns)));
  file.line("(8i10)");
  std::string items;
  const auto add = [&](std::uint64_t row) {
    items += fixed_integer(row + 1, kItemColumns);
    if (items.size() < kOnLine * kItemColumns) return;
    file.line(items);
    items.clear();
  };
  for_each_facet_node(mesh, facets, add, of_second);
  if (!items.empty()) file.line(items);
}

}  // namespace

void write_cdb(TabledFile& file, GroupedMesh& mesh) {
  // The commands that select components take these three words for something else.
  const PlainNames names(mesh, {.max_bytes = 32,
                                .allows_dash = false,
                                .reserved = {"ALL", "STAT", "DEFA"},
                                .of_triangles = "F_"});
  std::uint64_t elements = mesh.tet_count();
  for_each_faces(mesh, names, [&](const Faces& faces) { elements += faces.facets.size(); });
  check_number(
      file.name, std::max(mesh.node_count(), elements),
      {.max = kMaxFieldNumber, .subject = "Ansys files have", .others = ".exo or .vtkhdf"});
  const auto labels = static_cast<std::int64_t>(mesh.table().size());
  const LabelNumbers numbers(mesh.table(), {.min = 1, .max = std::max<std::int64_t>(labels, 1)});

  write_cdb_head(file, mesh);
  write_cdb_nodes(file, mesh);
  file.line(text("EBLOCK,19,SOLID,", fixed_integer(elements, kColumns), ",",
                 fixed_integer(elements, kColumns)));
  file.line("(19i9)");
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    write_tets(file, mesh, mesh.label_tets()[rank], static_cast<std::uint64_t>(numbers[rank]));
  }
  std::uint64_t next = mesh.tet_count();
  for_each_faces(mesh, names, [&](const Faces& faces) {
    write_faces(file, mesh, faces, next);
    next += faces.facets.size();
  });
  file.line("       -1");
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    write_element_component(file, names.volume(rank), {mesh.label_tets()[rank]});
    file.line(text("MP,EX,", numbers[rank], ",1.0"));
    file.line(text("MP,PRXY,", numbers[rank], ",0.3"));
  }
  const std::vector<MaskGroup> masks = mask_groups(mesh);
  for (std::size_t i = 0; i < masks.size(); ++i) {
    std::vector<RowRange> tets;
    for (const Label rank : masks[i].ranks) tets.push_back(mesh.label_tets()[rank]);
    write_element_component(file, names.mask(i), tets);
  }
  next = mesh.tet_count();
  for_each_faces(mesh, names, [&](const Faces& faces) {
    write_element_component(file, faces.name, {{next, next + faces.facets.size()}});
    next += faces.facets.size();
  });
  for_each_named(mesh, names, [&](const NamedFacets& set) {
    write_node_component(file, mesh, set.name, set.group.facets, false);
    if (set.is_split) write_node_component(file, mesh, set.other, set.group.facets, true);
  });
  file.line("FINISH");
  file.commit(mesh, numbers);
}

}  // namespace mw::io
