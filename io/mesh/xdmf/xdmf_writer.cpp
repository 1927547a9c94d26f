// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a mesh as XDMF over HDF5, with tags as dolfinx reads them.
#include "io/mesh/xdmf/xdmf_writer.h"

#include "io/file/errors.h"
#include "io/file/sink/atomic_file.h"
#include "io/file/text_numbers.h"
#include "io/mesh/grouped/group_names.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/vtkhdf/hdf5_output.h"

namespace mw::io {
namespace {

/// What the file says of a mesh.
struct XdmfFacts {
  std::string numbers;  ///< the name of the HDF5 file
  Element element = Element::kTet4;
  bool labels_signed = false;
  std::uint64_t nodes = 0;
  std::uint64_t tets = 0;
  std::uint64_t facets = 0;
  std::string record{};  ///< the record as a line (mesh_record.h); may be empty
  std::vector<std::string> values{};
  std::vector<std::string> masks{};  ///< see mask_arrays()
};

/// A data set of the HDF5 file.
struct Item {
  std::string path;
  std::uint64_t rows = 0;
  std::uint64_t components = 1;
  const char* type = "Int";
  int bytes = 8;
};

std::string item_text(const XdmfFacts& facts, const Item& item) {
  const std::string components = item.components == 1 ? "" : text(" ", item.components);
  return text("        <DataItem Dimensions=\"", item.rows, components, "\" NumberType=\"",
              item.type, "\" Precision=\"", item.bytes, "\" Format=\"HDF\">",
              xml_escaped(facts.numbers), ":", item.path, "</DataItem>\n");
}

std::string geometry_text(const XdmfFacts& facts) {
  return text(
      "      <Geometry GeometryType=\"XYZ\">\n",
      item_text(
          facts,
          {.path = "/Mesh/mesh/geometry", .rows = facts.nodes, .components = 3, .type = "Float"}),
      "      </Geometry>\n");
}

std::string topology_text(const XdmfFacts& facts, const char* type, const Item& item) {
  return text("      <Topology TopologyType=\"", type, "\" NumberOfElements=\"", item.rows,
              "\" NodesPerElement=\"", item.components, "\">\n", item_text(facts, item),
              "      </Topology>\n");
}

std::string tets_text(const XdmfFacts& facts) {
  const bool ten = has_middles(facts.element);
  return topology_text(
      facts, ten ? "Tetrahedron_10" : "Tetrahedron",
      {.path = "/Mesh/mesh/topology", .rows = facts.tets, .components = node_count(facts.element)});
}

std::string facets_text(const XdmfFacts& facts) {
  const bool ten = has_middles(facts.element);
  return topology_text(
      facts, ten ? "Triangle_6" : "Triangle",
      {.path = "/MeshTags/facet_tags/topology", .rows = facts.facets, .components = ten ? 6U : 3U});
}

std::string attribute_text(const XdmfFacts& facts, const std::string& name, const Item& item) {
  return text("      <Attribute Name=\"", name, "\" AttributeType=\"Scalar\" Center=\"Cell\">\n",
              item_text(facts, item), "      </Attribute>\n");
}

std::string tag_text(const std::string& name, std::int64_t number) {
  return text("      <Information Name=\"", xml_escaped(name), "\" Value=\"", number, "\"/>\n");
}

std::string grid_begin(const char* name) {
  return text("    <Grid Name=\"", name, "\" GridType=\"Uniform\">\n");
}

constexpr const char* kGridEnd = "    </Grid>\n";

std::string values_text(const XdmfFacts& facts) {
  std::string out;
  for (const std::string& name : facts.values) {
    out += attribute_text(facts, name,
                          {.path = "/Values/" + name, .rows = facts.tets, .type = "Float"});
  }
  for (std::size_t i = 0; i < facts.masks.size(); ++i) {
    out += attribute_text(
        facts, xml_escaped(facts.masks[i]),
        {.path = text("/Masks/", i + 1), .rows = facts.tets, .type = "UChar", .bytes = 1});
  }
  return out;
}

std::string mesh_text(const XdmfFacts& facts) {
  return grid_begin("mesh") + tets_text(facts) + geometry_text(facts) +
         attribute_text(facts, "label",
                        {.path = "/Mesh/mesh/label",
                         .rows = facts.tets,
                         .type = facts.labels_signed ? "Int" : "UInt"}) +
         values_text(facts) + kGridEnd;
}

/// Return what follows the tags in a grid.
std::string tagged_cells_text(const XdmfFacts& facts) {
  return tets_text(facts) + geometry_text(facts) +
         attribute_text(facts, "cell_tags",
                        {.path = "/MeshTags/cell_tags/Values", .rows = facts.tets, .bytes = 4}) +
         kGridEnd;
}
std::string tagged_facets_text(const XdmfFacts& facts) {
  return facets_text(facts) + geometry_text(facts) +
         attribute_text(facts, "facet_tags",
                        {.path = "/MeshTags/facet_tags/Values", .rows = facts.facets, .bytes = 4}) +
         kGridEnd;
}

std::string record_line(const XdmfFacts& facts) {
  if (facts.record.empty()) return {};
  return text("    <Information Name=\"", kRecordName, "\" Value=\"", xml_escaped(facts.record),
              "\"/>\n");
}

constexpr const char* kDocumentBegin =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n";
constexpr const char* kDocumentEnd = "  </Domain>\n</Xdmf>\n";

/// Returns a column with room for all of its numbers.
template <class T>
FileColumn<T> column_of(Hdf5Output& output, std::uint64_t numbers) {
  return {output.file(), output.reserve(numbers * sizeof(T))};
}

template <class T, class Row>
void add_row(FileColumn<T>& column, const Row& row) {
  for (const auto number : row) column.add(number);
}

XdmfFacts facts_of(const GroupedMesh& mesh, const std::filesystem::path& path) {
  return {.numbers = xdmf_numbers_path(path).filename().string(),
          .element = mesh.element(),
          .labels_signed = mesh.table().is_signed(),
          .nodes = mesh.node_count(),
          .tets = mesh.tet_count(),
          .facets = mesh.facet_count(),
          .record = record_text(mesh.header().record),
          .values = mesh.header().values,
          .masks = mask_arrays(mesh.header())};
}

/// Returns the document with the first grid alone.  A comment says who wrote it, as some readers
/// take nothing but a grid in the domain.
std::string xdmf_cells_text(const XdmfFacts& facts) {
  return text(kDocumentBegin, mesh_text(facts), kDocumentEnd, "<!-- ", kRecordName, " -->\n");
}

/// ERRORS: mw::Error(kUsage) for a name that readers would not find the HDF5 file by, since they
/// take what is behind a ':' for a path in that file.
const std::filesystem::path& checked_name(const std::filesystem::path& path) {
  if (path.filename().string().find(':') == std::string::npos) return path;
  fail_usage(path.string() +
             ": a ':' in the name of an .xdmf file would end the name of the .h5 "
             "file beside it in references to that; give a name without one");
}

}  // namespace

std::filesystem::path xdmf_numbers_path(const std::filesystem::path& xdmf) {
  return std::filesystem::path(xdmf).replace_extension(".h5");
}

std::filesystem::path xdmf_cells_path(const std::filesystem::path& xdmf) {
  return std::filesystem::path(xdmf).replace_extension(".cells.xdmf");
}

XdmfWriter::XdmfWriter(const std::filesystem::path& path, const MeshExtras& /*extras*/)
    : path_(checked_name(path)),
      file_(path),
      cells_(xdmf_cells_path(path)),
      numbers_(xdmf_numbers_path(path)),
      labels_(label_table_path(path)),
      facets_(facet_table_path(path)) {}

void XdmfWriter::write(GroupedMesh& mesh) {
  const LabelNumbers numbers(mesh.table(), {.min = 0});
  const GroupNames names(mesh);
  const Hdf5Group meshes{
      .name = "Mesh",
      .groups = {{.name = "mesh", .sets = {nodes(mesh), topology(mesh), labels(mesh)}}}};
  const Hdf5Group tags{
      .name = "MeshTags",
      .groups = {{.name = "cell_tags", .sets = {cell_tags(mesh, numbers)}},
                 {.name = "facet_tags", .sets = {facets(mesh), facet_tags(mesh, names)}}}};
  Hdf5Group root{.attributes = {{"writer", std::string(kRecordName)}}, .groups = {meshes, tags}};
  if (!mesh.header().values.empty()) root.groups.push_back({.name = "Values"});
  for (std::size_t i = 0; i < mesh.header().values.size(); ++i) {
    root.groups.back().sets.push_back(value(mesh, i));
  }
  if (!mesh.header().record.masks.empty()) root.groups.push_back({.name = "Masks"});
  for (const MaskLabels& mask : mesh.header().record.masks) {
    std::vector<Hdf5DataSet>& sets = root.groups.back().sets;
    sets.push_back(mask_cells(mesh, mask, std::to_string(sets.size() + 1)));
  }
  cells_.append(xdmf_cells_text(facts_of(mesh, path_)));
  write_grids(mesh, names, numbers);
  append_label_table(labels_, mesh.table(), mesh.header(), numbers);
  append_facet_table(facets_, mesh, names);
  AtomicFile& data = numbers_.finish(root);
  commit_together({data, labels_, facets_, cells_, file_});
}

Hdf5DataSet XdmfWriter::nodes(GroupedMesh& mesh) {
  auto column = column_of<double>(numbers_, 3 * mesh.node_count());
  for (std::uint64_t row = 0; row < mesh.node_count(); ++row) add_row(column, mesh.node(row));
  return finish_column(column, "geometry", Hdf5Kind::kFloat64, {mesh.node_count(), 3});
}

Hdf5DataSet XdmfWriter::topology(GroupedMesh& mesh) {
  const std::uint64_t nodes = node_count(mesh.element());
  auto column = column_of<std::uint64_t>(numbers_, nodes * mesh.tet_count());
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    const RowRange range = mesh.label_tets()[rank];
    for (std::uint64_t tet = range.begin; tet < range.end; ++tet) {
      add_row(column, mesh.tet_nodes(tet));
    }
  }
  return finish_column(column, "topology", Hdf5Kind::kInt64, {mesh.tet_count(), nodes});
}

