// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What --help says.
#include <algorithm>

#include "engine/cli/command.h"

namespace mw::cli {
namespace {

struct Line {
  std::string head;
  std::string text;
};

bool is_argument(const Option& option) {
  return !option.flags.empty() && !option.flags.starts_with('-');
}

/// Returns "-o, --output OUTPUT" or "INPUT"; an older name after these is left out.
std::string head_of(const Option& option) {
  if (is_argument(option)) return option.value;
  const std::string letter = option.flags.starts_with("--") || option.flags.empty()
                                 ? ""
                                 : option.flags.substr(0, 2) + ", ";
  const std::string value =
      option.choices.empty() || !option.value.empty() ? option.value : joined(option.choices, "|");
  return letter + "--" + option.name + (value.empty() ? "" : " " + value);
}

std::string text_of(const Option& option) {
  const bool says = !option.fallback.empty() && option.kind != ValueKind::kSwitch;
  return option.help + (says ? " [" + option.fallback + "]" : "");
}

std::string table_of(const std::vector<Line>& lines, std::size_t width) {
  std::string out;
  for (const Line& line : lines) {
    out += "  " + line.head + std::string(width - line.head.size() + 2, ' ') + line.text + "\n";
  }
  return out;
}

std::size_t width_of(const std::vector<Line>& lines) {
  std::size_t width = 0;
  for (const Line& line : lines) width = std::max(width, line.head.size());
  return width;
}

/// Returns "mwmesh mesh INPUT -o OUTPUT [OPTIONS]".
std::string usage_of(const Command& command) {
  std::string out = "Usage: mwmesh " + command.name;
  for (const OptionSet::Entry& entry : command.options.entries()) {
    const Option& option = entry.option;
    if (is_argument(option)) {
      out += option.required ? " " + option.value : " [" + option.value + "]";
    } else if (option.required) {
      const std::string first = option.flags.substr(0, option.flags.find(','));
      out += " " + (first.empty() ? "--" + option.name : first) + " " + option.value;
    }
  }
  return out + " [OPTIONS]\n";
}

}  // namespace

std::string help_of_program(const std::vector<Command>& commands) {
  std::vector<Line> lines;
  for (const Command& command : commands) lines.push_back({command.name, command.about});
  return "From a labelled voxel volume to a verified tetrahedral mesh.\n"
         "Usage: mwmesh COMMAND [OPTIONS]\n\nCommands:\n" +
         table_of(lines, width_of(lines)) +
         "\nmwmesh help COMMAND lists the options of a command, and mwmesh --version says which\n"
         "version this is.\n"
         "Exit codes: 0 done, 1 internal error, 2 usage or config, 3 bad input, 4 out of a "
         "resource,\n"
         "5 a check failed, 75 interrupted and --resume can go on, 130 interrupted.\n";
}

std::string help_of_command(const Command& command, bool all) {
  std::vector<std::pair<std::string, std::vector<Line>>> groups;
  std::size_t width = 0, hidden = 0;
  for (const OptionSet::Entry& entry : command.options.entries()) {
    const Option& option = entry.option;
    if (option.listed == Listed::kInHelpAll) ++hidden;
    if (option.listed == Listed::kNowhere || (option.listed == Listed::kInHelpAll && !all))
      continue;
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const auto& known) { return known.first == option.group; });
    if (group == groups.end()) group = groups.insert(group, {option.group, {}});
    group->second.push_back({head_of(option), text_of(option)});
    width = std::max(width, group->second.back().head.size());
  }
  std::string out = "mwmesh " + command.name + " " + command.about + ".\n" + usage_of(command);
  for (const auto& [title, lines] : groups) {
    out += "\n" + (title.empty() ? "Options" : title) + ":\n" + table_of(lines, width);
  }
  if (!command.note.empty()) out += "\n" + command.note;
  if (hidden > 0 && !all) {
    out += (command.note.empty() ? "\n" : "") + std::to_string(hidden) +
           " more options, for experts: mwmesh " + command.name + " --help-all\n";
  }
  return out;
}

}  // namespace mw::cli
