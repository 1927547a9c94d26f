// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The settings one by one: what each is called, what it may be, and its text.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "engine/settings/settings.h"

namespace mw::engine {

/// What the text of a value is.
enum class ValueKind {
  kText,
  kInteger,
  kNumber,
  kNumberOrNone,
  kNumberOrAuto,
  kNumbers,  ///< X,Y,Z
  kShape,    ///< X,Y,Z, integers
  kBox,      ///< X0,Y0,Z0,X1,Y1,Z1, integers
  kLabels,
  kSize,
  kSwitch,        ///< "true" or "false"
  kNumberOrText,  ///< a string or, for TOML, a number too
};

/// A field of MeshSettings.  Flag, config key, environment variable, default, help, check() and
/// the identity of a run all come from here.
struct Setting {
  std::string name;   ///< the flag without dashes; its name in the identity, too
  std::string value;  ///< what help calls the value; nothing for choices and switches
  std::string help;   ///< one line
  ValueKind kind = ValueKind::kText;
  std::vector<std::string> choices;  ///< the only texts allowed; empty: any of the kind
  bool has_labels = false;           ///< the value has labels in it
  bool expert = false;               ///< only --help-all lists it
  double least = std::numeric_limits<double>::lowest();  ///< of numbers, and included
  double most = std::numeric_limits<double>::max();      ///< of numbers, and included
  int step = 1;                                          ///< integers are multiples of it
  std::string allowed;                                   ///< what messages say after "must be"
  /// Returns the value as text.  ENSURES: read() makes the same value of it, and different values
  /// have different texts; empty only for sizes without any.
  std::function<std::string(const MeshSettings&)> text;
  /// ERRORS: mw::Error(kUsage) saying what was expected, for text that is not of the kind.
  std::function<void(MeshSettings&, const std::string&)> read;
  /// Returns whether the value, which is of the kind, is in its range; null if all values are.
  std::function<bool(const MeshSettings&)> is_allowed;
};

/// Every field of MeshSettings once, in the order of the documentation.  Thread-safe.
[[nodiscard]] const std::vector<Setting>& setting_table();

/// ERRORS: mw::Error(kUsage): "must be ALLOWED".
void check(const Setting& setting, const MeshSettings& settings);

/// Takes the value over.  ERRORS: those of Setting::read and check(); settings is then spoilt.
void set(const Setting& setting, MeshSettings& settings, const std::string& text);

/// What has to hold between settings that are allowed one by one.
struct SettingRule {
  bool (*is_kept)(const MeshSettings&) = nullptr;
  std::string told;  ///< the message when it is broken: what contradicts what, and the way out
};

/// Thread-safe.
[[nodiscard]] const std::vector<SettingRule>& setting_rules();

/// A row of values of the table under one name (--preset).
struct Preset {
  std::string name;
  /// Settings that are other than their defaults.
  std::vector<std::pair<std::string, std::string>> values;
};

inline constexpr const char* kPresetHelp =
    "draft: quick, no P4, P8; fine: finer, smoother surfaces";
inline constexpr const char* kDefaultPreset = "default";

/// Thread-safe.
[[nodiscard]] const std::vector<Preset>& presets();

/// Returns null where there is none of that name.
[[nodiscard]] const Preset* find_preset(const std::string& name);

}  // namespace mw::engine
