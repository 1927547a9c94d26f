// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How this library words its errors: file, field, reason, way out.
#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <filesystem>
#include <string>
#include <string_view>

#include "kernels/core/error.h"

namespace mw::io {

inline void append_piece(std::string& out, std::string_view piece) {
  out.append(piece);
}
inline void append_piece(std::string& out, char letter) {
  out.push_back(letter);
}
template <std::integral T>
void append_piece(std::string& out, T number) {
  out.append(std::to_string(number));
}
/// Appends the shortest text that reads back as the same number.
inline void append_piece(std::string& out, double number) {
  std::array<char, 32> text{};
  out.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr);
}

/// Returns the pieces (strings and numbers) joined one after the other.
template <class... Pieces>
[[nodiscard]] std::string text(const Pieces&... pieces) {
  std::string out;
  (append_piece(out, pieces), ...);
  return out;
}

/// Throws mw::Error(kUsage) with the pieces as text().
template <class... Pieces>
[[noreturn]] void fail_usage(const Pieces&... pieces) {
  throw Error(ErrorKind::kUsage, text(pieces...));
}

/// Throws mw::Error(kInput): "FILE: FIELD: REASON; WAY_OUT".  FIELD and WAY_OUT may be empty.
[[noreturn]] void fail_input(std::string_view file, std::string_view field, std::string_view reason,
                             std::string_view way_out = {});

/// Throws for a failed system call on an output: kResource when the disk is full or broken, kUsage
/// when the path cannot be written (permissions, missing folder).
[[noreturn]] void fail_output(std::string_view path, std::string_view action, int error_number);

/// Returns an error that names the path: of kInput where the path is to blame (missing, too long, a
/// loop of links, not permitted), else of kResource.
[[nodiscard]] Error file_failure(const std::filesystem::filesystem_error& failure);

}  // namespace mw::io
