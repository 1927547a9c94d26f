// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How errors say which memory budget would have been enough.
#pragma once

#include "io/file/errors.h"

namespace mw::io {

/// "97MiB", rounded up: a value for --memory.
[[nodiscard]] inline std::string mebibytes(std::uint64_t bytes) {
  constexpr std::uint64_t kMebibyte = 1 << 20;
  return text(bytes / kMebibyte + (bytes % kMebibyte != 0 ? 1 : 0), "MiB");
}

/// "the least that works is --memory 97MiB".
[[nodiscard]] inline std::string min_memory(std::uint64_t bytes) {
  return "the least that works is --memory " + mebibytes(bytes);
}

}  // namespace mw::io
