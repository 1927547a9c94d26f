// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a grouped mesh as Gmsh's .msh 4.1.
#include "io/mesh/gmsh/msh.h"

#include <algorithm>

#include "io/file/scratch/external_sort.h"
#include "io/file/sink/atomic_file.h"
#include "io/mesh/gmsh/msh_common.h"

namespace mw::io {
namespace {

/// Calls visit(tags) for each label in their order: the surfaces around it, negative where their
/// normals point into it.
template <class Visit>
void for_each_boundary(const GroupedMesh& mesh, const LabelNumbers& labels, Visit visit) {
  constexpr std::size_t kSortBytes = 8 << 20;
  ExternalSort<2> uses(mesh.folder(), kSortBytes);  // rank of label, 2 * group + (1 if second)
  const FacetGroups& groups = mesh.facet_groups();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const FacetGroup group = groups[g];
    uses.add({group.first, 2 * g});
    if (group.second != kExterior) uses.add({group.second, 2 * g + 1});
  }
  Label rank = 0;
  std::vector<std::int32_t> tags;  // of the label `rank`
  const auto visit_up_to = [&](std::uint64_t end) {
    for (; rank < end; ++rank) {
      visit(tags);
      tags.clear();
    }
  };
  uses.each([&](const std::array<std::uint64_t, 2>& use) {
    visit_up_to(use[0]);
    const std::int32_t tag = surface_tag(labels, use[1] / 2);
    tags.push_back(use[1] % 2 == 0 ? tag : -tag);
  });
  visit_up_to(mesh.table().size());
}

/// The contents of the mesh that all sections need.
struct Contents {
  GroupedMesh& mesh;
  LabelNumbers numbers;
  NodeClasses classes;
};

/// The numbers by which Gmsh knows an entity.
struct Tag {
  std::int32_t dimension = 0;
  std::int32_t tag = 0;
};

Tag tag_of(const Contents& contents, std::size_t entity) {
  const std::size_t groups = contents.mesh.facet_groups().size();
  const std::size_t labels = contents.mesh.table().size();
  if (entity < groups) return {kMshSurface, surface_tag(contents.numbers, entity)};
  if (labels == 0) return {kMshVolume, 1};
  if (entity >= groups + labels) {
    return {kMshVolume, wedge_volume(contents.numbers, contents.mesh, entity - groups - labels)};
  }
  const auto rank = static_cast<Label>(entity - groups);
  return {kMshVolume, static_cast<std::int32_t>(contents.numbers[rank])};
}

void write_format(MshEncoder& out) {
  out.begin_section("MeshFormat");
  out.add_line(out.ascii() ? "4.1 0 8" : "4.1 1 8");
  if (out.ascii()) {
    out.add_line("$EndMeshFormat");
    return;
  }
  out.put(std::int32_t{1});  // tells the byte order
  out.end_row();
  out.end_section("MeshFormat");
}

/// Puts the tag, box and physical groups of an entity; what bounds it comes behind.
void put_entity(MshEncoder& out, Contents& contents, std::size_t entity,
                const std::vector<std::int32_t>& physical) {
  out.put(tag_of(contents, entity).tag);
  const EntityBox box = contents.classes.box(entity);
  for (const double x : box.lo) out.put(x);
  for (const double x : box.hi) out.put(x);
  out.put(std::uint64_t{physical.size()});
  for (const std::int32_t group : physical) out.put(group);
}

void put_volumes(MshEncoder& out, Contents& contents) {
  const GroupedMesh& mesh = contents.mesh;
  std::size_t entity = mesh.facet_groups().size();
  const std::vector<std::vector<std::int32_t>> masks = mask_volumes(contents.numbers, mesh);
  std::size_t rank = 0;
  for_each_boundary(mesh, contents.numbers, [&](std::span<const std::int32_t> surfaces) {
    // Readers that know one physical group take the first, which is the label's.
    std::vector<std::int32_t> physical{tag_of(contents, entity).tag};
    physical.insert(physical.end(), masks[rank].begin(), masks[rank].end());
    put_entity(out, contents, entity, physical);
    ++entity;
    ++rank;
    out.put(std::uint64_t{surfaces.size()});
    for (const std::int32_t tag : surfaces) out.put(tag);
    out.end_row();
  });
  for (std::size_t g = 0; g < mesh.wedge_groups().size(); ++g, ++entity) {
    put_entity(out, contents, entity, {tag_of(contents, entity).tag});
    out.put(std::uint64_t{0});  // no surfaces
    out.end_row();
  }
}

void write_entities(MshEncoder& out, Contents& contents) {
  GroupedMesh& mesh = contents.mesh;
  const FacetGroups& groups = mesh.facet_groups();
  out.begin_section("Entities");
  for (const std::uint64_t count : {std::uint64_t{0}, std::uint64_t{0}, groups.size(),
                                    mesh.table().size() + mesh.wedge_groups().size()}) {
    out.put(count);
  }
  out.end_row();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    put_entity(out, contents, g, {physical_surface(contents.numbers, groups[g], g)});
    out.put(std::uint64_t{0});  // no curves
    out.end_row();
  }
  put_volumes(out, contents);
  out.end_section("Entities");
}

