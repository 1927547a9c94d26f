// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sums up the memory that the parts of the merge hold.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

namespace mw::engine {

/// Is told how many bytes are held, before they grow beyond what it was last told; may throw.
using HoldMemory = std::function<void(std::uint64_t bytes)>;

/// Tells a memory budget in steps how much is held, so that it is not asked for each block.
class Remembered {
 public:
  /// Entries of VertexRows, and a second list while one is merged.
  static constexpr std::uint64_t kBytesPerRow = 32;

  explicit Remembered(HoldMemory hold) : hold_(std::move(hold)) {}

  /// These three are called before a part of what is held grows to `bytes`; here rows of vertices.
  void rows(std::uint64_t bytes) {
    rows_ = bytes;
    tell();
  }
  void shape(std::uint64_t bytes) {
    shape_ = bytes;
    tell();
  }
  /// What CellValues hold for a block.
  void values(std::uint64_t bytes) {
    values_ = bytes;
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
    const std::uint64_t sum = rows_ + shape_ + shared_ + values_;
    if (!hold_ || sum <= held_) return;
    held_ = sum + std::min(sum / 8 + kMinStepBytes, kMaxStepBytes);
    hold_(held_);
  }

  HoldMemory hold_;
  std::uint64_t rows_ = 0;
  std::uint64_t shape_ = 0;
  std::uint64_t shared_ = 0;
  std::uint64_t values_ = 0;
  std::uint64_t held_ = 0;
};

}  // namespace mw::engine
