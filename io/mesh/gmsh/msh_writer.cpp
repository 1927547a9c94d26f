// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a grouped mesh as Gmsh's .msh 4.1.
#include "io/mesh/gmsh/msh.h"

#include <algorithm>
#include <limits>

#include "io/file/errors.h"
#include "io/file/sink/atomic_file.h"
#include "io/mesh/gmsh/msh_elements.h"

namespace mw::io {
namespace {

constexpr std::int32_t kSurface = 2;
constexpr std::int32_t kVolumeDimension = 3;
/// Gmsh has the middle of edge 2 3 before that of 1 3.
constexpr std::array<std::size_t, 10> kGmshOrder{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

/// Surfaces have numbers above those of labels: many programs have one space of numbers for all
/// dimensions.
LabelNumbers numbers_of(const GroupedMesh& mesh) {
  const auto surfaces = static_cast<std::int64_t>(kSides + mesh.facet_groups().size());
  return LabelNumbers(mesh.table(), {.max = std::numeric_limits<std::int32_t>::max() - surfaces});
}

std::int32_t above(const LabelNumbers& labels, std::size_t number) {
  return static_cast<std::int32_t>(labels.largest() + static_cast<std::int64_t>(number));
}

std::int32_t surface_tag(const LabelNumbers& labels, std::size_t group) {
  return above(labels, group + 1);
}

/// Interfaces are the first groups.
std::int32_t physical_surface(const LabelNumbers& labels, const FacetGroup& group,
                              std::size_t index) {
  const bool interface = group.side == Side::kInterface;
  return above(labels, interface ? kSides + index : static_cast<std::size_t>(group.side));
}

/// Gmsh documents 127 bytes and knows no way to write a quote.
std::string gmsh_name(std::string name, const std::string& plain) {
  constexpr std::size_t kMaxBytes = 127;
  if (name.size() > kMaxBytes) return plain;
  std::replace(name.begin(), name.end(), '"', '\'');
  return name;
}

std::string name_line(std::int32_t dimension, std::int64_t tag, const std::string& name) {
  return text(dimension, " ", tag, " \"", name, "\"");
}

/// By label, the surfaces around it; negative where their normals point into it.
std::vector<std::vector<std::int32_t>> surfaces_of(const GroupedMesh& mesh,
                                                   const LabelNumbers& labels) {
  std::vector<std::vector<std::int32_t>> tags(mesh.table().size());
  const std::vector<FacetGroup>& groups = mesh.facet_groups();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::int32_t tag = surface_tag(labels, g);
    tags[groups[g].first].push_back(tag);
    if (groups[g].second != kExterior) tags[groups[g].second].push_back(-tag);
  }
  return tags;
}

}  // namespace

void MshWriter::write(GroupedMesh& mesh) {
  Contents contents{mesh, numbers_of(mesh), NodeClasses(mesh, folder_)};
  write_format();
  write_physical_names(contents);
  write_entities(contents);
  write_nodes(contents);
  write_elements(contents);
  append_label_table(labels_, mesh.table(), mesh.names(), contents.numbers);
  commit_together({labels_, out_.file()});
}

MshWriter::Tag MshWriter::tag_of(const Contents& contents, std::size_t entity) {
  const std::size_t groups = contents.mesh.facet_groups().size();
  if (entity < groups) return {kSurface, surface_tag(contents.numbers, entity)};
  if (contents.mesh.table().size() == 0) return {kVolumeDimension, 1};
  const auto rank = static_cast<Label>(entity - groups);
  return {kVolumeDimension, static_cast<std::int32_t>(contents.numbers[rank])};
}

void MshWriter::write_format() {
  out_.begin_section("MeshFormat");
  out_.add_line(out_.ascii() ? "4.1 0 8" : "4.1 1 8");
  if (out_.ascii()) {
    out_.add_line("$EndMeshFormat");
    return;
  }
  out_.put(std::int32_t{1});  // tells the byte order
  out_.end_row();
  out_.end_section("MeshFormat");
}

void MshWriter::write_physical_names(const Contents& contents) {
  GroupedMesh& mesh = contents.mesh;
  const GroupNames names(mesh);
  std::vector<std::string> lines;
  for (std::size_t g = 0; g < mesh.facet_groups().size(); ++g) {
    const FacetGroup& group = mesh.facet_groups()[g];
    const bool new_group =
        g == 0 || group.side == Side::kInterface || group.side != mesh.facet_groups()[g - 1].side;
    if (!new_group) continue;
    const std::string plain = plain_facet_name(mesh.table(), group);
    lines.push_back(name_line(kSurface, physical_surface(contents.numbers, group, g),
                              gmsh_name(names.facets(group), plain)));
  }
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    const std::string plain = plain_volume_name(mesh.table(), rank);
    lines.push_back(
        name_line(kVolumeDimension, contents.numbers[rank], gmsh_name(names.volume(rank), plain)));
  }
  out_.begin_section("PhysicalNames");
  out_.add_line(text(lines.size()));
  for (const std::string& line : lines) out_.add_line(line);
  out_.add_line("$EndPhysicalNames");
}