Hdf5DataSet XdmfWriter::labels(const GroupedMesh& mesh) {
  const LabelTable& table = mesh.table();
  auto column = column_of<RawLabel>(numbers_, mesh.tet_count());
  for (Label rank = 0; rank < table.size(); ++rank) {
    for (std::uint64_t i = 0; i < mesh.label_tets()[rank].size(); ++i) column.add(table.raw(rank));
  }
  return finish_column(column, "label", table.is_signed() ? Hdf5Kind::kInt64 : Hdf5Kind::kUint64,
                       {mesh.tet_count()});
}

Hdf5DataSet XdmfWriter::value(GroupedMesh& mesh, std::size_t column) {
  auto numbers = column_of<double>(numbers_, mesh.tet_count());
  for (std::uint64_t t = 0; t < mesh.tet_count(); ++t) numbers.add(mesh.value(t, column));
  return finish_column(numbers, mesh.header().values[column], Hdf5Kind::kFloat64,
                       {mesh.tet_count()});
}

Hdf5DataSet XdmfWriter::mask_cells(const GroupedMesh& mesh, const MaskLabels& mask,
                                   const std::string& name) {
  auto column = column_of<std::uint8_t>(numbers_, mesh.tet_count());
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    const bool is_in = mask.has(mesh.table().raw(rank));
    for (std::uint64_t i = 0; i < mesh.label_tets()[rank].size(); ++i) column.add(is_in ? 1 : 0);
  }
  return finish_column(column, name, Hdf5Kind::kUint8, {mesh.tet_count()});
}

