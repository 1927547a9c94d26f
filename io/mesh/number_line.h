// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One line of numbers of a text file.
#pragma once

#include <array>
#include <charconv>
#include <string_view>

namespace mw::io {

/// Reals are written with the fewest digits that give back the same double.  A line has room for a
/// dozen of the longest numbers.
class NumberLine {
 public:
  explicit NumberLine(char separator = ' ') : separator_(separator) {}

  template <class T>
  void add(T number) {
    end_ = std::to_chars(end_, chars_.data() + chars_.size(), number).ptr;
    *end_++ = separator_;
  }
  /// Returns the numbers, with `last` for the last separator.  REQUIRES: there is a number.
  [[nodiscard]] std::string_view finish(char last = '\n') {
    end_[-1] = last;
    return {chars_.data(), static_cast<std::size_t>(end_ - chars_.data())};
  }
  /// Returns the numbers with nothing behind the last.  REQUIRES: there is a number.
  [[nodiscard]] std::string_view numbers() const {
    return {chars_.data(), static_cast<std::size_t>(end_ - chars_.data()) - 1};
  }

 private:
  char separator_;
  std::array<char, 320> chars_;
  char* end_ = chars_.data();
};

}  // namespace mw::io
