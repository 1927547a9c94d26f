// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in binary formats: how they are written, and how large they may be.
#pragma once

#include <cstdint>
#include <string_view>

#include "io/file/atomic_file.h"
#include "io/file/byte_order.h"

namespace mw::io {

/// At the end of the file, least significant byte first.
template <class T>
void append_little(AtomicFile& file, T value) {
  std::array<std::byte, sizeof value> bytes;
  store_little(value, bytes.data());
  file.append(bytes);
}

/// ERRORS: mw::Error(kUsage) when there are more than `max` of `what`, which is all that a format
/// with numbers of 32 bits can hold.
void check_max(std::string_view file, std::string_view what, std::uint64_t count,
               std::uint64_t max);

}  // namespace mw::io
