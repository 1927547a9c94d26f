// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The XML of an XDMF file.
#include "io/mesh/xdmf/xdmf_text.h"

#include "io/file/errors.h"
#include "io/mesh/xml_text.h"

namespace mw::io {
namespace {

/// A data set.
struct Item {
  const char* path;
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
  const bool ten = facts.element == Element::kTet10;
  return topology_text(
      facts, ten ? "Tetrahedron_10" : "Tetrahedron",
      {.path = "/Mesh/mesh/topology", .rows = facts.tets, .components = node_count(facts.element)});
}

std::string facets_text(const XdmfFacts& facts) {
  const bool ten = facts.element == Element::kTet10;
  return topology_text(
      facts, ten ? "Triangle_6" : "Triangle",
      {.path = "/MeshTags/facet_tags/topology", .rows = facts.facets, .components = ten ? 6U : 3U});
}

std::string attribute_text(const XdmfFacts& facts, const char* name, const Item& item) {
  return text("      <Attribute Name=\"", name, "\" AttributeType=\"Scalar\" Center=\"Cell\">\n",
              item_text(facts, item), "      </Attribute>\n");
}

std::string tags_text(const std::vector<XdmfTag>& tags) {
  std::string out;
  for (const XdmfTag& tag : tags) {
    out += text("      <Information Name=\"", xml_escaped(tag.name), "\" Value=\"", tag.number,
                "\"/>\n");
  }
  return out;
}

std::string grid_text(const char* name, const std::string& content) {
  return text("    <Grid Name=\"", name, "\" GridType=\"Uniform\">\n", content, "    </Grid>\n");
}

std::string mesh_text(const XdmfFacts& facts) {
  return grid_text("mesh", tets_text(facts) + geometry_text(facts) +
                               attribute_text(facts, "label",
                                              {.path = "/Mesh/mesh/label",
                                               .rows = facts.tets,
                                               .type = facts.labels_signed ? "Int" : "UInt"}));
}

std::string cell_tags_text(const XdmfFacts& facts) {
  return grid_text(
      "cell_tags",
      tags_text(facts.labels) + tets_text(facts) + geometry_text(facts) +
          attribute_text(facts, "cell_tags",
                         {.path = "/MeshTags/cell_tags/Values", .rows = facts.tets, .bytes = 4}));
}

std::string facet_tags_text(const XdmfFacts& facts) {
  return grid_text(
      "facet_tags",
      tags_text(facts.sides) + facets_text(facts) + geometry_text(facts) +
          attribute_text(
              facts, "facet_tags",
              {.path = "/MeshTags/facet_tags/Values", .rows = facts.facets, .bytes = 4}));
}

std::string record_line(const XdmfFacts& facts) {
  if (facts.record.empty()) return {};
  return text("    <Information Name=\"", kRecordName, "\" Value=\"", xml_escaped(facts.record),
              "\"/>\n");
}

std::string document_text(const std::string& grids) {
  return text("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n",
              grids, "  </Domain>\n</Xdmf>\n");
}

}  // namespace

std::string xdmf_text(const XdmfFacts& facts) {
  return document_text(record_line(facts) + mesh_text(facts) + cell_tags_text(facts) +
                       facet_tags_text(facts));
}

std::string xdmf_cells_text(const XdmfFacts& facts) {
  return document_text(mesh_text(facts));
}

}  // namespace mw::io