void put_nodes(MshEncoder& out, Contents& contents, std::size_t entity) {
  const auto [dimension, tag] = tag_of(contents, entity);
  const RowRange positions = contents.classes.nodes(entity);
  for (const std::int32_t number : {dimension, tag, 0}) out.put(number);  // 0: not parametric
  out.put(positions.size());
  out.end_row();
  for (std::uint64_t i = positions.begin; i < positions.end; ++i) {
    out.put(contents.classes.row(i) + 1);
    out.end_row();
  }
  for (std::uint64_t i = positions.begin; i < positions.end; ++i) {
    for (const double x : contents.mesh.node(contents.classes.row(i))) out.put(x);
    out.end_row();
  }
}

void write_nodes(MshEncoder& out, Contents& contents) {
  std::uint64_t blocks = 0;
  for (std::size_t e = 0; e < contents.classes.entities(); ++e) {
    if (contents.classes.nodes(e).size() > 0) ++blocks;
  }
  const std::uint64_t nodes = contents.mesh.node_count();
  out.begin_section("Nodes");
  for (const std::uint64_t count : {blocks, nodes, std::min<std::uint64_t>(nodes, 1), nodes}) {
    out.put(count);
  }
  out.end_row();
  for (std::size_t e = 0; e < contents.classes.entities(); ++e) {
    if (contents.classes.nodes(e).size() > 0) put_nodes(out, contents, e);
  }
  out.end_section("Nodes");
}

void put_facets(MshEncoder& out, GroupedMesh& mesh, RowRange facets) {
  for (std::uint64_t f = facets.begin; f < facets.end; ++f) {
    out.put(f + 1);
    for (const std::uint64_t row : mesh.facet_nodes(mesh.facet(f))) out.put(row + 1);
    out.end_row();
  }
}

void put_wedges(MshEncoder& out, const Contents& contents, std::size_t entity) {
  GroupedMesh& mesh = contents.mesh;
  const std::size_t behind_tets = mesh.facet_groups().size() + mesh.table().size();
  const RowRange wedges = mesh.wedge_groups()[entity - behind_tets].wedges;
  const auto [dimension, tag] = tag_of(contents, entity);
  for (const std::int32_t number : {dimension, tag, kMshPrism6}) out.put(number);
  out.put(wedges.size());
  out.end_row();
  for (std::uint64_t w = wedges.begin; w < wedges.end; ++w) {
    out.put(mesh.facet_count() + mesh.tet_count() + w + 1);
    for (const std::uint64_t row : mesh.wedge_nodes(mesh.wedge(w))) out.put(row + 1);
    out.end_row();
  }
}

void put_tets(MshEncoder& out, GroupedMesh& mesh, RowRange tets) {
  for (std::uint64_t t = tets.begin; t < tets.end; ++t) {
    out.put(mesh.facet_count() + t + 1);
    const NodeRows nodes = mesh.tet_nodes(t);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      out.put(nodes.begin()[kMshTetOrder[i]] + 1);
    }
    out.end_row();
  }
}

void write_elements(MshEncoder& out, const Contents& contents) {
  GroupedMesh& mesh = contents.mesh;
  const bool quadratic = has_middles(mesh.element());
  const std::size_t groups = mesh.facet_groups().size();
  const std::size_t behind_tets = groups + mesh.table().size();
  const std::size_t blocks = behind_tets + mesh.wedge_groups().size();
  const std::uint64_t elements = mesh.facet_count() + mesh.tet_count() + mesh.wedge_count();
  out.begin_section("Elements");
  for (const std::uint64_t count :
       {std::uint64_t{blocks}, elements, std::min<std::uint64_t>(elements, 1), elements}) {
    out.put(count);
  }
  out.end_row();
  for (std::size_t e = 0; e < behind_tets; ++e) {
    const auto [dimension, tag] = tag_of(contents, e);
    const bool is_surface = e < groups;
    const RowRange range =
        is_surface ? mesh.facet_groups()[e].facets : mesh.label_tets()[e - groups];
    out.put(dimension);
    out.put(tag);
    if (is_surface) {
      out.put(quadratic ? kMshTriangle6 : kMshTriangle3);
    } else {
      out.put(quadratic ? kMshTet10 : kMshTet4);
    }
    out.put(range.size());
    out.end_row();
    is_surface ? put_facets(out, mesh, range) : put_tets(out, mesh, range);
  }
  for (std::size_t e = behind_tets; e < blocks; ++e) put_wedges(out, contents, e);
  out.end_section("Elements");
}

}  // namespace

void write_msh(MshFiles& files, GroupedMesh& mesh) {
  MshEncoder& out = files.out;
  if (!mesh.header().values.empty()) {
    check_element_data(out, mesh.facet_count() + mesh.tet_count() + mesh.wedge_count());
  }
  Contents contents{mesh, msh_numbers(mesh), NodeClasses(mesh)};
  write_format(out);
  write_record(out, mesh);
  write_physical_names(out, mesh, contents.numbers, MshNames::kForPeople);
  write_entities(out, contents);
  write_nodes(out, contents);
  write_elements(out, contents);
  write_element_data(out, mesh);
  files.tables.write_with(out, mesh, contents.numbers);
}

}  // namespace mw::io
