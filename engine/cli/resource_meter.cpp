// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Time and memory of this process.
#include "engine/cli/resource_meter.h"

#include <sys/resource.h>

namespace mw::cli {
namespace {

rusage usage() {
  rusage out{};
  getrusage(RUSAGE_SELF, &out);
  return out;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

}  // namespace

double ResourceMeter::process_cpu_seconds() {
  const rusage used = usage();
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

Resources ResourceMeter::read() const {
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start_;
  return {.wall_seconds = wall.count(),
          .cpu_seconds = process_cpu_seconds() - start_cpu_,
          .peak_rss_bytes = static_cast<std::uint64_t>(usage().ru_maxrss) * 1024};
}

}  // namespace mw::cli
