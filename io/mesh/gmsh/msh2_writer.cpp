// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a grouped mesh as Gmsh's .msh 2.2.
#include "io/file/errors.h"
#include "io/file/sink/atomic_file.h"
#include "io/mesh/gmsh/msh.h"
#include "io/mesh/gmsh/msh_common.h"

namespace mw::io {
namespace {

void write_nodes(MshEncoder& out, GroupedMesh& mesh) {
  out.begin_section("Nodes");
  out.add_line(text(mesh.node_count()));
  for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
    out.put(row + 1);
    for (const double x : mesh.node(row)) out.put(x);
    out.end_row();
  }
  out.end_section("Nodes");
}

/// tags are the physical group and the entity of the element; nodes are in Gmsh's order.
void write_element(MshEncoder& out, std::uint64_t number, std::int32_t type,
                   const std::array<std::int64_t, 2>& tags, const NodeRows& nodes) {
  out.put(number);
  out.put(type);
  out.put(static_cast<std::int32_t>(tags.size()));
  for (const std::int64_t tag : tags) out.put(static_cast<std::uint64_t>(tag));
  for (const std::uint64_t row : nodes) out.put(row + 1);
  out.end_row();
}

void write_elements(MshEncoder& out, GroupedMesh& mesh, const LabelNumbers& numbers) {
  const bool quadratic = has_middles(mesh.element());
  out.begin_section("Elements");
  out.add_line(text(mesh.facet_count() + mesh.tet_count() + mesh.wedge_count()));
  const FacetGroups& groups = mesh.facet_groups();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (std::uint64_t f = groups[g].facets.begin; f < groups[g].facets.end; ++f) {
      write_element(out, f + 1, quadratic ? kMshTriangle6 : kMshTriangle3,
                    {physical_surface(numbers, groups[g], g), surface_tag(numbers, g)},
                    mesh.facet_nodes(mesh.facet(f)));
    }
  }
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    const RowRange tets = mesh.label_tets()[rank];
    for (std::uint64_t t = tets.begin; t < tets.end; ++t) {
      const NodeRows nodes = mesh.tet_nodes(t);
      NodeRows ordered;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        ordered.add({nodes.begin() + kMshTetOrder[i], 1});
      }
      write_element(out, mesh.facet_count() + t + 1, quadratic ? kMshTet10 : kMshTet4,
                    {numbers[rank], numbers[rank]}, ordered);
    }
  }
  for (std::size_t g = 0; g < mesh.wedge_groups().size(); ++g) {
    const RowRange wedges = mesh.wedge_groups()[g].wedges;
    const std::int32_t volume = wedge_volume(numbers, mesh, g);
    for (std::uint64_t w = wedges.begin; w < wedges.end; ++w) {
      write_element(out, mesh.facet_count() + mesh.tet_count() + w + 1, kMshPrism6,
                    {volume, volume}, mesh.wedge_nodes(mesh.wedge(w)));
    }
  }
  out.end_section("Elements");
}

}  // namespace

void write_msh2(MshFiles& files, GroupedMesh& mesh) {
  MshEncoder& out = files.out;
  const LabelNumbers numbers = msh_numbers(mesh);
  out.begin_section("MeshFormat");
  out.add_line("2.2 0 8");
  out.end_section("MeshFormat");
  write_record(out, mesh);
  write_physical_names(out, mesh, numbers, MshNames::kPlain);
  write_nodes(out, mesh);
  write_elements(out, mesh, numbers);
  write_element_data(out, mesh);
  files.tables.write_with(out, mesh, numbers);
}

}  // namespace mw::io
