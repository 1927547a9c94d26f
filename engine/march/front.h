// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The bookkeeping of a march: which windows are ready.
#pragma once

#include <cstdint>
#include <optional>

namespace mw::engine {

/// Windows by their rank in the march's order.  Thread safety: none.
class Front {
 public:
  virtual ~Front() = default;

  /// The ready window with the longest path to go, of equals the first in sequence.
  [[nodiscard]] virtual std::optional<std::uint64_t> best() const = 0;
  /// The first unfinished of its windows in sequence; the order's size() at the end.
  [[nodiscard]] virtual std::uint64_t first_unfinished() const = 0;
  [[nodiscard]] virtual bool is_ready(std::uint64_t rank) const = 0;
  /// REQUIRES: ready.
  virtual void start(std::uint64_t rank) = 0;
  /// REQUIRES: started, not finished.
  virtual void finish(std::uint64_t rank) = 0;
};

}  // namespace mw::engine
