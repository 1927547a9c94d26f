// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How far a run is, on stderr.
#pragma once

#include <chrono>
#include <string>

#include "engine/run/run.h"

namespace mw::cli {

enum class ProgressKind { kNone, kBar, kJsonLines };

/// "auto" (a bar when stderr is a terminal), "none", "jsonl".
[[nodiscard]] ProgressKind parse_progress(const std::string& text);

/// Shows the first and the last window and at most a few lines a second between and afterwards.
class Progress {
 public:
  explicit Progress(ProgressKind kind) : kind_(kind) {}
  ~Progress();  ///< ends the line of a bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void show(const engine::RunProgress& at);

 private:
  using Clock = std::chrono::steady_clock;

  ProgressKind kind_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_;
  std::uint64_t done_ = 0;  ///< windows that were shown
};

}  // namespace mw::cli
