// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pieces of text in the form that HTML, and JSON in HTML, need.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "io/json/json.h"

namespace mw::cli {

/// Escapes a string for text and for attributes in double quotes.
[[nodiscard]] std::string escaped(std::string_view text);

/// Returns JSON that may stand in a script element, whatever its strings hold.
[[nodiscard]] std::string script_json(const io::Json& value);

/// Returns a number as "41,247".
[[nodiscard]] std::string with_commas(std::uint64_t number);

/// Returns format_figure() with commas: "0.7381", "12.34", "1,040".
[[nodiscard]] std::string short_number(double value);

using AppendText = std::function<void(std::string_view)>;

/// Returns a size as "66.8 MiB" or "11.0 GiB".
[[nodiscard]] std::string size_text(std::uint64_t bytes);

/// Encodes bytes in base64 and passes them on as they come.  Memory: 4 KiB.
class Base64 {
 public:
  explicit Base64(AppendText append) : append_(std::move(append)) {}

  void add(std::span<const std::byte> bytes);
  /// Passes on the rest; called once, at the end.
  void finish();

 private:
  void encode(std::size_t count);

  AppendText append_;
  std::string text_;
  std::uint32_t bits_ = 0;
  std::size_t held_ = 0;  ///< bytes in bits_
};

}  // namespace mw::cli
