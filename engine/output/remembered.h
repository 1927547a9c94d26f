// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sums up the memory that the parts of the merge hold.
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

  /// Each of these is called before its part of what is held grows to `bytes`: rows of vertices.
  void rows(std::uint64_t bytes) {
    rows_ = bytes;
    tell();
  }
  /// The lists that several processes send one another.
  void shared(std::uint64_t bytes) {
    shared_ = bytes;
    tell();
  }

 private:
  static constexpr std::uint64_t kMinStepBytes = 1 << 16;
  static constexpr std::uint64_t kMaxStepBytes = 1 << 20;

  void tell() {
    const std::uint64_t sum = rows_ + shared_;
    if (!hold_ || sum <= held_) return;
    held_ = sum + std::min(sum / 8 + kMinStepBytes, kMaxStepBytes);
    hold_(held_);
  }

  HoldMemory hold_;
  std::uint64_t rows_ = 0;
  std::uint64_t shared_ = 0;
  std::uint64_t held_ = 0;
};

}  // namespace mw::engine
