// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options by name and text, from the table that the program has.
#include <algorithm>

#include "engine/api/asked.h"
#include "engine/api/errors.h"
#include "engine/request/values.h"
#include "engine/settings/number_text.h"
#include "engine/settings/setting_table.h"
#include "io/file/errors.h"
#include "io/json/json.h"

namespace mw::api {
namespace {

using request::OptionSet;

/// The names of the library's options, as flags.
const std::vector<std::string>& all_flags() {
  static const std::vector<std::string> flags = [] {
    std::vector<std::string> out;
    Asked asked;
    for (const OptionSet::Entry& entry : asked.options().entries()) {
      out.push_back(entry.option.name);
    }
    return out;
  }();
  return flags;
}

bool is_option(const std::string& flag) {
  return std::ranges::find(all_flags(), flag) != all_flags().end();
}

/// ERRORS: mw::Error(kUsage) for a name that no option has.
std::string known_flag(const char* name) {
  require(name, "name");
  std::string flag = flag_of(name);
  if (is_option(flag)) return flag;
  std::vector<std::string> names;
  std::string listed = "; there are ";
  for (const std::string& one : all_flags()) {
    names.push_back(request::key_of(one));
    listed += (names.size() == 1 ? "" : ", ") + names.back();
  }
  const std::string near = engine::did_you_mean(name, names);
  io::fail_usage(std::string(name) + ": no such option" + (near.empty() ? listed : near));
}

/// What the calls of the library are called in the table.
constexpr std::pair<request::Calls, const char*> kCalls[] = {{request::kOpening, "open"},
                                                             {request::kMeshing, "mesh"},
                                                             {request::kWriting, "write"},
                                                             {request::kVerifying, "verify"}};

io::Json row_of(const OptionSet::Entry& entry) {
  const request::Option& option = entry.option;
  const auto& settings = engine::setting_table();
  io::Json out{{"name", request::key_of(option.name)},
               {"kind", request::name(option.kind)},
               {"value", option.value},
               {"help", in_words(option.help)},
               {"group", option.group}};
  out["default"] = option.fallback.empty() ? io::Json(nullptr) : io::Json(option.fallback);
  io::Json calls = io::Json::array();
  for (const auto& [call, name] : kCalls) {
    if ((option.calls & call) != 0) calls.push_back(name);
  }
  out["calls"] = std::move(calls);
  out["choices"] = io::Json(option.choices);
  out["setting"] =
      option.name == "preset" ||
      std::ranges::find(settings, option.name, &engine::Setting::name) != settings.end();
  return out;
}

/// Returns the option whose flag a message has at `at`; empty if there is none.
std::string flag_at(const std::string& message, std::size_t at) {
  const bool starts_word = at == 0 || message[at - 1] == ' ' || message[at - 1] == '(';
  if (!starts_word || message.compare(at, 2, "--") != 0) return "";
  const std::size_t end = message.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", at + 2);
  std::string flag = message.substr(at + 2, end - at - 2);
  return is_option(flag) ? flag : "";
}

}  // namespace

Asked::Asked() : options_(request::Face::kLibrary) {
  request::add_mesh_options(options_, request_);
  options_.resolve({});
}

Asked::Asked(const mw_options* options) : Asked() {
  if (options != nullptr) options_.resolve(options->given);
}

std::string flag_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

std::string in_words(const std::string& message) {
  std::string out;
  std::size_t done = 0;
  for (std::size_t at = message.find("--"); at != message.npos; at = message.find("--", at + 2)) {
    const std::string flag = flag_at(message, at);
    if (flag.empty()) continue;
    out += message.substr(done, at - done) + request::key_of(flag);
    done = at + 2 + flag.size();
  }
  return out + message.substr(done);
}

std::string option_of(const std::string& message) {
  return request::key_of(flag_at(message, 0));
}

}  // namespace mw::api

mw_options* mw_options_new(mw_error** error) {
  return mw::api::made(error, [] { return new mw_options(); });
}

void mw_options_free(mw_options* options) {
  delete options;
}

mw_status mw_options_set(mw_options* options, const char* name, const char* text,
                         mw_error** error) {
  return mw::api::tried(error, [&] {
    mw::api::require(options, "options");
    const std::string flag = mw::api::known_flag(name);
    if (text == nullptr) {
      options->given.erase(flag);
    } else {
      options->table.options().resolve({{flag, text}});
      options->given[flag] = text;
    }
    options->told.clear();
  });
}

const char* mw_options_get(const mw_options* options, const char* name, mw_error** error) {
  return mw::api::made(error, [&] {
    mw::api::require(options, "options");
    const std::string flag = mw::api::known_flag(name);
    const std::lock_guard lock(options->mutex);
    mw::request::OptionSet& table = options->table.options();
    table.resolve(options->given);
    return (options->told[flag] = table.text(flag)).c_str();
  });
}

const char* mw_options_table() {
  return mw::api::made(nullptr, [] {
    static const std::string table = [] {
      mw::io::Json rows = mw::io::Json::array();
      mw::api::Asked asked;
      for (const auto& entry : asked.options().entries()) rows.push_back(mw::api::row_of(entry));
      return rows.dump_indented();
    }();
    return table.c_str();
  });
}
