// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers from whole texts, also where the standard library reads no reals (libc++ before 20).
#pragma once

#include <charconv>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace mw::io {

/// Reads all of the text as std::from_chars() does; false when it is none or does not fit.  It is
/// what read_number() does where the library has no such function.
[[nodiscard]] bool read_real_by_c(std::string_view text, double& value);

/// Reads all of the text, a decimal number without '+', as a T; false when it is none or does not
/// fit.
template <class T>
[[nodiscard]] bool read_number(std::string_view text, T& value) {
#ifndef __cpp_lib_to_chars
  static_assert(std::is_integral_v<T> || std::is_same_v<T, double>);
  if constexpr (std::is_floating_point_v<T>)
    return read_real_by_c(text, value);
  else
#endif
  {
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stop == end && !text.empty();
  }
}

}  // namespace mw::io
