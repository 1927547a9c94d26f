// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Settings of the library, from the table of settings.
#include <algorithm>

#include "engine/api/guarded.h"
#include "engine/api/jobs.h"
#include "engine/settings/number_text.h"
#include "engine/settings/setting_table.h"
#include "io/file/errors.h"

namespace mw::api {
namespace {

std::string library_name(const std::string& name) {
  std::string out = name;
  std::replace(out.begin(), out.end(), '-', '_');
  return out;
}

constexpr const char* kPreset = "preset";

const engine::Setting& find(std::string_view name) {
  std::vector<std::string> all{kPreset};
  std::string listed = std::string("; there are ") + kPreset;
  for (const engine::Setting& setting : engine::setting_table()) {
    all.push_back(library_name(setting.name));
    if (all.back() == name) return setting;
    listed += ", " + all.back();
  }
  const std::string near = engine::did_you_mean(name, all);
  io::fail_usage(std::string(name) + ": no such setting" + (near.empty() ? listed : near));
}

/// Sets a value.  Errors name the setting as the library does.
void set(std::string_view name, engine::MeshSettings& settings, const std::string& text) {
  const engine::Setting& setting = find(name);
  try {
    engine::set(setting, settings, text);
  } catch (const Error& error) {
    std::string reason = error.what();
    if (reason.starts_with(setting.name + " ")) reason.erase(0, setting.name.size() + 1);
    throw Error(error.kind(), std::string(name) + ": " + reason);
  }
}

const engine::Preset& find_preset(const std::string& name) {
  if (const engine::Preset* preset = engine::find_preset(name)) return *preset;
  io::fail_usage("preset: there is no '" + name + "'; there are draft, default and fine");
}

/// Returns the values, each of which is allowed by itself.
engine::MeshSettings values_of(const mwmesh::Settings& settings) {
  engine::MeshSettings out;
  const auto& changed = settings.changed();
  const auto preset = changed.find(kPreset);
  if (preset != changed.end()) {
    for (const auto& [name, text] : find_preset(preset->second).values) {
      set(library_name(name), out, text);
    }
  }
  for (const auto& [name, text] : changed) {
    if (name != kPreset) set(name, out, text);
  }
  return out;
}

}  // namespace

engine::MeshSettings mesh_settings(const mwmesh::Settings& settings) {
  engine::MeshSettings out = values_of(settings);
  engine::check(out);
  return out;
}

}  // namespace mw::api

namespace mwmesh {

Settings& Settings::set(std::string_view name, std::string_view text) {
  mw::api::guarded([&] {
    if (name == mw::api::kPreset) {
      changed_[std::string(name)] = mw::api::find_preset(std::string(text)).name;
      return;
    }
    mw::engine::MeshSettings tried;
    mw::api::set(name, tried, std::string(text));
    changed_[std::string(name)] = mw::api::find(name).text(tried);
  });
  return *this;
}

std::string Settings::get(std::string_view name) const {
  if (name == mw::api::kPreset) {
    const auto set = changed_.find(mw::api::kPreset);
    return set == changed_.end() ? mw::engine::kDefaultPreset : set->second;
  }
  return mw::api::guarded([&] { return mw::api::find(name).text(mw::api::values_of(*this)); });
}

std::vector<SettingInfo> Settings::all() {
  std::vector<SettingInfo> out{{.name = mw::api::kPreset,
                                .help = mw::engine::kPresetHelp,
                                .fallback = mw::engine::kDefaultPreset,
                                .choices = {}}};
  for (const mw::engine::Preset& preset : mw::engine::presets()) {
    out.front().choices.push_back(preset.name);
  }
  for (const mw::engine::Setting& setting : mw::engine::setting_table()) {
    out.push_back({.name = mw::api::library_name(setting.name),
                   .help = mw::api::library_words(setting.help),
                   .fallback = setting.text(mw::engine::MeshSettings{}),
                   .choices = setting.choices});
  }
  return out;
}

}  // namespace mwmesh
