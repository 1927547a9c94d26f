// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Time and memory of this process, for reports; no result may depend on them.
#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>

namespace mw::engine {

class Stopwatch {
 public:
  /// Adds the time since the last call (or construction) to `seconds`.
  void lap(double& seconds) {
    const auto now = std::chrono::steady_clock::now();
    seconds += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  void restart() { last_ = std::chrono::steady_clock::now(); }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Returns the processor time of the calling thread, in seconds.
[[nodiscard]] inline double thread_cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Resources {
  double wall_seconds = 0;
  double cpu_seconds = 0;            ///< user and system; all threads, and workers that have ended
  std::uint64_t peak_rss_bytes = 0;  ///< VmHWM
};

class ResourceMeter {
 public:
  /// Returns time since construction, and peak memory since the start of the process.
  [[nodiscard]] Resources read() const;

 private:
  static double process_cpu_seconds();

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double start_cpu_ = process_cpu_seconds();
};

}  // namespace mw::engine
