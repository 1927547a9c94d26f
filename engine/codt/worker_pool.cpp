// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Takes workers from a stack and puts them back; starts a worker by posix_spawn, asks it over a
// socket with deadlines, and ends it by SIGKILL.
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
#include <cstring>
#include <utility>

#include "io/file/errors.h"
#include "kernels/core/error.h"

namespace mw::engine::codt {

WorkerPool::WorkerPool(PoolOptions options) : options_(std::move(options)) {
  if (options_.program.empty()) options_.program = find_worker();
  give_back(take());
}

std::optional<Triangulation> WorkerPool::triangulate(const Plc& plc) {
  ++requests_;
  Triangulation made;
  std::unique_ptr<WorkerProcess> worker = take();
  WorkerProcess::Outcome outcome = worker->run(plc, made, options_.patience);
  if (outcome == WorkerProcess::Outcome::kDead) {
    ++restarted_;
    worker = std::make_unique<WorkerProcess>(options_.program);
    outcome = worker->run(plc, made, options_.patience);
  }
  if (outcome == WorkerProcess::Outcome::kDead) {
    ++failed_;
    return std::nullopt;
  }
  give_back(std::move(worker));
  if (outcome == WorkerProcess::Outcome::kAnswered) return made;
  ++refused_;
  return std::nullopt;
}

PoolFacts WorkerPool::facts() const {
  return {requests_, refused_, failed_, restarted_};
}

std::vector<pid_t> WorkerPool::idle() const {
  const std::lock_guard lock(mutex_);
  std::vector<pid_t> out;
  for (const auto& worker : idle_) out.push_back(worker->id());
  return out;
}

std::unique_ptr<WorkerProcess> WorkerPool::take() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      std::unique_ptr<WorkerProcess> worker = std::move(idle_.back());
      idle_.pop_back();
      return worker;
    }
  }
  return std::make_unique<WorkerProcess>(options_.program);
}

void WorkerPool::give_back(std::unique_ptr<WorkerProcess> worker) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(worker));
}

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

/// Returns true when something can be read or the other end is closed, false at the deadline.
bool wait_for_message(int descriptor, Clock::time_point deadline) {
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd wanted{descriptor, POLLIN, 0};
    const int ready =
        ::poll(&wanted, 1, static_cast<int>(std::clamp<std::int64_t>(left, 0, 1 << 30)));
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

}  // namespace

WorkerProcess::WorkerProcess(const std::filesystem::path& program) {
  auto [ours, theirs] = socket_pair();
  id_ = SpawnPlan(theirs.get()).start(program.string());
  control_ = std::move(ours);
}

WorkerProcess::~WorkerProcess() {
  ::kill(id_, SIGKILL);
  while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::optional<Reply> WorkerProcess::ask(const Order& order, Milliseconds patience) const {
  const Clock::time_point deadline = Clock::now() + patience;
  ssize_t count = -1;
  do {
    count = ::send(control_.get(), &order, sizeof order, MSG_NOSIGNAL);
  } while (count < 0 && errno == EINTR);
  if (count != sizeof order || !wait_for_message(control_.get(), deadline)) return std::nullopt;
  Reply reply;
  do {
    count = ::recv(control_.get(), &reply, sizeof reply, 0);
  } while (count < 0 && errno == EINTR);
  const bool known = reply.kind == ReplyKind::kDone || reply.kind == ReplyKind::kNoTriangulation;
  if (count != sizeof reply || !known) return std::nullopt;
  return reply;
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
  // An answer has some three times the bytes of its request; a worker that claims far more is dead.
  constexpr std::size_t kMaxAnswer = 64;
  const std::size_t bytes = bytes_of(plc);
  if (!share(bytes, patience)) return Outcome::kDead;
  put(plc, memory_.bytes());
  const std::optional<Reply> done = ask({.kind = OrderKind::kRun}, patience);
  if (!done) return Outcome::kDead;
  if (done->kind == ReplyKind::kNoTriangulation) return Outcome::kRefused;
  if (done->bytes > kMaxAnswer * bytes + kMinMemory) return Outcome::kDead;
  if (!share(done->bytes, patience) || !ask({.kind = OrderKind::kFetch}, patience)) {
    return Outcome::kDead;
  }
  std::optional<Triangulation> made = get_triangulation(memory_.bytes());
  if (!made) return Outcome::kDead;
  out = std::move(*made);
  return Outcome::kAnswered;
}

}  // namespace mw::engine::codt
