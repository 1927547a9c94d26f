// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The trace of a run (--trace): one line a visit.
#pragma once

#include "engine/run/run.h"
#include "io/file/sink/atomic_file.h"

namespace mw::cli {

/// Comma-separated values: a line of names, then a line for each visit in order of completion.
///   march    from 0
///   x,y,z    the window's place among the windows of its march
///   start_s, end_s   wall seconds since the run began
///   cpu_s    processor seconds of the visiting thread in between
///   slot     which thread, from 0
/// bench/scaling reads it.
class TraceFile {
 public:
  /// ERRORS: as io::AtomicFile.
  explicit TraceFile(const std::filesystem::path& path);
  void add(const engine::TraceEvent& event);
  /// The file appears under its name.
  void finish() { file_.commit(); }

 private:
  io::AtomicFile file_;
};

}  // namespace mw::cli
