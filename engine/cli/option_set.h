// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One list of options: flags, config keys, environment variables, defaults and help from one entry.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/json/json.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace mw::cli {

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
  kSwitch,
  kIntegerOrText,  ///< a string or, for TOML, an integer too
};

struct Option {
  std::string name;   ///< of the flag without dashes; the config key has '_' for '-'
  std::string value;  ///< what help calls the value; nothing where it shows the choices
  std::string help;
  ValueKind kind = ValueKind::kText;
  std::string fallback;              ///< the default as text; empty: unset
  std::vector<std::string> choices;  ///< the only texts allowed; empty: any of the kind
  std::string flags;                 ///< as CLI11 wants them; empty: "--name"
  /// Takes the value over.  ERRORS: mw::Error(kUsage) for one that is not allowed.
  std::function<void(const std::string&)> assign;
};

/// The options of one subcommand.  Each value comes from the strongest of: default < config file <
/// environment (MW_NAME) < flag.
class OptionSet {
 public:
  void add(Option option);
  /// Adds a flag for each option, configurable (environment.h).  REQUIRES: this outlives the
  /// parsing.
  void add_flags(CLI::App& app);
  /// Finds and assigns every value, in the order of the list.
  /// ERRORS: mw::Error(kUsage) naming flag, variable, or file, line and key.
  void resolve(const std::optional<std::filesystem::path>& config = {});
  /// The effective values as a config file that gives the same ones; REQUIRES: resolve().
  [[nodiscard]] std::string toml() const;
  /// The same as JSON; unset is null.
  [[nodiscard]] io::Json json() const;

 private:
  struct Entry {
    Option option;
    CLI::Option* flag = nullptr;
    std::string flag_text;
    bool flag_switch = false;
    std::string text;   ///< effective, in canonical form; empty: unset
    std::string where;  ///< "--window 41", "MW_WINDOW=41", "run.toml:3: window = 41"
  };

  [[nodiscard]] std::string unknown_key(const std::string& name) const;
  void read_config(const std::filesystem::path& path);
  void read_environment();
  void read_flags();
  static void settle(Entry& entry);

  std::deque<Entry> entries_;
};

}  // namespace mw::cli
