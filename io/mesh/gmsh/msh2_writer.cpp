// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a grouped mesh as Gmsh's .msh 2.2.
#include "io/file/errors.h"
#include "io/file/sink/atomic_file.h"
#include "io/mesh/gmsh/msh.h"
#include "io/mesh/gmsh/msh_common.h"

namespace mw::io {

void Msh2Writer::write(GroupedMesh& mesh) {
  const LabelNumbers numbers = msh_numbers(mesh);
  out_.begin_section("MeshFormat");
  out_.add_line("2.2 0 8");
  out_.end_section("MeshFormat");
  write_record(out_, mesh);
  write_physical_names(out_, mesh, numbers, false);
  write_nodes(mesh);
  write_elements(mesh, numbers);
  write_element_data(out_, mesh);
  tables_.write_with(out_, mesh, numbers);
}

void Msh2Writer::write_nodes(GroupedMesh& mesh) {
  out_.begin_section("Nodes");
  out_.add_line(text(mesh.node_count()));
  for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
    out_.put(row + 1);
    for (const double x : mesh.node(row)) out_.put(x);
    out_.end_row();
  }
  out_.end_section("Nodes");
}

void Msh2Writer::write_elements(GroupedMesh& mesh, const LabelNumbers& numbers) {
  const bool quadratic = has_middles(mesh.element());
  out_.begin_section("Elements");
  out_.add_line(text(mesh.facet_count() + mesh.tet_count() + mesh.wedge_count()));
  const FacetGroups& groups = mesh.facet_groups();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (std::uint64_t f = groups[g].facets.begin; f < groups[g].facets.end; ++f) {
      write_element(f + 1, quadratic ? kMshTriangle6 : kMshTriangle3,
                    physical_surface(numbers, groups[g], g), surface_tag(numbers, g),
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
      write_element(mesh.facet_count() + t + 1, quadratic ? kMshTet10 : kMshTet4, numbers[rank],
                    numbers[rank], ordered);
    }
  }
  for (std::size_t g = 0; g < mesh.wedge_groups().size(); ++g) {
    const RowRange wedges = mesh.wedge_groups()[g].wedges;
    const std::int32_t volume = wedge_volume(numbers, mesh, g);
    for (std::uint64_t w = wedges.begin; w < wedges.end; ++w) {
      write_element(mesh.facet_count() + mesh.tet_count() + w + 1, kMshPrism6, volume, volume,
                    mesh.wedge_nodes(mesh.wedge(w)));
    }
  }
  out_.end_section("Elements");
}

void Msh2Writer::write_element(std::uint64_t number, std::int32_t type, std::int64_t physical,
                               std::int64_t entity, const NodeRows& nodes) {
  constexpr std::int32_t kTags = 2;
  out_.put(number);
  out_.put(type);
  out_.put(kTags);
  out_.put(static_cast<std::uint64_t>(physical));
  out_.put(static_cast<std::uint64_t>(entity));
  for (const std::uint64_t row : nodes) out_.put(row + 1);
  out_.end_row();
}

}  // namespace mw::io
