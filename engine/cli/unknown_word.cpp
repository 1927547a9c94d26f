// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is said of a command line that cannot be read.
#include "engine/cli/unknown_word.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "engine/cli/nearest.h"

namespace mw::cli {
namespace {

std::vector<std::string> flags_of(const CLI::App& command) {
  std::vector<std::string> out;
  for (const CLI::Option* option : command.get_options()) {
    const std::vector<std::string>& names = option->get_lnames();
    out.insert(out.end(), names.begin(), names.end());
  }
  return out;
}

/// Those that help lists.
std::vector<std::string> commands_of(const CLI::App& program) {
  std::vector<std::string> out;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (!command->get_group().empty()) out.push_back(command->get_name());
  }
  return out;
}

/// "windwo" of "--windwo=3".
std::string bare(const std::string& flag) {
  const std::size_t begin = std::min(flag.find_first_not_of('-'), flag.size());
  const std::size_t end = std::min(flag.find('='), flag.size());
  return flag.substr(begin, std::max(begin, end) - begin);
}

/// What is known of a command's unknown words: the first flag, or else the first word.
std::optional<std::string> unknown_word(const CLI::App& command) {
  const std::vector<std::string> words = command.remaining();
  if (words.empty()) return std::nullopt;
  const auto flag = std::find_if(words.begin(), words.end(), [](const std::string& word) {
    return word.size() > 1 && word.starts_with("-");
  });
  const bool is_program = command.get_parent() == nullptr;
  if (flag != words.end()) {
    const std::string name = flag->substr(0, flag->find('='));
    return name + ": unknown flag" + did_you_mean(bare(*flag), flags_of(command), "--");
  }
  if (!is_program) return words.front() + ": one argument too many";
  return words.front() + ": unknown subcommand" + did_you_mean(words.front(), commands_of(command));
}

}  // namespace

std::string explain(const CLI::App& program, const CLI::ParseError& error) {
  std::optional<std::string> what = unknown_word(program);
  std::string see = "mwmesh --help";
  for (const CLI::App* command : program.get_subcommands()) {
    see = "mwmesh " + command->get_name() + " --help";
    if (const auto unknown = unknown_word(*command)) what = unknown;
  }
  return what.value_or(error.what()) + "; see " + see;
}

}  // namespace mw::cli
