// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks LZF.
#include "io/codec/codec.h"
#include "io/codec/stream.h"

namespace mw::io {
namespace {

/// A first byte below this is the length of a run less 1.  Otherwise its upper 3 bits are the
/// length of a copy less 2 (if they are 7, another byte adds to it), and its lower 5 bits with the
/// next byte are the distance less 1.
constexpr std::size_t kFirstCopy = 32;
constexpr std::size_t kLongCopy = 7;

}  // namespace

std::vector<std::byte> unpack_lzf(std::span<const std::byte> packed, std::size_t max,
                                  std::string_view name) {
  const PackedName named{"lzf", name};
  std::vector<std::byte> out;
  std::size_t at = 0;
  const auto next = [&] {
    if (at == packed.size()) fail_packed(named, "truncated");
    return std::to_integer<std::size_t>(packed[at++]);
  };
  while (at < packed.size()) {
    const std::size_t first = next();
    const bool is_run = first < kFirstCopy;
    std::size_t length = is_run ? first + 1 : (first >> 5U) + 2;
    if (!is_run && first >> 5U == kLongCopy) length += next();
    const std::size_t distance = is_run ? 0 : ((first & 31U) << 8U) + next() + 1;
    if (is_run && length > packed.size() - at) fail_packed(named, "truncated");
    if (distance > out.size()) fail_packed(named, "damaged: a copy begins before the data");
    if (length > max - out.size()) fail_too_much(named, max);
    // It goes byte by byte, since a copy may overlap itself.
    for (; length > 0; --length) out.push_back(is_run ? packed[at++] : out[out.size() - distance]);
  }
  return out;
}

}  // namespace mw::io
