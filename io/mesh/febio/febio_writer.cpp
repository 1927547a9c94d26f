// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes the geometry of an FEBio model.
#include "io/mesh/febio/febio_writer.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/file/sink/atomic_file.h"
#include "io/file/text_numbers.h"
#include "io/mesh/grouped/group_names.h"
#include "io/mesh/grouped/grouped_mesh.h"

namespace mw::io {
namespace {

constexpr std::string_view kHead =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<febio_spec version=\"4.0\">\n"
    "  <Module type=\"solid\"/>\n"
    "  <!-- The materials are placeholders: one for each label of the mesh. -->\n";

constexpr const char* kLowSet = "deck_low";
constexpr const char* kHighSet = "deck_high";

/// Returns the names of parts by rank of label, escaped.
std::vector<std::string> part_names(const GroupedMesh& mesh) {
  const GroupNames names(mesh);
  std::vector<std::string> out;
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    out.push_back(xml_escaped(names.volume(rank)));
  }
  return out;
}

/// Appends a cell, whose rows count from 1 in the file.
void append_cell(TabledFile& file, std::string_view tag, std::uint64_t id, const NodeRows& rows) {
  NumberLine line(',');
  for (const std::uint64_t row : rows) line.add(row + 1);
  file.append(text("      <", tag, " id=\"", id, "\">", line.numbers(), "</", tag, ">\n"));
}

/// Returns the nodes of a facet as they are seen from its other side.
NodeRows turned(const NodeRows& nodes) {
  constexpr std::array<std::size_t, 6> kOrder{0, 2, 1, 5, 4, 3};
  NodeRows out;
  for (std::size_t i = 0; i < nodes.size(); ++i) out.add({nodes.begin() + kOrder[i], 1});
  return out;
}

/// Writes materials by number, since FEBio takes ids only in their order.
void write_feb_materials(TabledFile& file, const std::vector<std::string>& parts,
                         const LabelNumbers& numbers) {
  std::vector<std::size_t> ranks(parts.size());
  for (Label rank = 0; rank < parts.size(); ++rank) {
    ranks[static_cast<std::size_t>(numbers[rank] - 1)] = rank;
  }
  file.append("  <Material>\n");
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    file.append(text("    <material id=\"", i + 1, "\" name=\"", parts[ranks[i]],
                     "\" type=\"neo-Hookean\">\n      <density>1</density>\n      <E>1</E>\n"
                     "      <v>0.3</v>\n    </material>\n"));
  }
  file.append("  </Material>\n");
}

void write_feb_nodes(TabledFile& file, GroupedMesh& mesh) {
  file.append("    <Nodes name=\"nodes\">\n");
  for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
    NumberLine line(',');
    for (const double x : mesh.node(row)) line.add(x);
    file.append(text("      <node id=\"", row + 1, "\">", line.numbers(), "</node>\n"));
  }
  file.append("    </Nodes>\n");
}

void write_feb_part(TabledFile& file, GroupedMesh& mesh, RowRange tets, const std::string& name) {
  const bool ten = has_middles(mesh.element());
  file.append(text("    <Elements type=\"", ten ? "tet10" : "tet4", "\" name=\"", name, "\">\n"));
  for (std::uint64_t tet = tets.begin; tet < tets.end; ++tet) {
    append_cell(file, "elem", tet + 1, mesh.tet_nodes(tet));
  }
  file.append("    </Elements>\n");
}

void write_feb_masks(TabledFile& file, const GroupedMesh& mesh) {
  const GroupNames names(mesh);
  const std::vector<MaskGroup> masks = mask_groups(mesh);
  for (std::size_t i = 0; i < masks.size(); ++i) {
    file.append(text("    <ElementSet name=\"", xml_escaped(names.mask(i)), "\">"));
    const char* between = "";
    for (const Label rank : masks[i].ranks) {
      const RowRange tets = mesh.label_tets()[rank];
      for (std::uint64_t tet = tets.begin; tet < tets.end; ++tet) {
        file.append(text(between, tet + 1));
        between = ",\n      ";
      }
    }
    file.append("</ElementSet>\n");
  }
}

/// REQUIRES: name is escaped.
void write_feb_surface(TabledFile& file, GroupedMesh& mesh, RowRange facets,
                       const std::string& name, bool is_turned) {
  const char* const tag = has_middles(mesh.element()) ? "tri6" : "tri3";
  file.append(text("    <Surface name=\"", name, "\">\n"));
  for (std::uint64_t i = facets.begin; i < facets.end; ++i) {
    const NodeRows nodes = mesh.facet_nodes(mesh.facet(i));
    append_cell(file, tag, i - facets.begin + 1, is_turned ? turned(nodes) : nodes);
  }
  file.append("    </Surface>\n");
}

