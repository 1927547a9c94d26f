// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The settings of the engine as options.
#include "engine/cli/setting_options.h"

#include "engine/settings/setting_table.h"

namespace mw::cli {
namespace {

using engine::SettingKind;

ValueKind value_kind(SettingKind kind) {
  switch (kind) {
    case SettingKind::kInteger:
      return ValueKind::kInteger;
    case SettingKind::kNumber:
      return ValueKind::kNumber;
    case SettingKind::kNumberOrNone:
      return ValueKind::kNumberOrNone;
    case SettingKind::kNumberOrAuto:
      return ValueKind::kNumberOrAuto;
    case SettingKind::kSwitch:
      return ValueKind::kSwitch;
    case SettingKind::kChoice:
    case SettingKind::kSizes:
      break;
  }
  return ValueKind::kText;
}

}  // namespace

void add_setting_options(OptionSet& options, engine::MeshSettings& settings) {
  for (const engine::Setting& setting : engine::setting_table()) {
    options.add({.name = setting.name,
                 .value = setting.value,
                 .help = setting.help,
                 .kind = value_kind(setting.kind),
                 .fallback = setting.text(engine::MeshSettings{}),
                 .choices = setting.choices,
                 .assign = [&](const std::string& text) { set(setting, settings, text); }});
  }
}

}  // namespace mw::cli
