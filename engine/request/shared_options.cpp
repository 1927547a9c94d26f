// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options that several jobs have: settings, the machine, labels.
#include "engine/request/shared_options.h"

#include "engine/request/values.h"
#include "engine/settings/named_labels.h"
#include "engine/settings/setting_table.h"
#include "io/file/errors.h"

namespace mw::request {
namespace {

Option preset_option() {
  Option out{.name = "preset",
             .help = engine::kPresetHelp,
             .group = kShapeGroup,
             .fallback = engine::kDefaultPreset};
  for (const engine::Preset& preset : engine::presets()) out.choices.push_back(preset.name);
  out.implied = [](const std::string& text) {
    const engine::Preset* preset = engine::find_preset(text);
    return preset == nullptr ? OptionTexts() : preset->values;
  };
  return out;
}

constexpr const char* kKeepsZero = "none";

int parse_threads(const std::string& text) {
  const std::int64_t threads = parse_integer(text);
  if (threads < 0 || threads > 1024) io::fail_usage("must be from 1 to 1024, or 0 for all cores");
  return static_cast<int>(threads);
}

}  // namespace

void add_setting_options(OptionSet& options, engine::MeshSettings& settings) {
  options.add(preset_option());
  for (const engine::Setting& setting : engine::setting_table()) {
    options.add({.name = setting.name,
                 .value = setting.value,
                 .help = setting.help,
                 .group = kShapeGroup,
                 .kind = setting.kind,
                 .fallback = setting.text(engine::MeshSettings{}),
                 .choices = setting.choices,
                 .listed = setting.expert ? Listed::kInHelpAll : Listed::kInHelp,
                 .has_labels = setting.has_labels,
                 .check_named = setting.has_labels ? TextCheck(engine::check_sizes) : nullptr,
                 .assign = [&](const std::string& text) { set(setting, settings, text); }});
  }
}

void add_resource_options(OptionSet& options, int& threads, std::optional<std::uint64_t>& memory,
                          const std::string& budget) {
  options.add({.name = "memory",
               .value = "SIZE",
               .help = budget + ", as 512MiB, 4GB [half of what is free]",
               .group = kRunGroup,
               .kind = ValueKind::kSize,
               .calls = kMeshing | kVerifying,
               .assign = into(memory, parse_bytes)});
  options.add({.name = "threads",
               .value = "N",
               .help = "worker threads; 0: one for each core it may use",
               .group = kRunGroup,
               .kind = ValueKind::kInteger,
               .fallback = "0",
               .calls = kMeshing | kVerifying,
               .assign = into(threads, parse_threads)});
}

void add_choice_options(OptionSet& options, engine::LabelChoice& choice) {
  options.add({.name = "labels",
               .value = "LIST",
               .help = "labels of the mesh, as 1,5-9,Lesion; the others are left out",
               .group = kLabelGroup,
               .kind = ValueKind::kLabels,
               .calls = kMeshing | kVerifying,
               .assign = into(choice.labels, parse_labels)});
  options.add({.name = "background",
               .value = "L",
               .help = "left out, as 0, or none [0 where names say it is nothing]",
               .group = kLabelGroup,
               .kind = ValueKind::kLabels,
               .calls = kMeshing | kVerifying,
               .word = kKeepsZero,
               .assign = [&choice](const std::string& text) {
                 choice.keeps_zero = text == kKeepsZero;
                 choice.background.reset();
                 if (text != kKeepsZero) choice.background = parse_label(text);
               }});
}

}  // namespace mw::request
