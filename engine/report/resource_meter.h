// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Time and memory of this process.
#pragma once

#include <chrono>
#include <cstdint>

namespace mw::report {

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

}  // namespace mw::report
