// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The flow of blocks between a run's windows, as tables.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/store/run_layout.h"

namespace mw::bench {

/// BlockRoute asked once for every block that every window leaves: simulations ask again and again.
/// Windows have numbers in the order in which one thread would visit them, march by march.
/// Memory: some 40 bytes a window.
class RunFlow {
 public:
  static constexpr std::uint32_t kOutput = ~std::uint32_t{0};

  /// REQUIRES: fewer windows than kOutput.
  explicit RunFlow(engine::RunLayout layout);

  [[nodiscard]] const engine::RunLayout& layout() const { return layout_; }
  [[nodiscard]] std::uint32_t windows() const { return first_.back(); }
  /// The first window of a march; with march == marches(): windows().
  [[nodiscard]] std::uint32_t first(std::uint32_t march) const { return first_[march]; }
  [[nodiscard]] std::uint32_t march_of(std::uint32_t window) const;
  [[nodiscard]] engine::WindowKey key(std::uint32_t window) const;

  /// Who needs each of the window's blocks next; kOutput: nobody.
  [[nodiscard]] std::span<const std::uint32_t> next_users(std::uint32_t window) const;
  /// How many blocks, or parts of blocks, it has to wait for.
  [[nodiscard]] std::uint32_t inputs(std::uint32_t window) const { return inputs_[window]; }
  /// How many of these another window of its march has left.
  [[nodiscard]] std::uint32_t seen(std::uint32_t window) const { return seen_[window]; }
  /// Eighths of it that no window of its march has seen before.
  [[nodiscard]] int fresh_eighths(std::uint32_t window) const;

 private:
  void add_march(std::uint32_t march);

  engine::RunLayout layout_;
  std::vector<std::uint32_t> first_{0};
  std::vector<std::uint32_t> blocks_;             ///< of a window, by march
  std::vector<std::vector<std::uint32_t>> next_;  ///< by march
  std::vector<std::uint32_t> inputs_;
  std::vector<std::uint8_t> seen_;
};

}  // namespace mw::bench
