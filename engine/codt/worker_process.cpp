// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Starts a worker by posix_spawn, asks it over a socket with deadlines, ends it by SIGKILL, and
// tells crashes from what the machine does.
#include "engine/codt/worker_pool.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <utility>

#include "io/file/errors.h"
#include "kernels/core/error.h"

namespace mw::engine::codt {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMinMemory = std::size_t{1} << 20;

std::pair<io::FileDescriptor, io::FileDescriptor> socket_pair() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw Error(
        ErrorKind::kResource,
        std::string("cannot make a socket for a worker: ") + std::strerror(errno));  // NOLINT
  }
  return {io::FileDescriptor(ends[0]), io::FileDescriptor(ends[1])};
}

/// Says what the child does between fork and exec.
class SpawnPlan {
 public:
  explicit SpawnPlan(int control) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_adddup2(&actions_, control, kControlDescriptor);
    for (int i = 0; i < kControlDescriptor; ++i) {
      ::posix_spawn_file_actions_addopen(&actions_, i, "/dev/null", O_RDWR, 0);
    }
    ::posix_spawn_file_actions_addclosefrom_np(&actions_, kControlDescriptor + 1);
    ::posix_spawnattr_init(&attributes_);
    sigset_t none;
    sigemptyset(&none);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setpgroup(&attributes_, 0);
    ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  }
  ~SpawnPlan() {
    ::posix_spawn_file_actions_destroy(&actions_);
    ::posix_spawnattr_destroy(&attributes_);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;

  [[nodiscard]] pid_t start(const std::string& program) const {
    std::string name = program;
    std::array<char*, 2> arguments{name.data(), nullptr};
    pid_t id = -1;
    const int reason =
        ::posix_spawn(&id, program.c_str(), &actions_, &attributes_, arguments.data(), environ);
    if (reason == 0) return id;
    const std::string message = "--optimizer tetgen: cannot start " + program + ": " +
                                std::strerror(reason);  // NOLINT(concurrency-mt-unsafe)
    if (reason != EAGAIN && reason != ENOMEM) io::fail_usage(message);
    throw Error(ErrorKind::kResource,
                message + "; raise the limit of processes (ulimit -u) or give fewer --threads");
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

/// Returns the processor time that a process has taken, 0 once it has ended.
std::chrono::nanoseconds processor_time(pid_t id) {
  clockid_t clock{};
  timespec time{};
  if (::clock_getcpuclockid(id, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return {};
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// Returns true when something can be read or the other end is closed, false when the worker has
/// taken too long.  One that is stopped, or gets no processor, is waited for ten times as long.
bool wait_for_message(int descriptor, pid_t worker, std::chrono::milliseconds patience) {
  constexpr int kSliceMs = 100, kByTheClock = 10;
  const auto last = processor_time(worker) + patience;
  const Clock::time_point deadline = Clock::now() + kByTheClock * patience;
  do {
    pollfd wanted{descriptor, POLLIN, 0};
    if (::poll(&wanted, 1, kSliceMs) > 0) return true;
  } while (processor_time(worker) < last && Clock::now() < deadline);
  return false;
}

}  // namespace

WorkerProcess::WorkerProcess(const std::filesystem::path& program) {
  auto [ours, theirs] = socket_pair();
  id_ = SpawnPlan(theirs.get()).start(program.string());
  control_ = std::move(ours);
}

WorkerProcess::~WorkerProcess() {
  if (id_ > 0) static_cast<void>(end());
}

/// Kills it if it is alive, and returns the status that it ended with.
int WorkerProcess::end() {
  int status = 0;
  ::kill(id_, SIGKILL);
  while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
  id_ = -1;
  return status;
}

/// Ends a worker that has closed its socket, and returns what it died of.
WorkerProcess::Outcome WorkerProcess::find_cause() {
  const int status = end();
  if (WIFEXITED(status)) {
    loss_ = io::text("ended with exit code ", WEXITSTATUS(status));
    return Outcome::kLost;
  }
  const int signal = WTERMSIG(status);
  for (const int crash : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS}) {
    if (signal == crash) return Outcome::kCrashed;
  }
  const char* const name = ::sigdescr_np(signal);
  loss_ =
      io::text("was ended by signal ", signal, name == nullptr ? "" : io::text(" (", name, ")"));
  return Outcome::kLost;
}

std::optional<Reply> WorkerProcess::ask(const Order& order, Milliseconds patience) {
  failure_ = Outcome::kCrashed;
  ssize_t count = -1;
  do {
    count = ::send(control_.get(), &order, sizeof order, MSG_NOSIGNAL);
  } while (count < 0 && errno == EINTR);
  Reply reply;
  if (count == sizeof order) {
    if (!wait_for_message(control_.get(), id_, patience)) {
      loss_ = io::text("took more than ", static_cast<double>(patience.count()) / 1000,
                       " s of processor time, or ten times that by the clock");
      failure_ = Outcome::kLost;
      return std::nullopt;
    }
    do {
      count = ::recv(control_.get(), &reply, sizeof reply, 0);
    } while (count < 0 && errno == EINTR);
  }
  if (count <= 0) failure_ = find_cause();
  const bool known = reply.kind == ReplyKind::kDone || reply.kind == ReplyKind::kNoTriangulation;
  return count == sizeof reply && known ? std::optional(reply) : std::nullopt;
}

bool WorkerProcess::share(std::size_t bytes, Milliseconds patience) {
  const std::size_t present = memory_.bytes().size();
  if (bytes <= present) return true;
  memory_ = SharedMemory::create(std::max({bytes, 2 * present, kMinMemory}));
  Order order{.kind = OrderKind::kMap};
  memory_.name().copy(order.name.data(), order.name.size() - 1);
  const std::optional<Reply> reply = ask(order, patience);
  memory_.remove_name();
  return reply.has_value();
}

WorkerProcess::Outcome WorkerProcess::run(const Plc& plc, Triangulation& out,
                                          Milliseconds patience) {
  // An answer has some three times the bytes of its request; a worker that claims far more is
  // broken.
  constexpr std::size_t kMaxAnswer = 64;
  const std::size_t bytes = bytes_of(plc);
  if (!share(bytes, patience)) return failure_;
  put(plc, memory_.bytes());
  const std::optional<Reply> done = ask({.kind = OrderKind::kRun}, patience);
  if (!done) return failure_;
  if (done->kind == ReplyKind::kNoTriangulation) return Outcome::kRefused;
  if (done->bytes > kMaxAnswer * bytes + kMinMemory) return Outcome::kCrashed;
  if (!share(done->bytes, patience) || !ask({.kind = OrderKind::kFetch}, patience)) return failure_;
  std::optional<Triangulation> made = get_triangulation(memory_.bytes());
  if (!made) return Outcome::kCrashed;
  out = std::move(*made);
  return Outcome::kAnswered;
}

}  // namespace mw::engine::codt
