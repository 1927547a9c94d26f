// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One list of options: flags, config keys, environment variables, defaults and help from one entry.
#include "engine/request/option_set.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <set>

#include "engine/codt/worker_pool.h"
#include "engine/request/values.h"
#include "engine/settings/named_labels.h"
#include "io/file/errors.h"
#include "io/remote/http_client.h"
#include "kernels/core/error.h"

namespace mw::request {
namespace {

constexpr const char* kPrefix = "MW_";

/// Does the work; its errors of usage tell where the value was given.
template <class Work>
void with_place(const OptionSet::Entry& entry, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kUsage) throw;
    io::fail_usage(entry.where, ": ", error.what());
  }
}

/// Returns the names of the variables with our prefix that are not empty.
std::set<std::string> set_variables() {
  std::set<std::string> out;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::size_t equals = std::min(text.find('='), text.size());
    if (text.starts_with(kPrefix) && equals + 1 < text.size()) out.insert(text.substr(0, equals));
  }
  return out;
}

}  // namespace

std::string key_of(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

void OptionSet::add(Option option) {
  const bool is_library = face_ == Face::kLibrary;
  if (option.face == (is_library ? Face::kProgram : Face::kLibrary)) return;
  if (is_library && option.listed == Listed::kNowhere) return;
  entries_.push_back({.option = std::move(option), .text = "", .where = ""});
}

const OptionSet::Entry& OptionSet::find(const std::string& name) const {
  return *std::find_if(entries_.begin(), entries_.end(),
                       [&](const Entry& entry) { return entry.option.name == name; });
}

OptionSet::Entry& OptionSet::find(const std::string& name) {
  return const_cast<Entry&>(std::as_const(*this).find(name));
}

void OptionSet::resolve(const std::map<std::string, std::string>& flags,
                        const ConfigTexts& config) {
  for (Entry& entry : entries_) {
    entry.text = entry.option.fallback;
    entry.where = entry.option.name;
    entry.is_given = entry.is_flag = false;
  }
  read_config(config);
  if (face_ == Face::kProgram) read_environment();
  read_flags(flags);
  read_implied();
  for (Entry& entry : entries_) {
    if (!waits_for_names(entry)) {
      settle(entry);
    } else if (entry.option.check_named) {
      with_place(entry, [&] { entry.option.check_named(entry.text); });
    }
  }
}

bool OptionSet::waits_for_names(const Entry& entry) {
  const bool has_labels = entry.option.has_labels || entry.option.kind == ValueKind::kLabels;
  return has_labels && entry.text != entry.option.word && engine::has_names(entry.text);
}

void OptionSet::resolve_names(const std::function<io::LabelNames()>& names) {
  std::optional<io::LabelNames> known;
  for (Entry& entry : entries_) {
    if (!waits_for_names(entry)) continue;
    if (!known) known = names ? names() : io::LabelNames();
    with_place(entry, [&] { entry.text = engine::with_numbers(entry.text, *known); });
    settle(entry);
  }
}

void OptionSet::read_config(const ConfigTexts& config) {
  for (const auto& [name, given] : config) {
    Entry& entry = find(name);
    entry.text = given.text;
    entry.where = given.where;
    entry.is_given = true;
  }
}

void OptionSet::read_environment() {
  for (Entry& entry : entries_) {
    if (entry.option.only_flag) continue;
    const std::string name = variable_of(entry.option.name);
    const char* text = std::getenv(name.c_str());  // NOLINT(concurrency-mt-unsafe)
    if (text == nullptr || *text == '\0') continue;
    entry.text = text;
    entry.where = name + "=" + text;
    entry.is_given = true;
  }
}

void OptionSet::read_flags(const std::map<std::string, std::string>& flags) {
  for (const auto& [name, text] : flags) {
    Entry& entry = find(name);
    const bool is_program = face_ == Face::kProgram;
    const std::string flag = "--" + name;
    if (text.empty()) io::fail_usage(flag, ": empty value");
    entry.text = text;
    const bool has_text = is_program && entry.option.kind != ValueKind::kSwitch;
    entry.where = has_text ? flag + " " + text : flag;
    entry.is_given = entry.is_flag = true;
  }
}

void OptionSet::read_implied() {
  for (const Entry& source : entries_) {
    if (!source.option.implied || source.text.empty()) continue;
    for (const auto& [name, text] : source.option.implied(source.text)) {
      Entry& entry = find(name);
      if (entry.is_given) continue;
      entry.text = text;
      entry.where = source.where;
    }
  }
}

void OptionSet::settle(Entry& entry) {
  const Option& option = entry.option;
  if (entry.text.empty()) return;
  with_place(entry, [&] {
    if (entry.text != option.word) entry.text = canonical_text(option.kind, entry.text);
    const auto& choices = option.choices;
    if (!choices.empty() && std::ranges::find(choices, entry.text) == choices.end()) {
      io::fail_usage("expected one of " + joined(choices, ", "));
    }
    if (option.assign) option.assign(entry.text);
  });
}

void OptionSet::require_all() const {
  for (const Entry& entry : entries_) {
    if (!entry.option.required || !entry.text.empty()) continue;
    const std::string flags = entry.option.flags;
    const std::string name =
        flags.empty() ? "--" + entry.option.name : flags.substr(0, flags.find(','));
    const std::string value = name.starts_with('-') ? " " + entry.option.value : "";
    io::fail_usage(name + value + " is missing; see --help");
  }
}

std::string OptionSet::toml() const {
  std::string out;
  for (const Entry& entry : entries_) {
    if (entry.option.only_flag) continue;
    const std::string key = key_of(entry.option.name);
    if (!entry.text.empty()) {
      if (!fits_in_toml(entry.text)) {
        io::fail_usage(
            entry.where,
            ": has bytes that are no UTF-8, which a config file cannot hold; rename what it "
            "names, or leave it out here and give it as a flag of each run");
      }
      out += key + " = " + toml_of_text(entry.option.kind, entry.text) + "\n";
    } else if (entry.option.listed != Listed::kNowhere) {
      out += "# " + key + ": not set\n";
    }
  }
  return out;
}

io::Json OptionSet::json() const {
  io::Json out = io::Json::object();
  for (const Entry& entry : entries_) {
    if (entry.option.only_flag) continue;
    if (entry.text.empty() && entry.option.listed == Listed::kNowhere) continue;
    out[key_of(entry.option.name)] = json_of_text(entry.option.kind, entry.text);
  }
  return out;
}

std::string variable_of(const std::string& option) {
  std::string name = kPrefix;
  for (const char c : option) {
    name += c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return name;
}

void refuse_unknown_variables(const std::vector<const OptionSet*>& all) {
  std::set<std::string> known{"MW_PROGRAM", engine::codt::kWorkerVariable,
                              io::kAuthorizationVariable};
  for (const OptionSet* options : all) {
    for (const OptionSet::Entry& entry : options->entries()) {
      if (!entry.option.only_flag) known.insert(variable_of(entry.option.name));
    }
  }
  for (const std::string& name : set_variables()) {
    if (known.contains(name) || name.starts_with("MW_TEST_")) continue;
    io::fail_usage(name +
                   ": no option has this environment variable; unset it, or see "
                   "mwmesh mesh --help-all");
  }
}

}  // namespace mw::request
