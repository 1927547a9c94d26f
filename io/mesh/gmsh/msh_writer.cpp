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

}  // namespace

void MshWriter::write(GroupedMesh& mesh) {
  if (!mesh.header().values.empty()) {
    check_element_data(out_, mesh.facet_count() + mesh.tet_count() + mesh.wedge_count());
  }
  Contents contents{mesh, msh_numbers(mesh), NodeClasses(mesh)};
  write_format();
  write_record(out_, mesh);
  write_physical_names(out_, mesh, contents.numbers, true);
  write_entities(contents);
  write_nodes(contents);
  write_elements(contents);
  write_element_data(out_, mesh);
  tables_.write_with(out_, mesh, contents.numbers);
}

MshWriter::Tag MshWriter::tag_of(const Contents& contents, std::size_t entity) {
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

void MshWriter::write_entities(Contents& contents) {
  GroupedMesh& mesh = contents.mesh;
  const FacetGroups& groups = mesh.facet_groups();
  out_.begin_section("Entities");
  for (const std::uint64_t count : {std::uint64_t{0}, std::uint64_t{0}, groups.size(),
                                    mesh.table().size() + mesh.wedge_groups().size()}) {
    out_.put(count);
  }
  out_.end_row();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    put_entity(contents, g, {physical_surface(contents.numbers, groups[g], g)});
    out_.put(std::uint64_t{0});  // no curves
    out_.end_row();
  }
  put_volumes(contents);
  out_.end_section("Entities");
}

void MshWriter::put_volumes(Contents& contents) {
  const GroupedMesh& mesh = contents.mesh;
  std::size_t entity = mesh.facet_groups().size();
  const std::vector<std::vector<std::int32_t>> masks = mask_volumes(contents.numbers, mesh);
  std::size_t rank = 0;
  for_each_boundary(mesh, contents.numbers, [&](std::span<const std::int32_t> surfaces) {
    // Readers that know one physical group take the first, which is the label's.
    std::vector<std::int32_t> physical{tag_of(contents, entity).tag};
    physical.insert(physical.end(), masks[rank].begin(), masks[rank].end());
    put_entity(contents, entity, physical);
    ++entity;
    ++rank;
    out_.put(std::uint64_t{surfaces.size()});
    for (const std::int32_t tag : surfaces) out_.put(tag);
    out_.end_row();
  });
  for (std::size_t g = 0; g < mesh.wedge_groups().size(); ++g, ++entity) {
    put_entity(contents, entity, {tag_of(contents, entity).tag});
    out_.put(std::uint64_t{0});  // no surfaces
    out_.end_row();
  }
}

/// Puts the tag, box and physical groups of an entity; what bounds it comes behind.
void MshWriter::put_entity(Contents& contents, std::size_t entity,
                           const std::vector<std::int32_t>& physical) {
  out_.put(tag_of(contents, entity).tag);
  const EntityBox box = contents.classes.box(entity);
  for (const double x : box.lo) out_.put(x);
  for (const double x : box.hi) out_.put(x);
  out_.put(std::uint64_t{physical.size()});
  for (const std::int32_t group : physical) out_.put(group);
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
  const bool quadratic = has_middles(mesh.element());
  const std::size_t groups = mesh.facet_groups().size();
  const std::size_t behind_tets = groups + mesh.table().size();
  const std::size_t blocks = behind_tets + mesh.wedge_groups().size();
  const std::uint64_t elements = mesh.facet_count() + mesh.tet_count() + mesh.wedge_count();
  out_.begin_section("Elements");
  for (const std::uint64_t count :
       {std::uint64_t{blocks}, elements, std::min<std::uint64_t>(elements, 1), elements}) {
    out_.put(count);
  }
  out_.end_row();
  for (std::size_t e = 0; e < behind_tets; ++e) {
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
  for (std::size_t e = behind_tets; e < blocks; ++e) put_wedges(contents, e);
  out_.end_section("Elements");
}

void MshWriter::put_facets(GroupedMesh& mesh, RowRange facets) {
  for (std::uint64_t f = facets.begin; f < facets.end; ++f) {
    out_.put(f + 1);
    for (const std::uint64_t row : mesh.facet_nodes(mesh.facet(f))) out_.put(row + 1);
    out_.end_row();
  }
}

void MshWriter::put_wedges(const Contents& contents, std::size_t entity) {
  GroupedMesh& mesh = contents.mesh;
  const std::size_t behind_tets = mesh.facet_groups().size() + mesh.table().size();
  const RowRange wedges = mesh.wedge_groups()[entity - behind_tets].wedges;
  const auto [dimension, tag] = tag_of(contents, entity);
  for (const std::int32_t number : {dimension, tag, kMshPrism6}) out_.put(number);
  out_.put(wedges.size());
  out_.end_row();
  for (std::uint64_t w = wedges.begin; w < wedges.end; ++w) {
    out_.put(mesh.facet_count() + mesh.tet_count() + w + 1);
    for (const std::uint64_t row : mesh.wedge_nodes(mesh.wedge(w))) out_.put(row + 1);
    out_.end_row();
  }
}

void MshWriter::put_tets(GroupedMesh& mesh, RowRange tets) {
  for (std::uint64_t t = tets.begin; t < tets.end; ++t) {
    out_.put(mesh.facet_count() + t + 1);
    const NodeRows nodes = mesh.tet_nodes(t);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      out_.put(nodes.begin()[kMshTetOrder[i]] + 1);
    }
    out_.end_row();
  }
}

}  // namespace mw::io
