// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads files of /proc and of control groups, and sets options of the allocator.
#include "engine/system/memory.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace mw::engine {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLimitFile = "memory.max";
constexpr const char* kLimitFileOfVersion1 = "memory.limit_in_bytes";
constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

/// Returns the number in a file, or kNone if there is no file or it says "max".
std::uint64_t limit_in(const fs::path& path) {
  std::uint64_t bytes = kNone;
  return std::ifstream(path) >> bytes ? bytes : kNone;
}

/// Returns the least limit of the groups on the path `below` a group.
std::uint64_t min_of_path(fs::path group, const fs::path& below, const char* file) {
  std::uint64_t min = kNone;
  for (const fs::path& part : below) {
    group /= part;
    min = std::min(min, limit_in(group / file));
  }
  return min;
}

}  // namespace

std::optional<std::uint64_t> proc_bytes(std::istream& file, std::string_view name) {
  for (std::string line; std::getline(file, line);) {
    const bool found = line.starts_with(name) && line.substr(name.size()).starts_with(':');
    if (found) return std::stoull(line.substr(name.size() + 1)) * 1024;
  }
  return std::nullopt;
}

std::uint64_t cgroup_limit(const fs::path& root, std::istream& own_groups) {
  const fs::path version_1 = root / "memory";
  std::uint64_t min =
      std::min(limit_in(root / kLimitFile), limit_in(version_1 / kLimitFileOfVersion1));
  for (std::string line; std::getline(own_groups, line);) {
    const std::size_t at = line.find(":/");
    if (at == line.npos) continue;
    const std::string controllers = line.substr(0, at), path = line.substr(at + 2);
    if (controllers == "0:") min = std::min(min, min_of_path(root, path, kLimitFile));
    if (controllers.ends_with(":memory")) {
      min = std::min(min, min_of_path(version_1, path, kLimitFileOfVersion1));
    }
  }
  return min;
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