void MshWriter::write_entities(const Contents& contents) {
  GroupedMesh& mesh = contents.mesh;
  const std::vector<FacetGroup>& groups = mesh.facet_groups();
  out_.begin_section("Entities");
  for (const std::uint64_t count :
       {std::uint64_t{0}, std::uint64_t{0}, groups.size(), mesh.table().size()}) {
    out_.put(count);
  }
  out_.end_row();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    put_entity(contents, g, physical_surface(contents.numbers, groups[g], g));
    out_.put(std::uint64_t{0});  // no curves
    out_.end_row();
  }
  const std::vector<std::vector<std::int32_t>> surfaces = surfaces_of(mesh, contents.numbers);
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    const std::size_t entity = groups.size() + rank;
    put_entity(contents, entity, tag_of(contents, entity).tag);
    out_.put(std::uint64_t{surfaces[rank].size()});
    for (const std::int32_t tag : surfaces[rank]) out_.put(tag);
    out_.end_row();
  }
  out_.end_section("Entities");
}

/// Tag, box and physical group; what bounds it comes behind.
void MshWriter::put_entity(const Contents& contents, std::size_t entity, std::int32_t physical) {
  out_.put(tag_of(contents, entity).tag);
  const EntityBox& box = contents.classes.box(entity);
  for (const double x : box.lo) out_.put(x);
  for (const double x : box.hi) out_.put(x);
  out_.put(std::uint64_t{1});
  out_.put(physical);
}

void MshWriter::write_nodes(Contents& contents) {
  std::uint64_t blocks = 0;
  for (std::size_t e = 0; e < contents.classes.entities(); ++e) {
    if (contents.classes.nodes(e).size() > 0) ++blocks;
  }
  const std::uint64_t nodes = contents.mesh.node_count();
  out_.begin_section("Nodes");
  for (const std::uint64_t count : {blocks, nodes, std::min<std::uint64_t>(nodes, 1), nodes}) {
    out_.put(count);
  }
  out_.end_row();
  for (std::size_t e = 0; e < contents.classes.entities(); ++e) {
    if (contents.classes.nodes(e).size() > 0) put_nodes(contents, e);
  }
  out_.end_section("Nodes");
}

void MshWriter::put_nodes(Contents& contents, std::size_t entity) {
  const auto [dimension, tag] = tag_of(contents, entity);
  const RowRange positions = contents.classes.nodes(entity);
  for (const std::int32_t number : {dimension, tag, 0}) out_.put(number);  // 0: not parametric
  out_.put(positions.size());
  out_.end_row();
  for (std::uint64_t i = positions.begin; i < positions.end; ++i) {
    out_.put(contents.classes.row(i) + 1);
    out_.end_row();
  }
  for (std::uint64_t i = positions.begin; i < positions.end; ++i) {
    for (const double x : contents.mesh.node(contents.classes.row(i))) out_.put(x);
    out_.end_row();
  }
}

void MshWriter::write_elements(const Contents& contents) {
  GroupedMesh& mesh = contents.mesh;
  const bool quadratic = mesh.element() == Element::kTet10;
  const std::size_t groups = mesh.facet_groups().size();
  const std::size_t blocks = groups + mesh.table().size();
  const std::uint64_t elements = mesh.facet_count() + mesh.tet_count();
  out_.begin_section("Elements");
  for (const std::uint64_t count :
       {std::uint64_t{blocks}, elements, std::min<std::uint64_t>(elements, 1), elements}) {
    out_.put(count);
  }
  out_.end_row();
  for (std::size_t e = 0; e < blocks; ++e) {
    const auto [dimension, tag] = tag_of(contents, e);
    const bool is_surface = e < groups;
    const RowRange range =
        is_surface ? mesh.facet_groups()[e].facets : mesh.label_tets()[e - groups];
    out_.put(dimension);
    out_.put(tag);
    if (is_surface) {
      out_.put(quadratic ? kMshTriangle6 : kMshTriangle3);
    } else {
      out_.put(quadratic ? kMshTet10 : kMshTet4);
    }
    out_.put(range.size());
    out_.end_row();
    is_surface ? put_facets(mesh, range) : put_tets(mesh, range);
  }
  out_.end_section("Elements");
}

void MshWriter::put_facets(GroupedMesh& mesh, RowRange facets) {
  for (std::uint64_t f = facets.begin; f < facets.end; ++f) {
    out_.put(f + 1);
    for (const std::uint64_t row : mesh.facet_nodes(mesh.facet(f))) out_.put(row + 1);
    out_.end_row();
  }
}

void MshWriter::put_tets(GroupedMesh& mesh, RowRange tets) {
  for (std::uint64_t t = tets.begin; t < tets.end; ++t) {
    out_.put(mesh.facet_count() + t + 1);
    const NodeRows nodes = mesh.tet_nodes(t);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      out_.put(nodes.begin()[kGmshOrder[i]] + 1);
    }
    out_.end_row();
  }
}

}  // namespace mw::io
