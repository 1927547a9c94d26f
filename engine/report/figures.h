// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in words for people.
#pragma once

#include <cstdint>
#include <string>

namespace mw::report {

/// Returns a size as "12.3 MiB".
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

}  // namespace mw::report