void write_feb_surfaces(TabledFile& file, GroupedMesh& mesh) {
  const GroupNames names(mesh);
  for_each_facet_run(mesh, [&](const FacetGroup& run) {
    write_feb_surface(file, mesh, run.facets, xml_escaped(names.facets(run)), false);
    if (run.side != Side::kInterface) return;
    const FacetGroup seen_from_second{.first = run.second, .second = run.first};
    write_feb_surface(file, mesh, run.facets, xml_escaped(names.facets(seen_from_second)), true);
  });
}

void write_domains(TabledFile& file, const std::vector<std::string>& parts) {
  file.append("  <MeshDomains>\n");
  for (const std::string& name : parts) {
    file.append(text("    <SolidDomain name=\"", name, "\" mat=\"", name, "\"/>\n"));
  }
  file.append("  </MeshDomains>\n");
}

void write_end_sets(TabledFile& file, GroupedMesh& mesh, const DeckEnds& ends) {
  for (const bool is_low : {true, false}) {
    file.append(text("    <NodeSet name=\"", is_low ? kLowSet : kHighSet, "\">"));
    const char* between = "";
    for (std::uint64_t row = 0; row < mesh.node_count(); ++row) {
      const Position p = mesh.node(row);
      if (!(is_low ? ends.is_low(p) : ends.is_high(p))) continue;
      file.append(text(between, row + 1));
      between = ",\n      ";
    }
    file.append("</NodeSet>\n");
  }
}

void write_job(TabledFile& file, const DeckEnds& ends) {
  const std::string low = ends.are_sides() ? "@surface:z_min" : kLowSet;
  const std::string high = ends.are_sides() ? "@surface:z_max" : kHighSet;
  file.append(text("  <Boundary>\n    <bc name=\"held\" node_set=\"", low,
                   "\" type=\"zero displacement\">\n      <x_dof>1</x_dof>\n      "
                   "<y_dof>1</y_dof>\n      <z_dof>1</z_dof>\n    </bc>\n  </Boundary>\n"));
  file.append(
      "  <Step>\n    <step id=\"1\" name=\"pull\">\n      <Control>\n        "
      "<analysis>STATIC</analysis>\n        <time_steps>10</time_steps>\n        "
      "<step_size>0.1</step_size>\n        <solver type=\"solid\"/>\n      </Control>\n      "
      "<Boundary>\n");
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string axis(1, "xyz"[k]);
    file.append(text("        <bc name=\"pulled_", axis, "\" node_set=\"", high,
                     "\" type=\"prescribed displacement\">\n          <dof>", axis,
                     "</dof>\n          <value lc=\"1\">", ends.shift()[k],
                     "</value>\n          <relative>0</relative>\n        </bc>\n"));
  }
  file.append(
      "      </Boundary>\n    </step>\n  </Step>\n  <LoadData>\n    <load_controller id=\"1\" "
      "name=\"ramp\" type=\"loadcurve\">\n      <interpolate>LINEAR</interpolate>\n      "
      "<points>\n        <pt>0,0</pt>\n        <pt>1,1</pt>\n      </points>\n    "
      "</load_controller>\n  </LoadData>\n  <Output>\n    <plotfile type=\"febio\">\n      "
      "<var type=\"displacement\"/>\n      <var type=\"stress\"/>\n    </plotfile>\n  "
      "</Output>\n");
}

}  // namespace

void write_feb(TabledFile& file, GroupedMesh& mesh) {
  const auto labels = static_cast<std::int64_t>(mesh.table().size());
  const LabelNumbers numbers(mesh.table(), {.min = 1, .max = labels});
  const std::vector<std::string> parts = part_names(mesh);
  file.append(kHead);
  write_feb_materials(file, parts, numbers);
  file.append("  <Mesh>\n");
  write_feb_nodes(file, mesh);
  for (std::size_t rank = 0; rank < parts.size(); ++rank) {
    write_feb_part(file, mesh, mesh.label_tets()[rank], parts[rank]);
  }
  write_feb_masks(file, mesh);
  write_feb_surfaces(file, mesh);
  std::optional<DeckEnds> ends;
  if (file.extras.deck == Deck::kStatic && mesh.tet_count() > 0) ends.emplace(mesh);
  if (ends && !ends->are_sides()) write_end_sets(file, mesh, *ends);
  file.append("  </Mesh>\n");
  write_domains(file, parts);
  if (ends) write_job(file, *ends);
  file.append("</febio_spec>\n");
  file.commit(mesh, numbers);
}

}  // namespace mw::io
