// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is on the command line; this alone knows the library that reads it.
#include "engine/cli/command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <filesystem>

#include "engine/settings/number_text.h"
#include "io/file/errors.h"
#include "io/mesh/open_mesh.h"

namespace mw::cli {
namespace {

[[noreturn]] void refuse(const std::string& what, const Command* command) {
  const std::string see = command == nullptr ? "mwmesh" : "mwmesh " + command->name;
  io::fail_usage(what + "; see " + see + " --help");
}

const Command& find_command(const std::vector<Command>& commands, const std::string& name) {
  const auto found = std::find_if(commands.begin(), commands.end(), [&](const Command& command) {
    return name == command.name || (name == command.older_name && !name.empty());
  });
  if (found != commands.end()) return *found;
  if (std::error_code ignored; std::filesystem::exists(name, ignored)) {
    const bool is_mesh = io::is_read_mesh_path(name);
    refuse(name + ": no command; give mwmesh " +
               (is_mesh ? "info " + name : "mesh " + name + " -o OUTPUT.vtu"),
           nullptr);
  }
  std::vector<std::string> known;
  for (const Command& command : commands) known.push_back(command.name);
  refuse(name + ": unknown command" + engine::did_you_mean(name, known), nullptr);
}

/// The flags of one command, and where the library leaves their values.
class Reader {
 public:
  explicit Reader(const Command* command) : command_(command), app_("", "mwmesh") {
    app_.set_help_flag("-h,--help");
    app_.set_help_all_flag("--help-all");
    app_.set_version_flag("-v,--version");
    if (command == nullptr) return;
    for (const OptionSet::Entry& entry : command->options.entries()) add(entry.option);
  }

  CommandLine read(std::vector<std::string> arguments) {
    CommandLine line{.command = command_};
    refuse_names_like_flags(arguments);
    refuse_empty_values(arguments);
    std::reverse(arguments.begin(), arguments.end());  // the library takes them from the end
    try {
      app_.parse(arguments);
    } catch (const CLI::CallForHelp&) {
      line.asked = Asked::kHelp;
    } catch (const CLI::CallForAllHelp&) {
      line.asked = Asked::kHelpAll;
    } catch (const CLI::CallForVersion&) {
      line.asked = Asked::kVersion;
    } catch (const CLI::ParseError& error) {
      refuse(explain(error), command_);
    }
    for (const Flag& flag : flags_) {
      if (flag.parsed->count() == 0) continue;
      line.flags[flag.option->name] =
          flag.is_switch() ? (flag.is_on ? "true" : "false") : flag.text;
    }
    return line;
  }

 private:
  /// Refuses -volume.npy, which the library would take for -v and more flags behind it.
  void refuse_names_like_flags(const std::vector<std::string>& arguments) const {
    for (const std::string& word : arguments) {
      if (word == "--") return;
      if (word.size() < 3 || (!word.starts_with("-v") && !word.starts_with("-h"))) continue;
      refuse(word + ": unknown flag; a file of that name is ./" + word, command_);
    }
  }

  /// Refuses `--report=`, for whose value the library would take the next argument.
  void refuse_empty_values(const std::vector<std::string>& arguments) const {
    for (const std::string& word : arguments) {
      if (word == "--") return;
      const std::size_t equals = word.find('=');
      if (!word.starts_with("--") || equals + 1 != word.size()) continue;
      refuse(word.substr(0, equals) + ": empty value", command_);
    }
  }

  struct Flag {
    const Option* option = nullptr;
    CLI::Option* parsed = nullptr;
    std::string text;
    bool is_on = false;

    [[nodiscard]] bool is_switch() const { return option->kind == ValueKind::kSwitch; }
  };

  void add(const Option& option) {
    Flag& flag = flags_.emplace_back();
    flag.option = &option;
    const std::string names = option.flags.empty() ? "--" + option.name : option.flags;
    flag.parsed =
        flag.is_switch() ? app_.add_flag(names, flag.is_on) : app_.add_option(names, flag.text);
    if (option.repeats) {
      flag.parsed->multi_option_policy(CLI::MultiOptionPolicy::Join)->delimiter(';');
    }
  }

  [[nodiscard]] std::string explain(const CLI::ParseError& error) const {
    const std::vector<std::string> unknown = app_.remaining();
    const auto flag = std::find_if(unknown.begin(), unknown.end(), [](const std::string& word) {
      return word.size() > 1 && word.starts_with("-");
    });
    if (flag != unknown.end()) {
      const std::string name = flag->substr(0, flag->find('='));
      return name + ": unknown flag" + engine::did_you_mean(name, known_flags());
    }
    if (!unknown.empty()) {
      return unknown.front() + ": one argument too many" + way_to_output(unknown.front());
    }
    const auto twice = std::find_if(flags_.begin(), flags_.end(), [](const Flag& given) {
      return !given.is_switch() && !given.option->repeats && given.parsed->count() > 1;
    });
    if (twice != flags_.end()) return twice->parsed->get_name() + ": is given more than once";
    return error.what();
  }

  /// Returns how the command is told what to write, where it was not.
  [[nodiscard]] std::string way_to_output(const std::string& word) const {
    const bool lacks_output = std::any_of(flags_.begin(), flags_.end(), [](const Flag& flag) {
      return flag.option->flags == "-o,--output" && flag.parsed->count() == 0;
    });
    return lacks_output ? "; to write it, give -o " + word : "";
  }

  [[nodiscard]] std::vector<std::string> known_flags() const {
    std::vector<std::string> out{"--help", "--help-all", "--version"};
    for (const Flag& flag : flags_) out.push_back("--" + flag.option->name);
    return out;
  }

  const Command* command_;
  CLI::App app_;
  std::deque<Flag> flags_;  ///< the library points at them
};

}  // namespace

CommandLine parse_command_line(const std::vector<Command>& commands,
                               std::vector<std::string> arguments) {
  if (!arguments.empty() && arguments.front() == "help") {
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
  }
  if (arguments.empty() || arguments.front().starts_with("-")) {
    return Reader(nullptr).read(arguments);
  }
  const Command& command = find_command(commands, arguments.front());
  arguments.erase(arguments.begin());
  return Reader(&command).read(arguments);
}

}  // namespace mw::cli
