// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Settings of the library, from the table of settings.
#include <algorithm>

#include "engine/api/guarded.h"
#include "engine/api/mesh_settings.h"
#include "engine/settings/setting_table.h"

namespace mw::api {
namespace {

std::string library_name(const std::string& name) {
  std::string out = name;
  std::replace(out.begin(), out.end(), '-', '_');
  return out;
}

const engine::Setting& find(std::string_view name) {
  std::string all;
  for (const engine::Setting& setting : engine::setting_table()) {
    const std::string known = library_name(setting.name);
    if (known == name) return setting;
    all += (all.empty() ? "" : ", ") + known;
  }
  throw Error(ErrorKind::kUsage, std::string(name) + ": no such setting; there are " + all);
}

}  // namespace

engine::MeshSettings mesh_settings(const mwmesh::Settings& settings) {
  engine::MeshSettings out;
  for (const auto& [name, text] : settings.changed()) engine::set(find(name), out, text);
  engine::check(out);
  return out;
}

}  // namespace mw::api

namespace mwmesh {

Settings& Settings::set(std::string_view name, std::string_view text) {
  mw::api::guarded([&] {
    mw::engine::MeshSettings tried;
    const mw::engine::Setting& setting = mw::api::find(name);
    mw::engine::set(setting, tried, std::string(text));
    changed_[std::string(name)] = setting.text(tried);
  });
  return *this;
}

std::string Settings::get(std::string_view name) const {
  return mw::api::guarded([&] { return mw::api::find(name).text(mw::api::mesh_settings(*this)); });
}

std::vector<SettingInfo> Settings::all() {
  std::vector<SettingInfo> out;
  for (const mw::engine::Setting& setting : mw::engine::setting_table()) {
    out.push_back({.name = mw::api::library_name(setting.name),
                   .help = mw::api::library_words(setting.help),
                   .fallback = setting.text(mw::engine::MeshSettings{}),
                   .choices = setting.choices});
  }
  return out;
}

}  // namespace mwmesh
