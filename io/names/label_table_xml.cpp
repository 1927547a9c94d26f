// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The label table of Connectome Workbench.
#include "io/names/label_table_xml.h"

#include <pugixml.hpp>

#include "io/names/name_fields.h"

namespace mw::io {
namespace {

std::optional<Colour> colour_of(pugi::xml_node label) {
  constexpr std::array<const char*, 4> kParts{"Red", "Green", "Blue", "Alpha"};
  Colour colour{};
  for (std::size_t i = 0; i < kParts.size(); ++i) {
    const auto share = number_of(label.attribute(kParts[i]).as_string());
    const auto byte = share ? byte_of_share(*share) : std::nullopt;
    if (!byte) return std::nullopt;
    colour[i] = *byte;
  }
  return colour;
}

}  // namespace

LabelNames parse_label_table(std::string_view xml) {
  if (xml.find("<LabelTable") == std::string_view::npos) return {};
  pugi::xml_document document;
  if (!document.load_buffer(xml.data(), xml.size())) return {};
  const pugi::xml_node table = document.find_node(
      [](pugi::xml_node node) { return std::string_view(node.name()) == "LabelTable"; });
  std::vector<LabelName> rows;
  for (const pugi::xml_node node : table.children("Label")) {
    const auto label = label_of(node.attribute("Key").as_string());
    if (label) rows.push_back({*label, node.text().get(), colour_of(node)});
  }
  return LabelNames(std::move(rows));
}

}  // namespace mw::io
