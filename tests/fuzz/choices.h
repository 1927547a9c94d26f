// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bytes as decisions: what a fuzzer changes is what is done.
#pragma once

#include <cstdint>

#include "tests/fuzz/target.h"

namespace mw::fuzz {

/// Takes bytes from the front; behind the end all are 0.
class Choices {
 public:
  explicit Choices(Bytes bytes) : rest_(bytes) {}

  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[nodiscard]] Bytes rest() const { return rest_; }

  std::uint32_t byte() {
    if (rest_.empty()) return 0;
    const auto first = static_cast<std::uint32_t>(rest_.front());
    rest_ = rest_.subspan(1);
    return first;
  }
  /// REQUIRES: count > 0.  Of two bytes where one is too few.
  std::uint32_t below(std::uint32_t count) {
    const std::uint32_t low = byte();
    return (count <= 256 ? low : low | byte() << 8U) % count;
  }

 private:
  Bytes rest_;
};

}  // namespace mw::fuzz
