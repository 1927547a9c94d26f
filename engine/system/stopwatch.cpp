// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Time and memory of this process.
#include "engine/system/stopwatch.h"

#include <sys/resource.h>

#include <fstream>

#include "engine/system/memory.h"

namespace mw::engine {
namespace {

/// Returns what RUSAGE_SELF or RUSAGE_CHILDREN used: children that ended and were waited for.
rusage usage(int who) {
  rusage out{};
  getrusage(who, &out);
  return out;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

/// Returns the kernel's high-water mark of this program's resident memory.  That of getrusage would
/// begin with the one of the program that started this one.
std::uint64_t high_water_bytes() {
  std::ifstream status("/proc/self/status");
  const auto bytes = proc_bytes(status, "VmHWM");
  return bytes ? *bytes : static_cast<std::uint64_t>(usage(RUSAGE_SELF).ru_maxrss) * 1024;
}

}  // namespace

double ResourceMeter::process_cpu_seconds() {
  double sum = 0.0;
  for (int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    const rusage used = usage(who);
    sum += seconds(used.ru_utime) + seconds(used.ru_stime);
  }
  return sum;
}

Resources ResourceMeter::read() const {
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start_;
  return {.wall_seconds = wall.count(),
          .cpu_seconds = process_cpu_seconds() - start_cpu_,
          .peak_rss_bytes = high_water_bytes()};
}

}  // namespace mw::engine
