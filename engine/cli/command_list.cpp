// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The subcommands and their flags as plain lists, for the manual page and for shells.
#include "engine/cli/command_list.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

namespace mw::cli {
namespace {

/// "none" of "T|none", "coarse octree dense" of "coarse|octree|dense": what is not in capitals.
std::vector<std::string> words_of(const std::string& value) {
  std::vector<std::string> out;
  if (value.find('|') == value.npos) return out;
  for (std::size_t begin = 0; begin <= value.size();) {
    const std::size_t end = std::min(value.find('|', begin), value.size());
    const std::string word = value.substr(begin, end - begin);
    const bool is_word = std::any_of(word.begin(), word.end(), [](char c) {
      return std::islower(static_cast<unsigned char>(c)) != 0;
    });
    if (is_word) out.push_back(word);
    begin = end + 1;
  }
  return out;
}

FlagFacts facts_of(const CLI::Option& option, bool positional) {
  FlagFacts out{.value = option.get_items_expected_max() == 0 ? "" : option.get_type_name(),
                .help = option.get_description(),
                .positional = positional};
  out.words = words_of(out.value);
  if (positional) {
    out.names.push_back(option.get_name(true));
    return out;
  }
  for (const std::string& name : option.get_snames()) out.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) out.names.push_back("--" + name);
  return out;
}

CommandFacts facts_of(const CLI::App& command) {
  CommandFacts out{.name = command.get_name(),
                   .about = command.get_description(),
                   .footer = command.get_footer()};
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) out.flags.push_back(facts_of(*option, true));
    if (option->nonpositional()) out.flags.push_back(facts_of(*option, false));
  }
  return out;
}

std::vector<FlagFacts> those(const CommandFacts& command, bool positional) {
  std::vector<FlagFacts> out;
  for (const FlagFacts& flag : command.flags) {
    if (flag.positional == positional) out.push_back(flag);
  }
  return out;
}

}  // namespace

std::vector<CommandFacts> list_commands(const CLI::App& program) {
  std::vector<CommandFacts> out;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (!command->get_group().empty()) out.push_back(facts_of(*command));
  }
  return out;
}

std::vector<FlagFacts> flags_of(const CommandFacts& command) {
  return those(command, false);
}

std::vector<FlagFacts> positionals_of(const CommandFacts& command) {
  return those(command, true);
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

std::vector<std::string> names_of(const std::vector<FlagFacts>& flags) {
  std::vector<std::string> out;
  for (const FlagFacts& flag : flags) out.insert(out.end(), flag.names.begin(), flag.names.end());
  return out;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

}  // namespace mw::cli
