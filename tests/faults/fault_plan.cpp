// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which system call fails, and the record of all of them: what the environment asks for.
#include "tests/faults/fault_plan.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <new>

namespace mw::faults {
namespace {

// System calls by number where the functions of these names are those that are being replaced.

std::string text_of(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

struct Plan {
  std::string folder = text_of("FAULT_FOLDER");
  std::uint64_t at = std::strtoull(text_of("FAULT_AT").c_str(), nullptr, 10);
  std::string how = text_of("FAULT_HOW");
  int log = -1;

  Plan() {
    const std::string path = text_of("FAULT_LOG");
    if (path.empty()) return;
    log = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path.c_str(),
                                     O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  }
};

const Plan& plan() {
  static const Plan only;
  return only;
}

/// In one piece, since a child of the process has the same log.
void append(const std::string& bytes) {
  const long wrote = ::syscall(SYS_write, plan().log, bytes.data(), bytes.size());
  if (wrote != static_cast<long>(bytes.size()))
    std::abort();  // a log with a hole would be believed
}

/// Calls so far, of this process and its children.
std::atomic<std::uint64_t>& calls() {
  static void* const shared = ::mmap(nullptr, sizeof(std::atomic<std::uint64_t>),
                                     PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  static auto* const counter = new (shared) std::atomic<std::uint64_t>(0);
  return *counter;
}

bool takes_space(std::string_view call) {
  return call == "write" || call == "pwrite" || call == "fallocate" || call == "mkostemp";
}

Fault fault_of(std::string_view call, std::uint64_t number) {
  const std::uint64_t at = plan().at;
  const std::string& how = plan().how;
  if (at == 0 || number < at) return {};
  if (how == "full") return {.error = takes_space(call) ? ENOSPC : 0};
  if (how == "gone") return {.error = EIO};
  if (number > at) return {};
  if (how == "kill") ::kill(::getpid(), SIGKILL);
  if (how == "short") return {.is_short = true};
  return {.error = std::atoi(how.c_str())};
}

}  // namespace

bool is_watched(const std::string& path) {
  const std::string& folder = plan().folder;
  return !folder.empty() && path.starts_with(folder) &&
         (path.size() == folder.size() || path[folder.size()] == '/');
}

std::string path_of(int file) {
  const int before = errno;
  std::array<char, PATH_MAX> path{};
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t size = ::readlink(link.c_str(), path.data(), path.size());
  errno = before;
  return {path.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
}

std::string absolute(const char* path) {
  if (path[0] == '/') return path;
  std::array<char, PATH_MAX> here{};
  const int before = errno;
  const bool found = ::getcwd(here.data(), here.size()) != nullptr;
  errno = before;
  return found ? std::string(here.data()) + "/" + path : path;
}

Fault next_fault(std::string_view call, const std::string& path) {
  if (!is_watched(path)) return {};
  const std::uint64_t number = ++calls();
  if (plan().log >= 0) {
    append("call\t" + std::to_string(number) + "\t" + std::string(call) + "\t" + path + "\n");
  }
  return fault_of(call, number);
}

void record(const Event& event) {
  if (plan().log < 0 || !is_watched(event.path)) return;
  const int before = errno;
  std::string bytes = std::string(event.name) + "\t" + event.path + "\t" +
                      std::to_string(event.offset) + "\t" + std::to_string(event.size) + "\t" +
                      event.other + "\n";
  if (event.data != nullptr) {
    bytes.append(static_cast<const char*>(event.data), event.size);
    bytes += '\n';
  }
  append(bytes);
  errno = before;
}

}  // namespace mw::faults
