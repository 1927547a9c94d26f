// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the tetrahedra of an FEBio model.
#include "io/mesh/febio/febio_reader.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/mesh/grouped/label_numbers.h"
#include "io/mesh/kept_rows.h"
#include "io/mesh/xml_text.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 33U;

class FebioReader {
 public:
  FebioReader(const pugi::xml_node model, const std::string& file)
      : model_(model),
        mesh_tag_(model.child("Mesh") ? model.child("Mesh") : model.child("Geometry")),
        file_(file),
        numbered_(file) {}

  MeshData read() {
    if (!mesh_tag_) fail("Mesh", "missing", "give an FEBio model of version 2.5 to 4.0");
    for (const pugi::xml_node nodes : mesh_tag_.children("Nodes")) read_nodes(nodes);
    middles_.grow(mesh_.vertices.size());
    for (const pugi::xml_node part : mesh_tag_.children("Elements")) read_part(part);
    mesh_.labels_signed = numbered_.labels_signed();
    mesh_.names = numbered_.names();
    drop_middles(mesh_, middles_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& reason,
                         const char* way_out = "the file is damaged: write it anew") const {
    fail_input(file_, field, reason, way_out);
  }

  [[nodiscard]] std::uint64_t id_of(pugi::xml_node node, const char* what) const {
    const auto id = parse_integer(node.attribute("id").as_string());
    if (!id || *id < 0) fail(what, text("'", node.attribute("id").as_string(), "' is no id"));
    return static_cast<std::uint64_t>(*id);
  }

  /// The numbers between commas, as blanks.
  [[nodiscard]] static std::string spaced(pugi::xml_node node) {
    std::string numbers = node.text().get();
    std::replace(numbers.begin(), numbers.end(), ',', ' ');
    return numbers;
  }

  void read_nodes(pugi::xml_node nodes) {
    for (const pugi::xml_node node : nodes.children("node")) {
      const std::uint64_t id = id_of(node, "node");
      const auto x = parse_reals(spaced(node));
      const auto finite = [](double value) { return std::isfinite(value); };
      if (!x || x->size() != 3 || !std::all_of(x->begin(), x->end(), finite)) {
        fail(text("node ", id), "has no three coordinates");
      }
      if (!rows_.emplace(id, mesh_.vertices.size()).second)
        fail(text("node ", id), "is there twice");
      mesh_.vertices.push_back({(*x)[0], (*x)[1], (*x)[2]});
    }
  }

  void read_part(pugi::xml_node part) {
    const std::string name = part.attribute("name").as_string();
    const std::string type = part.attribute("type").as_string();
    if (type != "tet4" && type != "tet10") {
      fail(text("Elements '", name, "'"), text("type '", type, "' is not tet4 or tet10"),
           "keep only the tetrahedra");
    }
    const RawLabel label = numbered_.label(material_of(part, name));
    for (const pugi::xml_node element : part.children("elem")) {
      read_element(element, type == "tet4" ? 4 : 10);
      mesh_.labels.push_back(label);
    }
  }

  void read_element(pugi::xml_node element, std::size_t nodes) {
    const auto ids = parse_integers(spaced(element));
    const std::string position = text("element ", element.attribute("id").as_string());
    if (!ids || ids->size() != nodes) fail(position, text("has not ", nodes, " nodes"));
    TetRows& tet = mesh_.tets.emplace_back();
    for (std::size_t i = 0; i < nodes; ++i) {
      const auto row = rows_.find(static_cast<std::uint64_t>((*ids)[i]));
      if (row == rows_.end())
        fail(position, text("names node ", (*ids)[i], ", which is not there"));
      if (i < tet.size()) {
        tet[i] = row->second;
      } else {
        middles_.middle(row->second);
      }
    }
  }

  /// The id of the material of a part: told with its elements (2.5), or by its domain.
  [[nodiscard]] std::int64_t material_of(pugi::xml_node part, const std::string& name) const {
    std::string material = part.attribute("mat").as_string();
    for (const pugi::xml_node domain : model_.child("MeshDomains").children("SolidDomain")) {
      if (name == domain.attribute("name").as_string())
        material = domain.attribute("mat").as_string();
    }
    for (const pugi::xml_node row : model_.child("Material").children("material")) {
      if (material == row.attribute("name").as_string()) material = row.attribute("id").as_string();
    }
    if (const auto id = parse_integer(material)) return *id;
    fail(text("Elements '", name, "'"), "has no material", "give each part a material with an id");
  }

  pugi::xml_node model_;
  pugi::xml_node mesh_tag_;
  const std::string& file_;
  NumberedLabels numbered_;
  MeshData mesh_;
  KeptRows middles_;
  std::unordered_map<std::uint64_t, std::uint64_t> rows_;  ///< by id of node
};

}  // namespace

MeshData read_febio(const ByteSource& source) {
  pugi::xml_document document;
  parse_xml(source, kMaxBytes, document);
  const pugi::xml_node model = document.child("febio_spec");
  if (!model) fail_input(source.name(), "febio_spec", "missing", "give an FEBio model");
  return FebioReader(model, source.name()).read();
}

}  // namespace mw::io
