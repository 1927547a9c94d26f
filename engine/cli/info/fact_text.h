// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facts, known as JSON, in lines of text.
#pragma once

#include <string>

#include "io/json/json.h"

namespace mw::cli {

/// Prints a line for each fact, and for each object of a list, on stdout; facts of an object are
/// named "object.fact".
void print_facts(const io::Json& facts, const std::string& prefix = {});

/// Prints one line with the name and the row as "label 3, volume 12.5".
void print_row(std::string name, const io::Json& row);

}  // namespace mw::cli
