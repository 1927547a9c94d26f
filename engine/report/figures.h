// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in words for people.
#pragma once

#include <cstdint>
#include <string>

#include "kernels/core/label.h"

namespace mw::report {

[[nodiscard]] std::string format_label(RawLabel label, bool is_signed);
/// "12.3 MiB".
[[nodiscard]] std::string format_bytes(std::uint64_t bytes);
/// With the given number of digits after the point.
[[nodiscard]] std::string format_fixed(double value, int digits);

}  // namespace mw::report
