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
/// signals do not reach it, and has no descriptor but the control socket and /dev/null.  It ends by
/// itself when its end of the socket finds nobody.
/// Thread safety: one thread at a time, any one.  (No PR_SET_PDEATHSIG: that is about the thread
/// that started the child, and threads come and go.)
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
    kDead,     ///< it died, was too late, or spoke nonsense; good for nothing any more
  };
  /// `out` is set when the worker answered.  Each message is waited for at most `patience`.
  /// ERRORS: those of SharedMemory::create().
  [[nodiscard]] Outcome run(const Plc& plc, Triangulation& out, Milliseconds patience);

  [[nodiscard]] pid_t id() const { return id_; }

 private:
  /// None when the worker is dead to us.
  [[nodiscard]] std::optional<Reply> ask(const Order& order, Milliseconds patience) const;
  [[nodiscard]] bool share(std::size_t bytes, Milliseconds patience);

  io::FileDescriptor control_;
  pid_t id_ = -1;
  SharedMemory memory_;
};

}  // namespace mw::engine::codt
