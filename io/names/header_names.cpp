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

constexpr RawLabel kMostLayers = 1 << 16;

/// Returns "Segment12" for "Segment12_Name"; nothing for a key that is none of a segment.
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

/// Returns the whole number of a layer; 0 where there is none.
std::int64_t layer_of(std::string_view value) {
  const auto layer = label_of(value);
  return layer && *layer < kMostLayers ? static_cast<std::int64_t>(*layer) : 0;
}

/// Returns a key for "SegmentN" that sorts as the number N does.
std::pair<std::size_t, std::string_view> number_of_segment(std::string_view segment) {
  return {segment.size(), segment};
}

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

bool has_segment_names(const NrrdKeys& keys) {
  return std::any_of(keys.begin(), keys.end(), [](const auto& key) {
    return key.first.ends_with("_Name") && !segment_of(key.first).empty();
  });
}

std::vector<Segment> read_segments(const NrrdKeys& keys) {
  std::vector<std::string_view> names;
  for (const auto& [key, value] : keys) {
    const std::string_view segment = segment_of(key);
    if (segment.empty() || key != text(segment, "_LabelValue")) continue;
    if (label_of(value)) names.push_back(segment);
  }
  std::sort(names.begin(), names.end(), [](std::string_view a, std::string_view b) {
    return number_of_segment(a) < number_of_segment(b);
  });
  std::vector<Segment> out;
  for (const std::string_view segment : names) {
    out.push_back({.name = {.label = *label_of(value_of(keys, segment, "_LabelValue")),
                            .name = value_of(keys, segment, "_Name"),
                            .colour = colour_of(value_of(keys, segment, "_Color"))},
                   .layer = layer_of(value_of(keys, segment, "_Layer"))});
  }
  return out;
}

LabelNames names_of(const std::vector<Segment>& segments) {
  std::vector<LabelName> rows;
  for (const Segment& segment : segments) rows.push_back(segment.name);
  return LabelNames(std::move(rows));
}

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
