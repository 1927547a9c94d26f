// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Fill values, exact for all integers.
#include "io/volume/zarr/fill_value.h"

#include <bit>
#include <charconv>
#include <cmath>

#include "io/file/errors.h"

namespace mw::io {
namespace {

[[noreturn]] void fail_fill(const Json& value, VoxelType type, std::string_view file) {
  const std::string shown =
      value.is_structured() ? "a structure" : value.dump_ascii().substr(0, 60);
  fail_input(file, "fill_value", text(shown, " is no ", name(type)), "the file is damaged");
}

std::optional<RawLabel> label_of(double value) {
  if (!(value >= -0x1p63 && value < 0x1p63) || value != std::floor(value)) return std::nullopt;
  return static_cast<RawLabel>(static_cast<std::int64_t>(value));
}

/// The float whose bits the text has; "0x7fc00000" is the usual NaN.
std::optional<double> float_of_bits(std::string_view digits, VoxelType type) {
  if (digits.substr(0, 2) != "0x") return std::nullopt;
  digits.remove_prefix(2);
  std::uint64_t bits = 0;
  const char* end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, bits, 16);
  if (read.ec != std::errc{} || read.ptr != end) return std::nullopt;
  if (type == VoxelType::kF64) return std::bit_cast<double>(bits);
  if (bits > UINT32_MAX) return std::nullopt;
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
}

std::optional<RawLabel> parse_float(const Json& value, VoxelType type, std::string_view file) {
  if (value.is_number()) return label_of(value.number());
  if (!value.is_string()) fail_fill(value, type, file);
  const std::string& word = value.text();
  if (word == "NaN" || word == "Infinity" || word == "-Infinity") return std::nullopt;
  const auto number = float_of_bits(word, type);
  if (!number) fail_fill(value, type, file);
  return label_of(*number);
}

bool holds_signed(VoxelType type, std::int64_t number) {
  const std::int64_t max = INT64_MAX >> (64 - 8 * byte_size(type));
  return number >= -max - 1 && number <= max;
}

bool holds_unsigned(VoxelType type, std::uint64_t number) {
  return number <= UINT64_MAX >> (64 - 8 * byte_size(type));
}

RawLabel parse_integer(const Json& value, VoxelType type, std::string_view file) {
  if (value.is_boolean()) return value.boolean() ? 1 : 0;
  if (value.is_unsigned()) {
    const std::uint64_t number = value.integer();
    const bool fits = is_signed(type) ? number <= static_cast<std::uint64_t>(INT64_MAX) &&
                                            holds_signed(type, static_cast<std::int64_t>(number))
                                      : holds_unsigned(type, number);
    if (fits) return number;
  } else if (value.is_number()) {  // negative, or written as 0.0
    const auto label = value.is_float() ? label_of(value.number()) : std::optional(value.integer());
    if (label) {
      const auto number = static_cast<std::int64_t>(*label);
      if (is_signed(type) ? holds_signed(type, number)
                          : number >= 0 && holds_unsigned(type, *label)) {
        return *label;
      }
    }
  }
  fail_fill(value, type, file);
}

}  // namespace

std::optional<RawLabel> parse_fill_value(const Json& value, VoxelType type, std::string_view file) {
  if (value.is_null()) return 0;
  if (is_float(type)) return parse_float(value, type, file);
  return parse_integer(value, type, file);
}

}  // namespace mw::io