Hdf5DataSet XdmfWriter::cell_tags(const GroupedMesh& mesh, const LabelNumbers& numbers) {
  auto column = column_of<std::int32_t>(numbers_, mesh.tet_count());
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    for (std::uint64_t i = 0; i < mesh.label_tets()[rank].size(); ++i) {
      column.add(static_cast<std::int32_t>(numbers[rank]));
    }
  }
  return finish_column(column, "Values", Hdf5Kind::kInt32, {mesh.tet_count()});
}

Hdf5DataSet XdmfWriter::facets(GroupedMesh& mesh) {
  const std::uint64_t nodes = has_middles(mesh.element()) ? 6 : 3, count = mesh.facet_count();
  auto column = column_of<std::uint64_t>(numbers_, nodes * count);
  for (std::uint64_t i = 0; i < count; ++i) add_row(column, mesh.facet_nodes(mesh.facet(i)));
  return finish_column(column, "topology", Hdf5Kind::kInt64, {count, nodes});
}

Hdf5DataSet XdmfWriter::facet_tags(const GroupedMesh& mesh, const GroupNames& names) {
  const std::uint64_t count = mesh.facet_count();
  auto column = column_of<std::int32_t>(numbers_, count);
  for_each_numbered(mesh, names, [&](const NumberedFacets& run) {
    for (std::uint64_t i = 0; i < run.facets.size(); ++i) {
      column.add(static_cast<std::int32_t>(run.number));
    }
  });
  return finish_column(column, "Values", Hdf5Kind::kInt32, {count});
}

/// Writes the document with all grids.
void XdmfWriter::write_grids(const GroupedMesh& mesh, const GroupNames& names,
                             const LabelNumbers& numbers) {
  const XdmfFacts facts = facts_of(mesh, path_);
  file_.append(text(kDocumentBegin, record_line(facts), mesh_text(facts), grid_begin("cell_tags")));
  for (Label rank = 0; rank < mesh.table().size(); ++rank) {
    file_.append(tag_text(names.volume(rank), numbers[rank]));
  }
  file_.append(tagged_cells_text(facts) + grid_begin("facet_tags"));
  for_each_numbered(mesh, names, [&](const NumberedFacets& run) {
    file_.append(tag_text(run.name, run.number));
  });
  file_.append(tagged_facets_text(facts) + kDocumentEnd);
}

}  // namespace mw::io
