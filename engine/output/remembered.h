// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The memory that the merge holds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

namespace mw::engine {

/// Called with the number of bytes held, before it grows beyond that of the last call; may throw.
using HoldMemory = std::function<void(std::uint64_t bytes)>;

/// Tells a memory budget how much is held, in steps, so that it is not asked for every block.
class Remembered {
 public:
  /// An entry of VertexRows, twice, because lists are copied when they are merged.
  static constexpr std::uint64_t kBytesPerRow = 32;

  explicit Remembered(HoldMemory hold) : hold_(std::move(hold)) {}

  /// To be called before what is held grows to `bytes`.
  void grow(std::uint64_t bytes) {
    if (!hold_ || bytes <= held_) return;
    held_ = bytes + std::min(bytes / 8 + kMinStepBytes, kMaxStepBytes);
    hold_(held_);
  }

 private:
  static constexpr std::uint64_t kMinStepBytes = 1 << 16;
  static constexpr std::uint64_t kMaxStepBytes = 1 << 20;

  HoldMemory hold_;
  std::uint64_t held_ = 0;
};

}  // namespace mw::engine
