// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in words for people, and facts of a tree in lines.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/json/json.h"

namespace mw::report {

/// Returns a size as "12.3 MiB" or "11.0 GiB".
[[nodiscard]] std::string format_bytes(std::uint64_t bytes);
/// Returns four significant digits, as audit::number() does.
[[nodiscard]] std::string format_figure(double value);
/// Returns a volume in cubes of the unit, with the digits of format_figure(): "490 mm3", "17.18 mL"
/// from 1,000 mm3 on, and the number alone where the unit is not known.
[[nodiscard]] std::string format_volume(double volume, const std::string& unit);
/// Returns the value with this many digits after the point; a result of zeros alone has no sign.
[[nodiscard]] std::string format_fixed(double value, int digits);
/// Returns a share as "12.3 %", with this many digits after the point.
[[nodiscard]] std::string format_percent(double share, int digits);
/// Returns a number as "41,247".
[[nodiscard]] std::string with_commas(std::uint64_t number);
/// Returns "a, b and c" for `last` = " and ".
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view last);
/// Returns format_figure() with commas up to 1e15: "0.7381", "12.34", "1,040", "2e+18".
[[nodiscard]] std::string short_number(double value);

/// Returns the line with facts of the tree in the place of their names: "{output.tets} tets" is
/// "4660 tets".  Behind the name stands how a number is written: "{share:2%}" is "12.34 %",
/// "{angle:2}" has two digits after the point, "{area:g}" is format_figure(), "{cpu_s:n}" is
/// short_number(), "{tets:,}" has commas and "{peak:b}" is format_bytes().  A list is "3 x 4 x 5".
/// Returns nothing if one of the facts, or what should hold it, is null.
/// ERRORS: std::out_of_range for a name that the tree does not have.
[[nodiscard]] std::string told(std::string_view line, const io::Json& facts);

}  // namespace mw::report
