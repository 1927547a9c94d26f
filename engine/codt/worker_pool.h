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
    kDead,     ///< it died, was too late, or broke the protocol, and cannot be used any more
  };
  /// Waits at most `patience` for each of the worker's replies; `out` is set when it answered.
  /// ERRORS: those of SharedMemory::create().
  [[nodiscard]] Outcome run(const Plc& plc, Triangulation& out, Milliseconds patience);

  [[nodiscard]] pid_t id() const { return id_; }

 private:
  /// Returns nothing when the outcome is kDead.
  [[nodiscard]] std::optional<Reply> ask(const Order& order, Milliseconds patience) const;
  [[nodiscard]] bool share(std::size_t bytes, Milliseconds patience);

  io::FileDescriptor control_;
  pid_t id_ = -1;
  SharedMemory memory_;
};

struct PoolOptions {
  std::filesystem::path program;               ///< if empty, find_worker()
  std::chrono::milliseconds patience{60'000};  ///< time for each reply, then the worker is killed
};

/// What a pool has done.
struct PoolFacts {
  std::uint64_t requests = 0;
  std::uint64_t refused = 0;    ///< TetGen found no triangulation
  std::uint64_t failed = 0;     ///< two workers in a row died over a request
  std::uint64_t restarted = 0;  ///< workers started in place of dead ones
};

/// Runs TetGen in processes of its own (engine/README.md, "Worker processes").  TetGen keeps
/// predicate constants in statics, rewrites tables and uses the process-wide rand(), so two threads
/// of one process get different meshes; it may crash or hang, and it is under the AGPL.
///
/// When a worker dies or is too late, a fresh one is asked the same.  When that dies as well, the
/// request fails, as it would fail in every other run.
/// Thread-safe.
class WorkerPool {
 public:
  /// Starts one worker, so that a program that cannot be started is found before any work.
  /// ERRORS: those of find_worker() and WorkerProcess.
  explicit WorkerPool(PoolOptions options);

  /// Does what a Triangulate must do.  ERRORS: those of WorkerProcess.
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
