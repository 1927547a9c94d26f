// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Worker processes for constrained Delaunay triangulation, one for each request at the same time:
// started, spoken to, and ended.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/codt/find_worker.h"
#include "engine/codt/wire.h"
#include "io/file/file_descriptor.h"

namespace mw::engine::codt {

/// A child that runs the worker program.  It is alone in its process group, so that a terminal's
/// signals do not reach it, and its only descriptors are the control socket and /dev/null.  It ends
/// by itself when the other end of the socket is closed.
/// Thread safety: any thread, but one at a time.  (PR_SET_PDEATHSIG is not used, because it acts
/// when the thread ends that started the child, and threads come and go.)
class WorkerProcess {
 public:
  using Milliseconds = std::chrono::milliseconds;

  /// ERRORS: kUsage when the program cannot be started; kResource when there can be no process.
  explicit WorkerProcess(const std::filesystem::path& program);
  /// Kills it.
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  enum class Outcome {
    kAnswered,
    kRefused,  ///< the worker says that there is no triangulation
    // A worker that gave one of these cannot be used any more.
    kCrashed,  ///< the request is to blame: a signal as of a crash, or the protocol was broken
    kLost,     ///< the machine is: another signal, an exit, or too much time; see loss()
  };
  /// Waits for each of the worker's replies until it has taken `patience` of processor time, or ten
  /// times that by the clock; `out` is set when it answered.
  /// ERRORS: those of SharedMemory::create().
  [[nodiscard]] Outcome run(const Plc& plc, Triangulation& out, Milliseconds patience);

  [[nodiscard]] pid_t id() const { return id_; }
  /// Returns what happened to a worker that was lost, as "was ended by signal 9 (Killed)".
  [[nodiscard]] const std::string& loss() const { return loss_; }

 private:
  /// Returns nothing when the outcome is failure_.
  [[nodiscard]] std::optional<Reply> ask(const Order& order, Milliseconds patience);
  [[nodiscard]] bool share(std::size_t bytes, Milliseconds patience);
  [[nodiscard]] Outcome find_cause();
  [[nodiscard]] int end();

  io::FileDescriptor control_;
  pid_t id_ = -1;
  SharedMemory memory_;
  Outcome failure_ = Outcome::kCrashed;
  std::string loss_;
};

struct PoolOptions {
  std::filesystem::path program;  ///< if empty, find_worker()
  /// Processor time for each reply, then the worker is killed.
  std::chrono::milliseconds patience{60'000};
};

/// What a pool has done.
struct PoolFacts {
  std::uint64_t requests = 0;
  std::uint64_t refused = 0;    ///< TetGen found no triangulation
  std::uint64_t failed = 0;     ///< two workers crashed over a request
  std::uint64_t restarted = 0;  ///< workers started in place of dead ones
};

/// Runs TetGen in processes of its own (engine/README.md, "Worker processes").  TetGen keeps
/// predicate constants in statics, rewrites tables and uses the process-wide rand(), so two threads
/// of one process get different meshes; it may crash or hang, and it is under the AGPL.
///
/// When a worker is gone, a fresh one is asked the same.  When a second one crashes, the request
/// fails, as it would fail in every other run.  What the machine does to workers must not change a
/// mesh: where it takes eight from one request, that is an error.
/// Thread-safe.
class WorkerPool {
 public:
  /// Starts one worker, so that a program that cannot be started is found before any work.
  /// ERRORS: those of find_worker() and WorkerProcess.
  explicit WorkerPool(PoolOptions options);

  /// Does what a Triangulate must do.  ERRORS: those of WorkerProcess; kResource when the machine
  /// takes one worker after the other.
  [[nodiscard]] std::optional<Triangulation> triangulate(const Plc& plc);

  [[nodiscard]] PoolFacts facts() const;
  /// Returns the process ids of workers that wait for work; for tests that kill them.
  [[nodiscard]] std::vector<pid_t> idle() const;

 private:
  [[nodiscard]] std::unique_ptr<WorkerProcess> take();
  void give_back(std::unique_ptr<WorkerProcess> worker);

  PoolOptions options_;
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<WorkerProcess>> idle_;
  std::atomic<std::uint64_t> requests_ = 0, refused_ = 0, failed_ = 0, restarted_ = 0;
};

}  // namespace mw::engine::codt
