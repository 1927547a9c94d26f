// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the search for specks takes, counted also when it is too much.
#pragma once

#include <algorithm>
#include <cstdint>

#include "io/labels/speck_contacts.h"

namespace mw::io {

/// Runs wait in a list and end in a vector, which is larger than what it holds while it grows.
inline constexpr std::uint64_t kBytesPerSpeckRun = 2 * sizeof(SpeckRun);
inline constexpr std::uint64_t kBytesPerSpeckContact = 2 * sizeof(SpeckContact);

/// How many contacts are listed before sums are made of those that are the same: an eighth must
/// come of it, or they would be made for each.
[[nodiscard]] constexpr std::uint64_t contacts_that_fit(std::uint64_t listed) {
  return listed - listed / 8;
}

/// Counts of one search.
struct SpeckMemory {
  std::uint64_t runs = 0;      ///< of specks, and of components that may become some
  std::uint64_t max_runs = 0;  ///< at any time
  std::uint64_t planes = 0;    ///< bytes of two planes, the most at any time
  std::uint64_t contacts = 0;  ///< of specks; at least as many as there are
  std::uint64_t specks = 0;
  std::uint64_t large = 0;  ///< components, or parts of them, that are none

  void add_run() { max_runs = std::max(max_runs, ++runs); }
  /// Limits under which nothing is too much.
  [[nodiscard]] std::uint64_t enough() const {
    // Few specks that touch many times have few contacts.
    const std::uint64_t others = specks + large;
    const std::uint64_t max = specks < (1U << 20) ? specks * others : contacts;
    const std::uint64_t different = std::min(contacts, max);
    const std::uint64_t listed = different + different / 7 + 8;
    return std::max(planes, max_runs * kBytesPerSpeckRun + listed * kBytesPerSpeckContact);
  }
};

}  // namespace mw::io
