// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads files of /proc, and sets options of the allocator.
#include "engine/system/memory.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "engine/system/control_groups.h"

namespace mw::engine {
namespace {

constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

}  // namespace

std::optional<std::uint64_t> proc_bytes(std::istream& file, std::string_view name) {
  for (std::string line; std::getline(file, line);) {
    const bool found = line.starts_with(name) && line.substr(name.size()).starts_with(':');
    if (found) return std::stoull(line.substr(name.size() + 1)) * 1024;
  }
  return std::nullopt;
}

std::uint64_t default_memory_budget() {
  std::ifstream meminfo("/proc/meminfo");
  std::ifstream groups("/proc/self/cgroup");
  const auto machine = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                       static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  const std::uint64_t available = proc_bytes(meminfo, "MemAvailable").value_or(kNone);
  return std::min({machine, available, cgroup_limit("/sys/fs/cgroup", groups)}) / 2;
}

std::uint64_t resident_bytes() {
  std::uint64_t size = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void return_free_memory_above(std::uint64_t max) {
  if (resident_bytes() > max) ::malloc_trim(0);
}

void return_large_pieces_at_once() {
  (void)::mallopt(M_MMAP_THRESHOLD, 512 << 10);
  (void)::mallopt(M_TRIM_THRESHOLD, 1 << 20);
}

void save_address_space() {
  constexpr int kMaxPools = 2;
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  (void)::mallopt(M_ARENA_MAX, kMaxPools);
}

}  // namespace mw::engine
