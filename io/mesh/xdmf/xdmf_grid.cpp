// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The grids of an XDMF file, and where their numbers are.
#include "io/mesh/xdmf/xdmf_grid.h"

#include <algorithm>
#include <cctype>

#include "io/file/errors.h"
#include "io/file/file_source.h"
#include "io/file/named_beside.h"
#include "io/file/text_numbers.h"
#include "io/mesh/xml_text.h"

namespace mw::io {
namespace {

/// There are no numbers in it.
constexpr std::uint64_t kMaxBytes = 256 << 20;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// XDMF 2 calls it TopologyType, XDMF 3 Type as well.
std::string type_of(pugi::xml_node node, const char* long_name) {
  const pugi::xml_attribute type = node.attribute(long_name);
  return lower(type ? type.as_string() : node.attribute("Type").as_string());
}

class GridReader {
 public:
  explicit GridReader(const std::filesystem::path& path) : path_(path) {
    parse_xml(FileSource(path), kMaxBytes, document_);
  }

  [[nodiscard]] XdmfContent read() const {
    const pugi::xml_node domain = document_.child("Xdmf").child("Domain");
    if (!domain) fail_input(path_.string(), "Domain", "missing", "give an XDMF file");
    XdmfContent out;
    const auto record = domain.find_child_by_attribute("Information", "Name", kRecordName);
    out.record = parse_record(record.attribute("Value").as_string(), path_.string());
    pugi::xml_node first_nodes;
    for (const pugi::xml_node grid : domain.children("Grid")) {
      const pugi::xml_node own = grid.child("Geometry");
      if (!first_nodes) first_nodes = own;
      if (is_of_tets(grid)) out.grids.push_back(read_grid(grid, own ? own : first_nodes));
    }
    return out;
  }

 private:
  [[nodiscard]] static bool is_of_tets(pugi::xml_node grid) {
    const std::string type = type_of(grid.child("Topology"), "TopologyType");
    return type == "tetrahedron" || type == "tetrahedron_10" || type == "tet_10";
  }

  [[nodiscard]] XdmfGrid read_grid(pugi::xml_node grid, pugi::xml_node nodes) const {
    const std::string position = text("grid '", grid.attribute("Name").as_string(), "'");
    const std::string kind = type_of(nodes, "GeometryType");
    if (kind != "xyz" && !(nodes && kind.empty())) {
      fail_input(path_.string(), position, text("geometry '", kind, "' is not XYZ"));
    }
    XdmfGrid out{.topology = item_of(grid.child("Topology"), position),
                 .geometry = item_of(nodes, position),
                 .cells = {}};
    for (const pugi::xml_node attribute : grid.children("Attribute")) {
      if (lower(attribute.attribute("Center").as_string()) != "cell") continue;
      const std::string name = attribute.attribute("Name").as_string();
      out.cells.push_back({name, item_of(attribute, text(position, ", attribute '", name, "'"))});
    }
    return out;
  }

  /// "FILE:/PATH" of the one DataItem.
  [[nodiscard]] XdmfItem item_of(pugi::xml_node parent, const std::string& position) const {
    const pugi::xml_node item = parent.child("DataItem");
    const std::string format = lower(item.attribute("Format").as_string());
    if (format != "hdf") {
      fail_input(path_.string(), position, text("numbers in format '", format, "' are not read"),
                 "store them in HDF5 (data_format=\"HDF\" of meshio)");
    }
    const std::string_view words = trimmed(item.text().get());
    const std::size_t colon = words.rfind(':');
    if (colon == std::string_view::npos) {
      fail_input(path_.string(), position, text("'", words.substr(0, 80), "' is not FILE:/PATH"));
    }
    return {named_beside(path_, position, words.substr(0, colon)),
            std::string(words.substr(colon + 1))};
  }

  std::filesystem::path path_;
  pugi::xml_document document_;
};

}  // namespace

XdmfContent read_xdmf_xml(const std::filesystem::path& path) {
  return GridReader(path).read();
}

}  // namespace mw::io
