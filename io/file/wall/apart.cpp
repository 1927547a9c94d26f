// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Runs work in a process of its own, by fork, with limits and a pipe for the answer.
#include "io/file/wall/apart.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>

#include "io/file/errors.h"
#include "io/file/file_descriptor.h"

namespace mw::io {
namespace {

/// How the work ended.  The child sends it as the last thing that it does: a host program may
/// ignore SIGCHLD, and then the system does not tell how a child ended.  Behind kThrew come the
/// kind of the error, one byte, and its message.
enum class ChildEnd : unsigned char { kAnswered, kThrew, kNoMemory, kOther };

/// The longest message of a child.  A pipe holds as much while nobody reads it.
constexpr std::size_t kMaxMessage = 1 << 15;

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

/// Returns the bytes of address space of this process; 0 when the system does not tell.
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

/// Resets the signals, so that a crash, which is expected here, kills the child quietly, whatever
/// this program or a tool does about signals.  What a terminal or a batch system sends to the whole
/// group is for the parent, which ends the child: a child that died of it would look like a crash.
void forget_signals() {
  for (const int signal : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGPIPE, SIGSEGV, SIGXCPU}) {
    ::signal(signal, SIG_DFL);
  }
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) ::signal(signal, SIG_IGN);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
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

void send_all(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(fd, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) throw std::runtime_error("nobody reads the pipe");
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
}

void tell_end(int fd, ChildEnd end) {
  send_all(fd, std::as_bytes(std::span(&end, 1)));
}

void throw_over(int fd, const Error& error) {
  const std::string message =
      std::string{static_cast<char>(ChildEnd::kThrew), static_cast<char>(error.kind())} +
      std::string(error.what()).substr(0, kMaxMessage - 2);
  send_all(fd, std::as_bytes(std::span(message)));
}

/// Runs in the child.  ERRORS: std::runtime_error when nobody reads how it ended.
void do_work(const Pipe& data, const Pipe& errors,
             const std::function<void(const SendBytes&)>& work) {
  try {
    try {
      work([&](std::span<const std::byte> bytes) { send_all(data.in.get(), bytes); });
      tell_end(errors.in.get(), ChildEnd::kAnswered);
    } catch (const Error& error) {
      throw_over(errors.in.get(), error);
    }
  } catch (const std::bad_alloc&) {
    tell_end(errors.in.get(), ChildEnd::kNoMemory);
  } catch (...) {
    tell_end(errors.in.get(), ChildEnd::kOther);
  }
}

[[noreturn]] void be_child(const Pipe& data, const Pipe& errors,
                           const std::function<void(const SendBytes&)>& work) {
  try {
    do_work(data, errors, work);
  } catch (...) {  // nobody is there to be told
  }
  // _exit() runs no destructors and exit handlers: what they would finish belongs to the parent.
  ::_exit(0);
}

/// The child as the parent sees it; it is killed when this object is destroyed.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (id_ < 0) return;
    ::kill(id_, SIGKILL);
    wait();
  }

  /// Waits for its end and returns how it ended, as waitpid tells it; nothing where the system does
  /// not tell.
  std::optional<int> wait() {
    int status = 0;
    pid_t ended = -1;
    do {
      ended = ::waitpid(id_, &status, 0);
    } while (ended < 0 && errno == EINTR);
    id_ = -1;
    return ended < 0 ? std::nullopt : std::optional(status);
  }

 private:
  pid_t id_;
};

/// Returns how a child died that has not told its end.
std::string death_of(std::optional<int> status) {
  if (!status || !WIFSIGNALED(*status)) return "it crashed";
  if (WTERMSIG(*status) == SIGXCPU) return "it found no end";
  return text("it crashed (signal ", WTERMSIG(*status), ")");
}

[[noreturn]] void throw_again(const std::string& message) {
  const auto kind = static_cast<unsigned char>(message[1]);
  const bool known = kind <= static_cast<unsigned char>(ErrorKind::kCheckFailed);
  throw Error(known ? static_cast<ErrorKind>(kind) : ErrorKind::kInternal, message.substr(2));
}

/// Returns how the work died; empty where it came to its end.  ERRORS: that of the work.
std::string death_told(const std::string& message, std::optional<int> status) {
  if (message.empty()) return death_of(status);
  switch (static_cast<ChildEnd>(message[0])) {
    case ChildEnd::kAnswered:
      return {};
    case ChildEnd::kThrew:
      if (message.size() > 1) throw_again(message);
      break;
    case ChildEnd::kNoMemory:
      return "it wanted too much memory";
    case ChildEnd::kOther:
      break;
  }
  return death_of(status);
}

std::string read_message(const Pipe& errors) {
  std::string message(kMaxMessage, '\0');
  ApartStream stream(errors.out.get());
  std::size_t length = 0;
  while (length < message.size()) {
    const std::size_t more =
        stream.read_some(std::as_writable_bytes(std::span(message).subspan(length)));
    if (more == 0) break;
    length += more;
  }
  message.resize(length);
  return message;
}

}  // namespace

std::size_t ApartStream::read_some(std::span<std::byte> out) {
  while (true) {
    const ssize_t done = ::read(fd_, out.data(), out.size());
    if (done < 0 && errno == EINTR) continue;
    return done < 0 ? 0 : static_cast<std::size_t>(done);
  }
}

bool ApartStream::read(std::span<std::byte> out) {
  while (!out.empty()) {
    const std::size_t done = read_some(out);
    if (done == 0) return false;
    out = out.subspan(done);
  }
  return true;
}

std::string stream_apart(const ApartLimits& limits,
                         const std::function<void(const SendBytes&)>& work,
                         const std::function<void(ApartStream&)>& consume) {
  Pipe data = make_pipe(), errors = make_pipe();
  const pid_t id = ::fork();
  if (id < 0) fail_child("start");
  if (id == 0) {
    // The child closes its reading ends, since a pipe breaks only when nobody can read it.
    data.out = FileDescriptor();
    errors.out = FileDescriptor();
    forget_signals();
    be_quiet();
    limit_child(limits);
    be_child(data, errors, work);
  }
  Child child(id);
  data.in = FileDescriptor();
  errors.in = FileDescriptor();
  ApartStream stream(data.out.get());
  consume(stream);
  data.out = FileDescriptor();  // a child that has more to send ends by that
  const std::string message = read_message(errors);
  return death_told(message, child.wait());
}

ApartAnswer run_apart(const ApartLimits& limits, const std::function<std::string()>& work) {
  std::string all;
  bool too_long = false;
  const auto consume = [&](ApartStream& stream) {
    std::array<std::byte, 1 << 16> piece{};
    while (const std::size_t done = stream.read_some(piece)) {
      too_long = all.size() + done > limits.answer_bytes;
      if (too_long) return;
      all.append(reinterpret_cast<const char*>(piece.data()), done);
    }
  };
  const auto send_all = [&](const SendBytes& send) {
    const std::string answer = work();
    send(std::as_bytes(std::span(answer)));
  };
  const std::string death = stream_apart(limits, send_all, consume);
  if (too_long) return {{}, "its answer has no end"};
  if (!death.empty()) return {{}, death};
  return {std::move(all), {}};
}

void allow_cpu_seconds(std::uint64_t seconds) {
  set_limit(RLIMIT_CPU, seconds);
}

}  // namespace mw::io
