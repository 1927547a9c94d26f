// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One worker process: started, spoken to, and ended.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>

#include "engine/codt/shared_memory.h"
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

}  // namespace mw::engine::codt
