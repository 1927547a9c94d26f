// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Converts values of options from text and back, and between their forms: text, TOML, JSON.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/request/option_set.h"
#include "engine/settings/number_text.h"
#include "io/json/json.h"
#include "io/mesh/element.h"
#include "io/mesh/mesh_extras.h"
#include "kernels/core/index.h"
#include "kernels/core/label.h"

namespace mw::request {

using engine::format_number;
using engine::parse_bytes;
using engine::parse_integer;
using engine::parse_label;
using engine::parse_number;
using engine::parse_switch;
using io::parse_element;

/// All of these take the whole text.  ERRORS: mw::Error(kUsage) saying what was expected.
[[nodiscard]] std::array<double, 3> parse_numbers(std::string_view text);  ///< "X,Y,Z", or one
[[nodiscard]] Index3 parse_shape(std::string_view text);                   ///< "X,Y,Z", each >= 1
[[nodiscard]] Box3 parse_box(std::string_view text);  ///< "X0,Y0,Z0,X1,Y1,Z1", half-open
[[nodiscard]] std::vector<RawLabel> parse_labels(std::string_view text);  ///< "1,2,5-9"

/// Reads the switch --ascii.
[[nodiscard]] inline io::Encoding parse_ascii(std::string_view text) {
  return parse_switch(text) ? io::Encoding::kText : io::Encoding::kUsual;
}

/// The values of --deck in the order of io::Deck.
inline const std::vector<std::string> kDecks{"none", "static", "periodic", "conduction"};

/// REQUIRES: one of kDecks.
[[nodiscard]] inline io::Deck parse_deck(std::string_view text) {
  return static_cast<io::Deck>(std::find(kDecks.begin(), kDecks.end(), text) - kDecks.begin());
}

/// Returns an Option::assign for a value that lives elsewhere and outlives the options.
template <class T, class Parse>
[[nodiscard]] auto into(T& target, Parse parse) {
  return [&target, parse](const std::string& text) { target = parse(text); };
}
[[nodiscard]] inline auto into(std::string& target) {
  return [&target](const std::string& text) { target = text; };
}
[[nodiscard]] inline auto into(std::filesystem::path& target) {
  return [&target](const std::string& text) { target = text; };
}
[[nodiscard]] inline auto into(bool& target) {
  return into(target, parse_switch);
}

/// Returns the row of a switch, which is off unless the row has another default.
[[nodiscard]] inline Option switch_of(bool& target, Option row) {
  row.kind = ValueKind::kSwitch;
  if (row.fallback.empty()) row.fallback = "false";
  row.assign = into(target);
  return row;
}

/// Returns the parser of an option whose choices are the texts that `parse` knows.
template <class T>
[[nodiscard]] auto chosen(std::optional<T> (*parse)(std::string_view)) {
  return [parse](const std::string& text) { return parse(text).value(); };
}

/// Returns the word that an option of the kind takes beside numbers: "auto" or "none".
[[nodiscard]] const char* word_of(ValueKind kind);

/// Returns what a kind is called in lists of options: "number_or_none".
[[nodiscard]] const char* name(ValueKind kind);
/// Returns what a config file holds for the kind, in words for messages: "an integer".
[[nodiscard]] const char* toml_words(ValueKind kind);

/// Returns a text that is the same for equal values; labels and sizes stay as they are written.
/// ERRORS: mw::Error(kUsage) when the text is not of the kind.
[[nodiscard]] std::string canonical_text(ValueKind kind, const std::string& text);

/// Returns whether a config file can hold the text: its strings are UTF-8.
[[nodiscard]] bool fits_in_toml(const std::string& text);

/// REQUIRES: canonical text that fits_in_toml().
[[nodiscard]] std::string toml_of_text(ValueKind kind, const std::string& text);
/// Returns the value as JSON, in which bytes that are no UTF-8 become U+FFFD.
[[nodiscard]] io::Json json_of_text(ValueKind kind, const std::string& text);

}  // namespace mw::request
