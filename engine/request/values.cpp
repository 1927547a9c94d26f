// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Values of options from text and back, and their forms in TOML and JSON.
#include "engine/request/values.h"

#include <algorithm>

#include "io/volume/cropped_volume.h"
#include "kernels/core/error.h"

namespace mw::request {
namespace {

using engine::fail_expected;
using engine::read_number;

struct Kind {
  const char* name;
  const char* toml;
};

/// In the order of ValueKind.
constexpr std::array<Kind, 12> kKinds{{
    {"text", "a string"},
    {"integer", "an integer"},
    {"number", "a number"},
    {"number_or_none", "a number or \"none\""},
    {"number_or_auto", "a number or \"auto\""},
    {"numbers", "three numbers [X, Y, Z], or one"},
    {"shape", "three integers [X, Y, Z]"},
    {"box", "six integers [X0, Y0, Z0, X1, Y1, Z1]"},
    {"labels", "integers [1, 2] or a string \"1,2\""},
    {"size", "a string such as \"4G\""},
    {"switch", "true or false"},
    {"number_or_text", "a number or a string"},
}};

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t comma = text.find(','); comma != text.npos; comma = text.find(',')) {
    parts.push_back(text.substr(0, comma));
    text.remove_prefix(comma + 1);
  }
  parts.push_back(text);
  return parts;
}

/// Adds a label, or all those of a range such as "1-3" or "-2-5".
void add_labels(std::string_view part, std::vector<RawLabel>& labels) {
  constexpr RawLabel kMost = 1U << 20U;
  const std::size_t dash = part.find('-', 1);
  if (dash == part.npos) return labels.push_back(parse_label(part));
  const std::string_view first_text = part.substr(0, dash);
  const RawLabel first = parse_label(first_text), last = parse_label(part.substr(dash + 1));
  const bool crosses_zero = first_text.starts_with('-') && part[dash + 1] != '-';
  if (last - first >= kMost || (last < first && !crosses_zero)) {
    fail_expected("a label, or a range A-B from the smaller one on of at most 2^20", part);
  }
  for (RawLabel i = 0; i <= last - first; ++i) labels.push_back(first + i);
}

constexpr const char* kNone = "none";

std::string joined(const std::array<std::string, 3>& parts) {
  return parts[0] + "," + parts[1] + "," + parts[2];
}

std::string canonical_numbers(const std::string& text) {
  const std::array<double, 3> v = parse_numbers(text);
  return joined({format_number(v[0]), format_number(v[1]), format_number(v[2])});
}

std::string canonical_shape(const std::string& text) {
  const Index3 v = parse_shape(text);
  return joined({std::to_string(v.x), std::to_string(v.y), std::to_string(v.z)});
}

std::string canonical_box(const std::string& text) {
  return io::box_text(parse_box(text));
}

}  // namespace

std::array<double, 3> parse_numbers(std::string_view text) {
  const std::vector<std::string_view> parts = split(text);
  if (parts.size() != 1 && parts.size() != 3) fail_expected("three numbers X,Y,Z, or one", text);
  std::array<double, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = parse_number(parts[i % parts.size()]);
  return out;
}

Index3 parse_shape(std::string_view text) {
  const std::vector<std::string_view> parts = split(text);
  std::array<std::int64_t, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (parts.size() != 3 || !read_number(parts[i], out[i]) || out[i] < 1) {
      fail_expected("three positive integers X,Y,Z", text);
    }
  }
  return {out[0], out[1], out[2]};
}

Box3 parse_box(std::string_view text) {
  const std::vector<std::string_view> parts = split(text);
  std::array<std::int64_t, 6> out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (parts.size() != out.size() || !read_number(parts[i], out[i])) {
      fail_expected("six integers X0,Y0,Z0,X1,Y1,Z1", text);
    }
  }
  return {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}};
}

std::vector<RawLabel> parse_labels(std::string_view text) {
  std::vector<RawLabel> labels;
  for (const std::string_view part : split(text)) add_labels(part, labels);
  return labels;
}

const char* word_of(ValueKind kind) {
  return kind == ValueKind::kNumberOrAuto ? "auto" : kNone;
}

const char* name(ValueKind kind) {
  return kKinds[static_cast<std::size_t>(kind)].name;
}

const char* toml_words(ValueKind kind) {
  return kKinds[static_cast<std::size_t>(kind)].toml;
}

std::string canonical_text(ValueKind kind, const std::string& text) {
  switch (kind) {
    case ValueKind::kText:
    case ValueKind::kNumberOrText:
      return text;
    case ValueKind::kInteger:
      return std::to_string(parse_integer(text));
    case ValueKind::kNumber:
      return format_number(parse_number(text));
    case ValueKind::kNumberOrNone:
    case ValueKind::kNumberOrAuto:
      return text == word_of(kind) ? text : format_number(parse_number(text));
    case ValueKind::kNumbers:
      return canonical_numbers(text);
    case ValueKind::kShape:
      return canonical_shape(text);
    case ValueKind::kBox:
      return canonical_box(text);
    case ValueKind::kLabels:
      (void)parse_labels(text);
      return text;
    case ValueKind::kSize:
      (void)parse_bytes(text);
      return text;
    case ValueKind::kSwitch:
      return parse_switch(text) ? "true" : "false";
  }
  return text;
}

bool fits_in_toml(const std::string& text) {
  // JSON replaces bytes that are no UTF-8.
  return io::parse_json(io::Json(text).dump_ascii(), "settings").text() == text;
}

std::string toml_of_text(ValueKind kind, const std::string& text) {
  switch (kind) {
    case ValueKind::kInteger:
    case ValueKind::kNumber:
    case ValueKind::kSwitch:
      return text;
    case ValueKind::kNumberOrNone:
    case ValueKind::kNumberOrAuto:
      return text == word_of(kind) ? "\"" + text + "\"" : text;
    case ValueKind::kNumbers:
    case ValueKind::kShape:
    case ValueKind::kBox:
      return "[" + text + "]";
    default:
      break;
  }
  // A JSON string is a TOML string.
  return io::Json(text).dump_ascii();
}

io::Json json_of_text(ValueKind kind, const std::string& text) {
  if (text.empty()) return nullptr;
  if (kind == ValueKind::kText || kind == ValueKind::kLabels || kind == ValueKind::kSize ||
      kind == ValueKind::kNumberOrText) {
    return text;
  }
  if (text == kNone) return text;
  return io::parse_json(toml_of_text(kind, text), "settings");
}

}  // namespace mw::request
