// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How far a run is, on stderr.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace mw::cli {

enum class ProgressKind { kNone, kBar, kJsonLines };

/// "auto" (a bar when stderr is a terminal), "none", "jsonl".
[[nodiscard]] ProgressKind parse_progress(const std::string& text);

/// Shows the first and the last window and at most a few a second between.
class Progress {
 public:
  explicit Progress(ProgressKind kind) : kind_(kind) {}
  void show(std::uint64_t done, std::uint64_t total);

 private:
  using Clock = std::chrono::steady_clock;

  void show_bar(std::uint64_t done, std::uint64_t total, double seconds) const;
  static void show_line(std::uint64_t done, std::uint64_t total, double seconds);

  ProgressKind kind_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_;
};

}  // namespace mw::cli
