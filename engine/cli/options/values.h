// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Converts values of options from text and back.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/report/figures.h"
#include "engine/settings/number_text.h"
#include "io/mesh/element.h"
#include "io/mesh/mesh_extras.h"
#include "kernels/core/index.h"
#include "kernels/core/label.h"

namespace mw::cli {

using engine::format_number;
using engine::parse_bytes;
using engine::parse_integer;
using engine::parse_label;
using engine::parse_number;
using engine::parse_switch;
using io::parse_element;
using report::format_bytes;
using report::format_figure;
using report::format_fixed;
using report::format_label;
using report::format_volume;

/// All of these take the whole text.  ERRORS: mw::Error(kUsage) saying what was expected.
[[nodiscard]] std::array<double, 3> parse_numbers(std::string_view text);  ///< "X,Y,Z", or one
[[nodiscard]] Index3 parse_shape(std::string_view text);                   ///< "X,Y,Z", each >= 1
[[nodiscard]] Box3 parse_box(std::string_view text);  ///< "X0,Y0,Z0,X1,Y1,Z1", half-open
[[nodiscard]] std::vector<RawLabel> parse_labels(std::string_view text);  ///< "1,2,5"

/// Reads the switch --ascii.
[[nodiscard]] inline io::Encoding parse_ascii(std::string_view text) {
  return parse_switch(text) ? io::Encoding::kText : io::Encoding::kUsual;
}

/// Reads --deck: "none" or "static".
[[nodiscard]] inline bool parse_deck(std::string_view text) {
  return text == "static";
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

}  // namespace mw::cli
