// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/cli/options/config_file.h"

#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "io/file/errors.h"

namespace mw::cli {
namespace {

std::string content_of(const std::filesystem::path& path) {
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path, ignored)) {
    io::fail_usage(path.string(), ": cannot read this config file");
  }
  constexpr std::size_t kMaxBytes = 1 << 20;
  std::string content(kMaxBytes + 1, '\0');
  file.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(file.gcount()));
  if (content.size() <= kMaxBytes) return content;
  io::fail_usage(path.string(), ": is no config file: it has more than 1 MiB");
}

std::string line_of(const std::string& file, const toml::source_region& source) {
  return file + ":" + std::to_string(source.begin.line) + ": ";
}

toml::table parse_config(const std::filesystem::path& path) {
  try {
    return toml::parse(content_of(path), path.string());
  } catch (const toml::parse_error& error) {
    io::fail_usage(line_of(path.string(), error.source()), error.description());
  }
}

std::optional<std::string> number_of_toml(const toml::node& node) {
  if (const auto* integer = node.as_integer()) return std::to_string(integer->get());
  if (const auto* number = node.as_floating_point()) return engine::format_number(number->get());
  return std::nullopt;
}

/// Returns the elements of an array of numbers, joined by commas.
std::optional<std::string> list_of_toml(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr) return std::nullopt;
  std::string out;
  for (const toml::node& element : *array) {
    const std::optional<std::string> number = number_of_toml(element);
    if (!number) return std::nullopt;
    out += (out.empty() ? "" : ",") + *number;
  }
  return out;
}

std::optional<std::string> string_of_toml(const toml::node& node) {
  const auto* text = node.as_string();
  return text == nullptr ? std::nullopt : std::optional(text->get());
}

/// Returns the value as text, or nothing when its type is not that of the kind.
std::optional<std::string> text_of_toml(ValueKind kind, const toml::node& node) {
  switch (kind) {
    case ValueKind::kText:
    case ValueKind::kSize:
      return string_of_toml(node);
    case ValueKind::kNumberOrText:
      return node.is_number() ? number_of_toml(node) : string_of_toml(node);
    case ValueKind::kInteger:
      return node.is_integer() ? number_of_toml(node) : std::nullopt;
    case ValueKind::kNumber:
      return number_of_toml(node);
    case ValueKind::kNumberOrNone:
    case ValueKind::kNumberOrAuto:
      return string_of_toml(node) == word_of(kind) ? word_of(kind) : number_of_toml(node);
    case ValueKind::kNumbers:
      if (const auto one = number_of_toml(node)) return one;
      return list_of_toml(node);
    case ValueKind::kShape:
    case ValueKind::kBox:
      return list_of_toml(node);
    case ValueKind::kLabels:
      if (node.is_integer()) return number_of_toml(node);
      return node.is_string() ? string_of_toml(node) : list_of_toml(node);
    case ValueKind::kSwitch:
      if (!node.is_boolean()) return std::nullopt;
      return node.as_boolean()->get() ? "true" : "false";
  }
  return std::nullopt;
}

/// Returns the text of a key's value.
std::string checked_text(ValueKind kind, const toml::node& node, const std::string& where) {
  const std::optional<std::string> text = text_of_toml(kind, node);
  if (!text) io::fail_usage(where, ": wrong type; expected ", toml_words(kind));
  if (text->empty()) {
    io::fail_usage(where, ": empty; leave the key out instead");
  }
  // The system would end the name of a file there.
  if (text->find('\0') != text->npos) {
    io::fail_usage(where, ": has a zero byte in it");
  }
  return *text;
}

}  // namespace

ConfigTexts read_config(const std::filesystem::path& path, const OptionSet& options) {
  ConfigTexts out;
  const toml::table table = parse_config(path);
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    const std::string where = line_of(path.string(), node.source()) + name;
    const auto& entries = options.entries();
    const auto found = std::find_if(entries.begin(), entries.end(), [&](const auto& entry) {
      return !entry.option.only_flag && key_of(entry.option.name) == name;
    });
    if (found == entries.end()) {
      io::fail_usage(where, ": unknown key; see mwmesh mesh --print-config");
    }
    const std::string text = checked_text(found->option.kind, node, where);
    out[found->option.name] = {.text = text, .where = where + " = " + text};
  }
  return out;
}

}  // namespace mw::cli
