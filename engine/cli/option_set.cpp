// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One list of options: flags, config keys, environment variables, defaults and help from one entry.
#include "engine/cli/option_set.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "engine/cli/environment.h"
#include "engine/cli/nearest.h"
#include "engine/cli/option_text.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

[[noreturn]] void refuse(const std::string& where, const std::string& reason) {
  throw Error(ErrorKind::kUsage, where + reason);
}

std::string key_of(const Option& option) {
  std::string key = option.name;
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

std::string help_of(const Option& option) {
  return option.help + (option.fallback.empty() ? "" : " [" + option.fallback + "]");
}

std::string content_of(const std::filesystem::path& path) {
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path, ignored)) {
    refuse(path.string(), ": cannot read this config file");
  }
  constexpr std::size_t kMaxBytes = 1 << 20;
  std::string content(kMaxBytes + 1, '\0');
  file.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(file.gcount()));
  if (content.size() <= kMaxBytes) return content;
  refuse(path.string(), ": is no config file: it has more than 1 MiB");
}

std::string line_of(const std::string& file, const toml::source_region& source) {
  return file + ":" + std::to_string(source.begin.line) + ": ";
}

toml::table parse_config(const std::filesystem::path& path) {
  try {
    return toml::parse(content_of(path), path.string());
  } catch (const toml::parse_error& error) {
    refuse(line_of(path.string(), error.source()), std::string(error.description()));
  }
}

}  // namespace

void OptionSet::add(Option option) {
  entries_.push_back({.option = std::move(option)});
}

void OptionSet::add_flags(CLI::App& app) {
  for (Entry& entry : entries_) {
    const Option& option = entry.option;
    const std::string flags = option.flags.empty() ? "--" + option.name : option.flags;
    if (option.kind == ValueKind::kSwitch) {
      entry.flag = app.add_flag(flags, entry.flag_switch, help_of(option));
    } else {
      entry.flag = app.add_option(flags, entry.flag_text, help_of(option));
      entry.flag->type_name(option.choices.empty() ? option.value : joined(option.choices, "|"));
    }
    entry.flag->configurable();
  }
}

void OptionSet::resolve(const std::optional<std::filesystem::path>& config) {
  for (Entry& entry : entries_) {
    entry.text = entry.option.fallback;
    entry.where = entry.option.name;
  }
  if (config) read_config(*config);
  read_environment();
  read_flags();
  for (Entry& entry : entries_) settle(entry);
}

void OptionSet::read_config(const std::filesystem::path& path) {
  const toml::table table = parse_config(path);
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    const std::string where = line_of(path.string(), node.source()) + name;
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
      return key_of(entry.option) == name;
    });
    if (found == entries_.end()) refuse(where, unknown_key(name));
    const ValueKind kind = found->option.kind;
    const std::optional<std::string> text = text_of_toml(kind, node);
    if (!text) refuse(where, std::string(": wrong type; expected ") + toml_type(kind));
    found->text = *text;
    found->where = where + " = " + *text;
    if (text->empty()) refuse(where, ": empty; leave the key out instead");
    // Names of files would end there.
    if (text->find('\0') != text->npos) refuse(where, ": has a zero byte in it");
  }
}

std::string OptionSet::unknown_key(const std::string& name) const {
  std::vector<std::string> keys;
  for (const Entry& entry : entries_) keys.push_back(key_of(entry.option));
  return ": unknown key" + did_you_mean(name, keys) + "; see mwmesh mesh --print-config";
}

void OptionSet::read_environment() {
  for (Entry& entry : entries_) {
    const std::string name = variable_of(entry.option.name);
    const char* text = std::getenv(name.c_str());  // NOLINT(concurrency-mt-unsafe)
    if (text == nullptr || *text == '\0') continue;
    entry.text = text;
    entry.where = name + "=" + text;
  }
}

void OptionSet::read_flags() {
  for (Entry& entry : entries_) {
    if (entry.flag->count() == 0) continue;
    const bool is_switch = entry.option.kind == ValueKind::kSwitch;
    entry.text = is_switch ? (entry.flag_switch ? "true" : "false") : entry.flag_text;
    entry.where = "--" + entry.option.name + (is_switch ? "" : " " + entry.text);
    if (entry.text.empty()) refuse("--" + entry.option.name, ": empty value");
  }
}

void OptionSet::settle(Entry& entry) {
  const Option& option = entry.option;
  if (entry.text.empty()) return;
  try {
    entry.text = canonical_text(option.kind, entry.text);
    const auto& choices = option.choices;
    if (!choices.empty() &&
        std::find(choices.begin(), choices.end(), entry.text) == choices.end()) {
      throw Error(ErrorKind::kUsage, "expected one of " + joined(choices, ", "));
    }
    if (option.assign) option.assign(entry.text);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kUsage) throw;
    refuse(entry.where, std::string(": ") + error.what());
  }
}

std::string OptionSet::toml() const {
  std::string out;
  for (const Entry& entry : entries_) {
    const std::string key = key_of(entry.option);
    if (entry.text.empty()) {
      out += "# " + key + ": not set\n";
    } else {
      out += key + " = " + toml_of_text(entry.option.kind, entry.text) + "\n";
    }
  }
  return out;
}

io::Json OptionSet::json() const {
  io::Json out = io::Json::object();
  for (const Entry& entry : entries_) {
    out[key_of(entry.option)] = json_of_text(entry.option.kind, entry.text);
  }
  return out;
}

}  // namespace mw::cli
