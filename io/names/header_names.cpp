// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels in headers of NRRD and NIfTI files.
#include "io/names/header_names.h"

#include <pugixml.hpp>

#include <algorithm>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/names/colour_table.h"

namespace mw::io {
namespace {

/// "Segment12" of "Segment12_Name"; empty: it is no key of a segment.
std::string_view segment_of(std::string_view key) {
  constexpr std::string_view kStart = "Segment";
  const std::size_t end = key.find('_');
  if (!key.starts_with(kStart) || end == std::string_view::npos || end <= kStart.size()) return {};
  const std::string_view number = key.substr(kStart.size(), end - kStart.size());
  return number.find_first_not_of("0123456789") == std::string_view::npos ? key.substr(0, end)
                                                                          : std::string_view{};
}

const std::string& value_of(const NrrdKeys& keys, std::string_view segment, const char* what) {
  static const std::string none;
  const auto found = keys.find(text(segment, what));
  return found == keys.end() ? none : found->second;
}

std::optional<Colour> colour_of(std::string_view value) {
  const std::vector<std::string_view> words = words_of(value);
  if (words.size() != 3) return std::nullopt;
  Colour colour{0, 0, 0, 255};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto share = number_of(words[i]);
    const auto byte = share ? byte_of_share(*share) : std::nullopt;
    if (!byte) return std::nullopt;
    colour[i] = *byte;
  }
  return colour;
}

void refuse_layers(std::string_view key, const std::string& layer, std::string_view file) {
  if (!key.ends_with("_Layer") || label_of(layer) == RawLabel{0}) return;
  fail_input(file, text("NRRD key '", key, "' = ", layer),
             "the segmentation has several layers, its segments overlap: a voxel may have more "
             "than one label",
             kSegmentsWayOut);
}

}  // namespace

bool has_segments(const NrrdKeys& keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [](const auto& pair) { return !segment_of(pair.first).empty(); });
}

LabelNames segment_names(const NrrdKeys& keys, std::string_view file) {
  std::vector<LabelName> rows;
  for (const auto& [key, value] : keys) {
    const std::string_view segment = segment_of(key);
    if (segment.empty()) continue;
    refuse_layers(key, value, file);
    if (!key.ends_with("_LabelValue")) continue;
    const auto label = label_of(value);
    if (!label) continue;
    rows.push_back({.label = *label,
                    .name = value_of(keys, segment, "_Name"),
                    .colour = colour_of(value_of(keys, segment, "_Color"))});
  }
  return LabelNames(std::move(rows));
}

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
