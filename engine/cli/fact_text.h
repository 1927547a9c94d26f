// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Facts, known as JSON, in lines of text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace mw::cli {

/// One line a fact on stdout, and one for each object of a list; those of an object are named
/// "object.fact".
void print_facts(const nlohmann::ordered_json& facts, const std::string& prefix = {});

/// One line: the name, and the row as "label 3, volume 12.5".
void print_row(std::string name, const nlohmann::ordered_json& row);

}  // namespace mw::cli
