// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Options that several commands have: settings, the machine, labels, meshes.
#include "engine/cli/options/shared_options.h"

#include "engine/cli/options/values.h"
#include "engine/settings/named_labels.h"
#include "engine/settings/setting_table.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/open_mesh.h"
#include "kernels/core/error.h"

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
    case SettingKind::kSizes:
      return ValueKind::kNumberOrText;
    case SettingKind::kChoice:
      break;
  }
  return ValueKind::kText;
}

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

int parse_threads(const std::string& text) {
  const std::int64_t threads = parse_integer(text);
  engine::check_threads(threads);
  return static_cast<int>(threads);
}

/// Takes what is known before the first row, and ends the reading by throwing Enough.
struct NamesSink : io::NoSink {
  struct Enough {};

  void begin(const io::MeshHeader& header) override {
    names = header.names;
    throw Enough();
  }

  io::LabelNames names;
};

}  // namespace

void add_setting_options(OptionSet& options, engine::MeshSettings& settings) {
  options.add(preset_option());
  for (const engine::Setting& setting : engine::setting_table()) {
    const bool has_sizes = setting.kind == SettingKind::kSizes;
    options.add({.name = setting.name,
                 .value = setting.value,
                 .help = setting.help,
                 .group = kShapeGroup,
                 .kind = value_kind(setting.kind),
                 .fallback = setting.text(engine::MeshSettings{}),
                 .choices = setting.choices,
                 .listed = setting.expert ? Listed::kInHelpAll : Listed::kInHelp,
                 .has_labels = has_sizes,
                 .check_named = has_sizes ? TextCheck(engine::check_sizes) : nullptr,
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
               .assign = into(memory, parse_bytes)});
  options.add({.name = "threads",
               .value = "N",
               .help = "worker threads; 0: all cores",
               .group = kRunGroup,
               .kind = ValueKind::kInteger,
               .fallback = "0",
               .assign = into(threads, parse_threads)});
}

void add_choice_options(OptionSet& options, engine::LabelChoice& choice) {
  options.add({.name = "labels",
               .value = "LIST",
               .help = "labels of the mesh, as 1,5-9,Lesion; the others are left out",
               .group = kLabelGroup,
               .kind = ValueKind::kLabels,
               .assign = into(choice.labels, parse_labels)});
  options.add({.name = "background",
               .value = "L",
               .help = "the label that is left out of the mesh, as 0",
               .group = kLabelGroup,
               .kind = ValueKind::kLabels,
               .assign = into(choice.background, parse_label)});
}

void add_force_option(OptionSet& options, bool& force) {
  options.add({.name = "force",
               .help = "replaces files that are not of this program",
               .group = kOutputGroup,
               .kind = ValueKind::kSwitch,
               .assign = into(force)});
}

void add_mesh_option(OptionSet& options, std::filesystem::path& mesh, const std::string& what) {
  options.add({.name = "mesh",
               .value = "MESH",
               .help = what,
               .group = kInputGroup,
               .flags = "MESH,--mesh",
               .required = true,
               .assign = into(mesh)});
}

io::LabelNames names_of(const std::filesystem::path& mesh) {
  NamesSink sink;
  try {
    io::copy_mesh(mesh, sink);
  } catch (const NamesSink::Enough&) {
    return sink.names;
  }
  return {};
}

std::string mesh_note() {
  return "MESH: " + io::read_mesh_extensions() + ".\n";
}

}  // namespace mw::cli
