// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bytes one after the other from base64 text.
#include "io/vtk_xml/byte_stream.h"

#include "io/file/errors.h"

namespace mw::io {
namespace {

constexpr std::array<std::int8_t, 256> make_values() {
  std::array<std::int8_t, 256> values{};
  for (std::int8_t& value : values) value = -1;
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kDigits.size(); ++i) {
    values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
  }
  return values;
}
constexpr std::array<std::int8_t, 256> kValues = make_values();

}  // namespace

void Base64Stream::decode_group() {
  std::uint32_t bits = 0;
  std::size_t digits = 0;
  std::size_t padding = 0;
  while (digits + padding < 4) {
    if (at_ == text_.size()) fail_input(file_, "base64 data", "truncated");
    const char c = text_[at_++];
    if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
    const std::int8_t value = kValues[static_cast<unsigned char>(c)];
    if (c == '=' && digits >= 2) {
      ++padding;
    } else if (value < 0 || padding > 0) {
      fail_input(file_, "base64 data", text("invalid character at position ", at_ - 1));
    } else {
      bits |= static_cast<std::uint32_t>(value) << (18 - 6 * digits++);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    group_[i] = static_cast<std::byte>((bits >> (16 - 8 * i)) & 255U);
  }
  ready_ = digits - 1;
  used_ = 0;
}

void Base64Stream::read(std::span<std::byte> out) {
  for (std::byte& byte : out) {
    if (ready_ == 0) decode_group();
    byte = group_[used_++];
    --ready_;
  }
}

}  // namespace mw::io
