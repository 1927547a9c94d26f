// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The ways in which chunks of stores are packed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace mw::io {

enum class Codec {
  kNone,  ///< not packed
  kGzip,
  kZlib,
  kZstd,
  kBlosc,
  kLz4,      ///< numcodecs' framing
  kLz4Java,  ///< lz4-java's framing
  kBzip2,
  kXz,
};

[[nodiscard]] const char* name(Codec codec);

/// The bytes that `packed` unpacks to.  name: what errors call them, a file or a chunk in it.
/// Memory: in the order of `most`, whatever the packed bytes claim, see max_scratch().
/// Thread safety: any.
/// ERRORS: mw::Error(kInput) naming name and codec for damage, truncation and more than `most`
/// bytes; flips that the codec has no checksum against give other bytes, not an error.
[[nodiscard]] std::vector<std::byte> unpack(Codec codec, std::span<const std::byte> packed,
                                            std::size_t max, std::string_view name);

/// The most that unpack() takes in memory beside what it returns.
[[nodiscard]] std::uint64_t max_scratch(Codec codec, std::size_t max);

}  // namespace mw::io
