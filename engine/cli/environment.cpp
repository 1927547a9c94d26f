// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The variables MW_... of the environment.
#include "engine/cli/environment.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

#include "engine/cli/nearest.h"
#include "engine/codt/worker_pool.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

constexpr std::string_view kPrefix = "MW_";
constexpr std::string_view kTests = "MW_TEST_";
constexpr const char* kProgram = "MW_PROGRAM";

/// All that the program reads, in the order of the subcommands and their options.
std::vector<std::string> known_variables(const CLI::App& program) {
  std::vector<std::string> out;
  for (const CLI::App* command : program.get_subcommands({})) {
    for (const CLI::Option* option : command->get_options()) {
      if (!option->get_configurable()) continue;
      for (const std::string& name : option->get_lnames()) out.push_back(variable_of(name));
    }
  }
  out.emplace_back(engine::codt::kWorkerVariable);
  return out;
}

/// Names of the variables with our prefix that are not empty, sorted.
std::vector<std::string> set_variables() {
  std::vector<std::string> out;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    const std::size_t equals = std::min(text.find('='), text.size());
    if (!text.starts_with(kPrefix) || equals + 1 >= text.size()) continue;
    out.emplace_back(text.substr(0, equals));
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<std::string> without_prefix(const std::vector<std::string>& names) {
  std::vector<std::string> out;
  for (const std::string& name : names) out.push_back(name.substr(kPrefix.size()));
  return out;
}

}  // namespace

std::string variable_of(std::string_view option) {
  std::string name(kPrefix);
  for (const char c : option) {
    name += c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return name;
}

void refuse_unknown_variables(const CLI::App& program) {
  const std::vector<std::string> known = known_variables(program);
  for (const std::string& name : set_variables()) {
    if (name == kProgram || name.starts_with(kTests)) continue;
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string hint =
        did_you_mean(name.substr(kPrefix.size()), without_prefix(known), std::string(kPrefix));
    throw Error(ErrorKind::kUsage,
                name + ": no option has this environment variable" +
                    (hint.empty() ? "; unset it, or see mwmesh mesh --help" : hint));
  }
}

}  // namespace mw::cli
