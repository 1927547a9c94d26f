// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The forms of an option's value: text, TOML, JSON.
#pragma once

#include <toml++/toml.h>
#include <optional>
#include <string>

#include "engine/cli/options/option_set.h"
#include "io/json/json.h"

namespace mw::cli {

/// Returns a text that is the same for equal values; labels and sizes stay as they are written.
/// ERRORS: mw::Error(kUsage) when the text is not of the kind.
[[nodiscard]] std::string canonical_text(ValueKind kind, const std::string& text);

/// Returns a config file's value as text, or nothing when its type is not that of the kind.
[[nodiscard]] std::optional<std::string> text_of_toml(ValueKind kind, const toml::node& node);

/// Returns what a config file holds for the kind, in words for messages: "an integer".
[[nodiscard]] const char* toml_type(ValueKind kind);

/// Returns whether a config file can hold the text: its strings are UTF-8.
[[nodiscard]] bool fits_in_toml(const std::string& text);

/// REQUIRES: canonical text that fits_in_toml().
[[nodiscard]] std::string toml_of_text(ValueKind kind, const std::string& text);
/// Returns the value as JSON, in which bytes that are no UTF-8 become U+FFFD.
[[nodiscard]] io::Json json_of_text(ValueKind kind, const std::string& text);

}  // namespace mw::cli
