// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a grouped mesh as the mesh of an Abaqus input file.
#include "io/mesh/abaqus/inp_writer.h"

#include "io/file/errors.h"
#include "io/file/scratch/external_sort.h"
#include "io/mesh/grouped/group_names.h"
#include "io/mesh/medit/medit.h"

namespace mw::io {
namespace {

/// Two lines, "**" in front: the format has no end, so a file that has the first and not the second
/// was cut.
constexpr std::string_view kInpBegins = "** This mesh ends with a comment END OF MESH.";
constexpr std::string_view kInpEnds = "** END OF MESH";

constexpr std::uint64_t kMaxNumber = 999'999'999;

/// "1, 2, 3", numbers from 1 on for rows from 0 on.
void append_rows(std::string& line, std::span<const std::uint64_t> rows) {
  for (const std::uint64_t row : rows) line += text(", ", row + 1);
}

/// The face of a C3D4 or C3D10 that lies opposite to a corner: S1 has its nodes 1 2 3, S2 1 4 2,
/// S3 2 4 3, S4 3 4 1.
const char* face_name(std::uint64_t opposite) {
  constexpr std::array<const char*, 4> kFaces{", S3", ", S4", ", S2", ", S1"};
  return kFaces[opposite];
}

/// `** label 7 "name" 255 0 0 255`, as in MEDIT files; empty where that is longer than the 256
/// characters that Abaqus allows.
std::string inp_comment(const LabelName& row, bool is_signed) {
  constexpr std::size_t kMaxBytes = 256;
  std::string line = medit_comment(row, is_signed);
  line.replace(0, 1, "**");
  line.pop_back();
  return line.size() > kMaxBytes ? std::string() : line;
}

}  // namespace

void InpWriter::write(GroupedMesh& mesh) {
  check_counts(mesh);
  write_head(mesh);
  write_nodes(mesh);
  for (Label rank = 0; rank < mesh.table().size(); ++rank) write_elements(mesh, rank);
  const std::vector<FacetGroup>& groups = mesh.facet_groups();
  for (std::size_t g = 0; g < groups.size();) {
    // Groups of a side, which have one name, are neighbours.
    const std::string name = plain_facet_name(mesh.table(), groups[g]);
    RowRange facets = groups[g].facets;
    while (++g < groups.size() && plain_facet_name(mesh.table(), groups[g]) == name) {
      facets.end = groups[g].facets.end;
    }
    write_node_set(mesh, name, facets);
    write_surface(mesh, name, facets);
  }
  line(kInpEnds);
  file_.commit();
}

void InpWriter::check_counts(const GroupedMesh& mesh) const {
  const std::uint64_t max = std::max(mesh.node_count(), mesh.tet_count());
  if (max <= kMaxNumber) return;
  throw Error(ErrorKind::kUsage, text(name_, ": Abaqus has numbers up to ", kMaxNumber, ", ", max,
                                      " are needed; write .msh or .vtkhdf"));
}

void InpWriter::write_head(const GroupedMesh& mesh) {
  line("*HEADING");
  line(text("Tetrahedra of ", mesh.table().size(), " labels"));
  line(kInpBegins);
  line("** Element set LABEL_7: label 7 (LABEL_M7: -7).");
  line("** Surface FACE_1_2: where labels 1 and 2 meet, faces of the elements of label 1.");
  line("** Surfaces X_MIN to Z_MAX: sides of the box; OUTER: what else bounds the mesh.");
  line("** Node sets have the nodes of the surface of the same name.");
  for (const LabelName& row : mesh.names().rows()) {
    const std::string comment = inp_comment(row, mesh.table().is_signed());
    if (!comment.empty()) line(comment);
  }
}

void InpWriter::write_nodes(GroupedMesh& mesh) {
  line("*NODE");
  for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
    const Position p = mesh.node(row);
    line(text(row + 1, ", ", p[0], ", ", p[1], ", ", p[2]));
  }
}

void InpWriter::write_elements(GroupedMesh& mesh, Label rank) {
  const bool quadratic = mesh.element() == Element::kTet10;
  line(text("*ELEMENT, TYPE=", quadratic ? "C3D10" : "C3D4",
            ", ELSET=", plain_volume_name(mesh.table(), rank)));
  const RowRange tets = mesh.label_tets()[rank];
  for (std::uint64_t t = tets.begin; t < tets.end; ++t) {
    std::string numbers = text(t + 1);
    append_rows(numbers, mesh.tet(t));
    if (quadratic) append_rows(numbers, mesh.middles(t));
    line(numbers);
  }
}

void InpWriter::write_surface(GroupedMesh& mesh, const std::string& name, RowRange facets) {
  line("*SURFACE, TYPE=ELEMENT, NAME=", name);
  for (std::uint64_t f = facets.begin; f < facets.end; ++f) {
    const Facet facet = mesh.facet(f);
    line(text(facet.tet + 1, face_name(facet.opposite)));
  }
}

void InpWriter::write_node_set(GroupedMesh& mesh, const std::string& name, RowRange facets) {
  constexpr std::size_t kSortBytes = 8 << 20;
  constexpr std::size_t kMaxItems = 16;  // of a data line
  ExternalSort<1> rows(folder_, kSortBytes);
  const auto add = [&](std::span<const std::uint64_t> more) {
    for (const std::uint64_t row : more) rows.add({row});
  };
  for (std::uint64_t f = facets.begin; f < facets.end; ++f) {
    const Facet facet = mesh.facet(f);
    add(facet.rows);
    if (mesh.element() == Element::kTet10) add(mesh.facet_middles(facet));
  }
  line("*NSET, NSET=", name);
  std::string items;
  std::size_t count = 0;
  std::uint64_t last = mesh.node_count();
  rows.each([&](const std::array<std::uint64_t, 1>& row) {
    if (row[0] == last) return;
    last = row[0];
    if (count++ == kMaxItems) {
      line(items);
      items.clear();
      count = 1;
    }
    items += text(items.empty() ? "" : ", ", row[0] + 1);
  });
  line(items);
}

void InpWriter::line(std::string_view line, std::string_view more) {
  file_.append(line);
  file_.append(more);
  file_.append("\n");
}

}  // namespace mw::io
