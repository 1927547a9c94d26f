// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is said of a command line that cannot be read.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace mw::cli {

/// A word that nothing is known of comes first, with the flag or subcommand that was probably
/// meant: it is often why something else is missing.  Else what CLI11 says.
/// REQUIRES: program.parse() threw the error.
[[nodiscard]] std::string explain(const CLI::App& program, const CLI::ParseError& error);

}  // namespace mw::cli
