// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Work in a process of its own: fork, a pipe for the answer, limits.
#include "io/file/apart.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>

#include "io/file/errors.h"
#include "io/file/file_descriptor.h"

namespace mw::io {
namespace {

/// How the child ends.  The answer of kThrew is the kind of the error, one byte, and its message.
enum ChildExit : int { kAnswered = 0, kThrew = 10, kNoMemory = 11, kOther = 12 };

struct Pipe {
  FileDescriptor out;
  FileDescriptor in;
};

[[noreturn]] void fail_child(const char* action) {
  throw Error(ErrorKind::kResource, text("cannot ", action, " a process to read the file apart: ",
                                         std::strerror(errno), "; free memory or processes"));
}

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail_child("make a pipe to");
  return {FileDescriptor(ends[0]), FileDescriptor(ends[1])};
}

/// The address space of this process; 0 when the system does not tell.
std::uint64_t mapped_bytes() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void set_limit(decltype(RLIMIT_AS) what, std::uint64_t soft) {
  rlimit limit{};
  if (::getrlimit(what, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max == RLIM_INFINITY || soft < limit.rlim_max ? soft : limit.rlim_max;
  ::setrlimit(what, &limit);
}

/// A crash is expected here: it kills quietly, whatever this program or a tool does about signals.
void forget_signals() {
  for (const int signal :
       {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGINT, SIGPIPE, SIGSEGV, SIGTERM, SIGXCPU}) {
    ::signal(signal, SIG_DFL);
  }
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

void be_quiet() {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

void limit_child(const ApartLimits& limits) {
  const std::uint64_t mapped = mapped_bytes();
  if (mapped != 0) set_limit(RLIMIT_AS, mapped + limits.memory_bytes);
  set_limit(RLIMIT_CORE, 0);
  allow_cpu_seconds(limits.cpu_seconds);
}

bool write_all(int fd, const std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t done = ::write(fd, bytes.data() + at, bytes.size() - at);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    at += static_cast<std::size_t>(done);
  }
  return true;
}

ChildExit answer(int fd, const std::function<std::string()>& work) {
  try {
    return write_all(fd, work()) ? kAnswered : kOther;
  } catch (const Error& error) {
    const std::string kind(1, static_cast<char>(error.kind()));
    return write_all(fd, kind + error.what()) ? kThrew : kOther;
  } catch (const std::bad_alloc&) {
    return kNoMemory;
  } catch (...) {
    return kOther;
  }
}

/// What the child writes until it ends, or nothing when that is too much.
std::optional<std::string> read_answer(int fd, std::size_t most) {
  std::string all;
  std::array<char, 1 << 16> piece{};
  while (true) {
    const ssize_t done = ::read(fd, piece.data(), piece.size());
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return done == 0 ? std::optional(std::move(all)) : std::nullopt;
    if (all.size() + static_cast<std::size_t>(done) > most) return std::nullopt;
    all.append(piece.data(), static_cast<std::size_t>(done));
  }
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail_child("wait for");
  }
  return status;
}

std::string death_of(int status) {
  if (WIFSIGNALED(status)) {
    if (WTERMSIG(status) == SIGXCPU) return "it found no end";
    return text("it crashed (signal ", WTERMSIG(status), ")");
  }
  if (WEXITSTATUS(status) == kNoMemory) return "it wanted too much memory";
  return "it crashed";
}

[[noreturn]] void throw_again(const std::string& answer) {
  const auto kind = static_cast<unsigned char>(answer[0]);
  const bool known = kind <= static_cast<unsigned char>(ErrorKind::kCheckFailed);
  throw Error(known ? static_cast<ErrorKind>(kind) : ErrorKind::kInternal, answer.substr(1));
}

}  // namespace

ApartAnswer run_apart(const ApartLimits& limits, const std::function<std::string()>& work) {
  Pipe pipe = make_pipe();
  const pid_t child = ::fork();
  if (child < 0) fail_child("start");
  if (child == 0) {
    forget_signals();
    be_quiet();
    limit_child(limits);
    // No destructors and exit handlers: what they would finish belongs to the parent.
    ::_exit(answer(pipe.in.get(), work));
  }
  pipe.in = FileDescriptor();
  std::optional<std::string> bytes = read_answer(pipe.out.get(), limits.answer_bytes);
  if (!bytes) ::kill(child, SIGKILL);
  const int status = wait_for(child);
  if (!bytes) return {{}, "its answer has no end"};
  if (!WIFEXITED(status)) return {{}, death_of(status)};
  if (WEXITSTATUS(status) == kThrew && !bytes->empty()) throw_again(*bytes);
  if (WEXITSTATUS(status) != kAnswered) return {{}, death_of(status)};
  return {std::move(bytes), {}};
}

void allow_cpu_seconds(std::uint64_t seconds) {
  set_limit(RLIMIT_CPU, seconds);
}

}  // namespace mw::io
