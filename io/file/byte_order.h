// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers from bytes of either byte order.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace mw::io {

enum class ByteOrder { kLittle, kBig };

inline constexpr ByteOrder kHostOrder =
    std::endian::native == std::endian::little ? ByteOrder::kLittle : ByteOrder::kBig;

template <std::unsigned_integral T>
[[nodiscard]] constexpr T swap_bytes(T value) {
  if constexpr (sizeof(T) == 2) return __builtin_bswap16(value);
  if constexpr (sizeof(T) == 4) return __builtin_bswap32(value);
  if constexpr (sizeof(T) == 8) return __builtin_bswap64(value);
  return value;
}

/// Returns the number of type T (integer or floating point) whose bytes begin at `bytes`.
template <class T>
[[nodiscard]] T load(const std::byte* bytes, ByteOrder order) {
  using Bits = std::conditional_t<
      sizeof(T) == 1, std::uint8_t,
      std::conditional_t<sizeof(T) == 2, std::uint16_t,
                         std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;
  Bits bits;
  std::memcpy(&bits, bytes, sizeof bits);
  if (order != kHostOrder) bits = swap_bytes(bits);
  return std::bit_cast<T>(bits);
}

/// Writes `value` at `bytes`, least significant byte first.
template <class T>
void store_little(T value, std::byte* bytes) {
  std::memcpy(bytes, &value, sizeof value);
  if constexpr (kHostOrder == ByteOrder::kBig) {
    for (std::size_t i = 0; i < sizeof value / 2; ++i) {
      const std::byte kept = bytes[i];
      bytes[i] = bytes[sizeof value - 1 - i];
      bytes[sizeof value - 1 - i] = kept;
    }
  }
}

/// Appends a number to a file or text, least significant byte first.
template <class Out, class T>
void append_little(Out& out, T value) {
  std::array<std::byte, sizeof value> bytes;
  store_little(value, bytes.data());
  out.append(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace mw::io
