// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run prints while it goes on: log lines and progress on stderr, and its trace in a file.
#pragma once

#include <chrono>
#include <string>

#include "engine/run/run.h"
#include "io/file/sink/atomic_file.h"

namespace mw::cli {

enum class ProgressKind { kNone, kBar, kJsonLines };

/// Parses "auto" (a bar when stderr is a terminal), "none" or "jsonl".
[[nodiscard]] ProgressKind parse_progress(const std::string& text);

/// Shows the first and the last window and at most a few lines a second between and afterwards.
class Progress {
 public:
  explicit Progress(ProgressKind kind) : kind_(kind) {}
  ~Progress();  ///< ends the line of a bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void show(const engine::RunProgress& at);

 private:
  using Clock = std::chrono::steady_clock;

  ProgressKind kind_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_;
  std::uint64_t done_ = 0;  ///< windows that were shown
};

/// Writes comma-separated values: a line of names, then a line for each visit as it is completed.
///   march    from 0
///   x,y,z    the window's place among the windows of its march
///   start_s, end_s   wall seconds since the run began
///   cpu_s    processor seconds of the visiting thread in between
///   slot     which thread, from 0
/// bench/scaling reads it.
class TraceFile {
 public:
  /// ERRORS: those of io::AtomicFile.
  explicit TraceFile(const std::filesystem::path& path);
  void add(const engine::TraceEvent& event);
  /// Gives the file its name.
  void finish() { file_.commit(); }

 private:
  io::AtomicFile file_;
};

}  // namespace mw::cli
