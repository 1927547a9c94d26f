// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in the text of a table of names, and errors that name a line of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "kernels/core/label.h"

namespace mw::io {

/// A whole number from -2^63 to 2^64-1, two's complement; also with ".0" behind it, as tables of
/// floats have it.
[[nodiscard]] std::optional<RawLabel> label_of(std::string_view text);
/// Finite.
[[nodiscard]] std::optional<double> number_of(std::string_view text);
/// A whole number from 0 to 255.
[[nodiscard]] std::optional<std::uint8_t> byte_of(std::string_view text);
/// From 0 to 255, of a number from 0 to 1.
[[nodiscard]] std::optional<std::uint8_t> byte_of_share(double share);

/// ERRORS: mw::Error(kInput), always: "FILE: line LINE: REASON; ...".
[[noreturn]] void fail_line(std::string_view file, std::size_t line, std::string_view reason,
                            std::string_view way_out);

}  // namespace mw::io
