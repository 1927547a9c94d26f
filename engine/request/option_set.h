// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One list of options: flags, config keys, environment variables, defaults and help from one entry.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/settings/setting_table.h"
#include "io/json/json.h"
#include "io/names/label_names.h"

namespace mw::request {

using engine::ValueKind;

/// Where help lists an option.
enum class Listed {
  kInHelp,     ///< --help and --help-all
  kInHelpAll,  ///< --help-all: for experts
  kNowhere,    ///< an older name, which is still taken
};

/// Who takes an option: the program, the library, or both.
enum class Face { kBoth, kProgram, kLibrary };

/// Which calls of the library take an option; several are joined by '|'.
enum Calls : unsigned { kMeshing = 1, kOpening = 2, kWriting = 4, kVerifying = 8 };

/// Names of options and their values as text.
using OptionTexts = std::vector<std::pair<std::string, std::string>>;
using TextCheck = std::function<void(const std::string&)>;

struct Option {
  std::string name;   ///< the flag without dashes; the config key has '_' for '-'
  std::string value;  ///< what help calls the value; nothing where it shows the choices
  std::string help;   ///< one line
  std::string group;  ///< the heading that help lists it under
  ValueKind kind = ValueKind::kText;
  std::string fallback;              ///< the default as text; empty: unset
  std::vector<std::string> choices;  ///< the only texts allowed; empty: any of the kind
  /// All names of the flag, "-o,--output", that of an argument in capitals; empty for "--name".
  std::string flags;
  Face face = Face::kBoth;
  unsigned calls = kMeshing;
  Listed listed = Listed::kInHelp;
  bool required = false;
  bool only_flag = false;   ///< neither a key nor a variable has it
  bool repeats = false;     ///< may be given several times: the texts are joined by ';'
  std::string word;         ///< a text that is no name of a label, where names are taken
  bool has_labels = false;  ///< the value has labels in it, though its kind is not kLabels
  /// Looks at the text before names of labels become numbers.  ERRORS: mw::Error(kUsage).
  TextCheck check_named = nullptr;
  /// Takes the value over.  ERRORS: mw::Error(kUsage) for one that is not allowed.
  std::function<void(const std::string&)> assign;
  /// Returns values of other options that this value implies, where nothing else gives them.
  std::function<OptionTexts(const std::string&)> implied;
};

/// The name of an option as keys of config files and the library have it: "max_distance".
[[nodiscard]] std::string key_of(std::string name);

/// A value of a config file, and where it stands: "run.toml:3: window = 41".
struct ConfigText {
  std::string text;
  std::string where;
};
using ConfigTexts = std::map<std::string, ConfigText>;  ///< by the option's name

/// The options of one job.  Each value comes from the strongest of: default < what another option
/// implies < config file < environment (MW_NAME) < flag.  In the library
/// there are flags alone.
class OptionSet {
 public:
  /// `face` is the program (the default) or the library; options of the other one are not taken.
  OptionSet() = default;
  explicit OptionSet(Face face) : face_(face) {}

  void add(Option option);

  /// Finds and assigns every value, in the order of the list; those with names of labels wait for
  /// resolve_names().  flags holds the texts of those that were given, by name; a switch is "true"
  /// or "false".  ERRORS: mw::Error(kUsage) naming flag, variable, or file, line and key.
  void resolve(const std::map<std::string, std::string>& flags, const ConfigTexts& config = {});
  /// REQUIRES (all that follow): resolve().
  /// Assigns the values with names of labels (engine/settings/named_labels.h); only if there are
  /// any, it calls names().  ERRORS: those of resolve() and of names().
  void resolve_names(const std::function<io::LabelNames()>& names);
  /// ERRORS: mw::Error(kUsage) naming the first required option without a value.
  void require_all() const;
  /// Returns the effective value, empty if unset.  REQUIRES: there is an option of that name.
  [[nodiscard]] const std::string& text(const std::string& name) const { return find(name).text; }
  /// Returns whether the value was given as a flag.  REQUIRES: there is an option of that name.
  [[nodiscard]] bool is_flag(const std::string& name) const { return find(name).is_flag; }
  /// Returns the effective values as a config file that gives the same ones.
  /// ERRORS: mw::Error(kUsage) naming a value that such a file cannot hold (fits_in_toml()).
  [[nodiscard]] std::string toml() const;
  /// Returns the values of toml() as JSON; an unset one is null.
  [[nodiscard]] io::Json json() const;

  struct Entry {
    Option option;
    std::string text;  ///< effective, in canonical form; empty if unset
    /// "--window 41", "MW_WINDOW=41", "run.toml:3: window = 41"; of the option that implies it
    std::string where;
    bool is_given = false;  ///< by a flag, a variable or a config file
    bool is_flag = false;   ///< by a flag
  };
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

 private:
  [[nodiscard]] Entry& find(const std::string& name);
  [[nodiscard]] const Entry& find(const std::string& name) const;
  void read_config(const ConfigTexts& config);
  void read_environment();
  void read_flags(const std::map<std::string, std::string>& flags);
  void read_implied();
  static void settle(Entry& entry);
  [[nodiscard]] static bool waits_for_names(const Entry& entry);

  Face face_ = Face::kProgram;
  std::vector<Entry> entries_;
};

/// Returns the environment variable of an option: MW_EDGE_VARIANCE for edge-variance.
[[nodiscard]] std::string variable_of(const std::string& option);

/// Refuses a variable MW_... that none of these options reads, unless it is empty or known
/// otherwise, as are those that tests and benchmarks set: MW_PROGRAM and MW_TEST_...
/// ERRORS: mw::Error(kUsage) naming the first one.
void refuse_unknown_variables(const std::vector<const OptionSet*>& all);

/// Returns the words with `between` between them.
[[nodiscard]] std::string joined(const std::vector<std::string>& words, const std::string& between);

}  // namespace mw::request
