// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The variables MW_... of the environment.
#pragma once

#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace mw::cli {

/// The variable of an option: MW_EDGE_VARIANCE for edge-variance.
[[nodiscard]] std::string variable_of(std::string_view option);

/// A variable MW_... that no subcommand reads is a mistake, unless it is empty.  Those of tests and
/// benchmarks, which run the program with them set, are not: MW_PROGRAM and MW_TEST_...
/// REQUIRES: every subcommand has been added; of their options those are configurable, in CLI11's
///           words, that have a variable.
/// ERRORS: mw::Error(kUsage) naming the first variable in order and the nearest that there is.
void refuse_unknown_variables(const CLI::App& program);

}  // namespace mw::cli
