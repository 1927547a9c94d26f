// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// /proc/self/statm and malloc_trim.
#include "engine/system/resident_memory.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace mw::engine {

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
