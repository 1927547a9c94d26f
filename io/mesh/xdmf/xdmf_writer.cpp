// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a mesh as XDMF over HDF5, with tags as dolfinx reads them.
#include "io/mesh/xdmf/xdmf_writer.h"

#include <algorithm>

#include "io/mesh/grouped/ten_node_writer.h"
#include "io/mesh/vtkhdf/hdf5_column.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kMaxChunkRows = 1 << 16;

/// Small meshes are small files.
hsize_t chunk_of(std::uint64_t rows) {
  return std::clamp<std::uint64_t>(rows, 1, kMaxChunkRows);
}

Hdf5Type index_type() {
  return {H5T_STD_I64LE, H5T_NATIVE_INT64};
}

Hdf5Type tag_type() {
  return {H5T_STD_I32LE, H5T_NATIVE_INT32};
}

template <class T, class Row>
void add_row(Hdf5Column<T>& column, const Row& row) {
  for (const auto number : row) column.add(number);
  column.end_row();
}

XdmfFacts facts_of(const GroupedMesh& mesh, const LabelNumbers& numbers,
                   const std::vector<NumberedFacets>& runs, const std::filesystem::path& path) {
  XdmfFacts facts{.numbers = xdmf_numbers_path(path).filename().string(),
                  .element = mesh.element(),
                  .labels_signed = mesh.table().is_signed(),
                  .nodes = mesh.node_count(),
                  .tets = mesh.tet_count(),
                  .facets = mesh.facet_count(),
                  .record = record_text(mesh.header().record)};
  const GroupNames names(mesh);
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    facts.labels.push_back({names.volume(rank), numbers[rank]});
  }
  for (const NumberedFacets& run : runs) facts.sides.push_back({run.name, run.number});
  return facts;
}

}  // namespace

std::filesystem::path xdmf_numbers_path(const std::filesystem::path& xdmf) {
  return std::filesystem::path(xdmf).replace_extension(".h5");
}

std::filesystem::path xdmf_cells_path(const std::filesystem::path& xdmf) {
  return std::filesystem::path(xdmf).replace_extension(".cells.xdmf");
}

XdmfWriter::XdmfWriter(const std::filesystem::path& path)
    : path_(path), file_(path), cells_(xdmf_cells_path(path)), numbers_(xdmf_numbers_path(path)) {}

void XdmfWriter::write(GroupedMesh& mesh) {
  const LabelNumbers numbers(mesh.table(), {.least = 0});
  const std::vector<NumberedFacets> runs = number_facets(mesh);
  numbers_.open();
  {
    const Hdf5Handle meshes = numbers_.make_group(numbers_.file(), "Mesh");
    const Hdf5Handle tags = numbers_.make_group(numbers_.file(), "MeshTags");
    const Hdf5Handle cells = numbers_.make_group(meshes.get(), "mesh");
    write_nodes(mesh, cells.get());
    write_tets(mesh, cells.get());
    write_tags(mesh, numbers, numbers_.make_group(tags.get(), "cell_tags").get());
    write_facets(mesh, runs, numbers_.make_group(tags.get(), "facet_tags").get());
  }
  const XdmfFacts facts = facts_of(mesh, numbers, runs, path_);
  cells_.append(xdmf_cells_text(facts));
  file_.append(xdmf_text(facts));
  numbers_.commit();
  write_label_table(path_, mesh.table(), mesh.names(), numbers);
  write_facet_table(path_, mesh.table(), runs);
  cells_.commit();
  file_.commit();
}

void XdmfWriter::write_nodes(GroupedMesh& mesh, hid_t group) {
  Hdf5Column<double> nodes(group, "geometry", {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE},
                           chunk_of(mesh.node_count()), 3);
  for (std::uint64_t row = 0; row < mesh.node_count(); ++row) add_row(nodes, mesh.node(row));
  numbers_.require(nodes.finish());
}

void XdmfWriter::write_tets(GroupedMesh& mesh, hid_t group) {
  const hsize_t chunk = chunk_of(mesh.tet_count());
  const Hdf5Type label =
      mesh.table().is_signed() ? index_type() : Hdf5Type{H5T_STD_U64LE, H5T_NATIVE_UINT64};
  Hdf5Column<std::uint64_t> tets(group, "topology", index_type(), chunk,
                                 node_count(mesh.element()));
  Hdf5Column<std::uint64_t> labels(group, "label", label, chunk);
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    const RowRange range = mesh.label_tets()[rank];
    for (std::uint64_t tet = range.begin; tet < range.end; ++tet) {
      if (mesh.element() == Element::kTet10) {
        add_row(tets, ten_rows(mesh, tet));
      } else {
        add_row(tets, mesh.tet(tet));
      }
      labels.add(mesh.table().raw(rank));
      labels.end_row();
    }
  }
  numbers_.require(tets.finish() && labels.finish());
}

void XdmfWriter::write_tags(GroupedMesh& mesh, const LabelNumbers& numbers, hid_t group) {
  Hdf5Column<std::int32_t> tags(group, "Values", tag_type(), chunk_of(mesh.tet_count()));
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    for (std::uint64_t i = 0; i < mesh.label_tets()[rank].size(); ++i) {
      tags.add(static_cast<std::int32_t>(numbers[rank]));
      tags.end_row();
    }
  }
  numbers_.require(tags.finish());
}

void XdmfWriter::write_facets(GroupedMesh& mesh, const std::vector<NumberedFacets>& runs,
                              hid_t group) {
  const bool ten = mesh.element() == Element::kTet10;
  const hsize_t chunk = chunk_of(mesh.facet_count());
  Hdf5Column<std::uint64_t> facets(group, "topology", index_type(), chunk, ten ? 6 : 3);
  Hdf5Column<std::int32_t> tags(group, "Values", tag_type(), chunk);
  for (const NumberedFacets& run : runs) {
    for (std::uint64_t i = run.facets.begin; i < run.facets.end; ++i) {
      const Facet facet = mesh.facet(i);
      for (const std::uint64_t row : facet.rows) facets.add(row);
      if (ten) {
        for (const std::uint64_t row : mesh.facet_middles(facet)) facets.add(row);
      }
      facets.end_row();
      tags.add(static_cast<std::int32_t>(run.number));
      tags.end_row();
    }
  }
  numbers_.require(facets.finish() && tags.finish());
}

}  // namespace mw::io
