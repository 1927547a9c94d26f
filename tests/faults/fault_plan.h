// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which system call fails, and the record of all of them: what the environment asks for.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace mw::faults {

/// What happens instead of a call.
struct Fault {
  int error = 0;          ///< errno, 0: none
  bool is_short = false;  ///< half of the bytes are written or read, if there are two
  [[nodiscard]] bool fails() const { return error != 0; }
};

/// Numbers the call (from 1) when it is on something below the folder FAULT_FOLDER, and says
/// whether it is to fail: the one that FAULT_AT names, in the way FAULT_HOW: an errno as a number,
/// "short", or "kill", which does not return; or it and all later calls: "full", those that take
/// space, and "gone", all.  The log FAULT_LOG, if any, gets a line "call NUMBER NAME PATH".
/// Thread-safe.  Leaves errno as it is.
[[nodiscard]] Fault next_fault(std::string_view call, const std::string& path);

/// Adds to the log what a call has done: a line "NAME PATH OFFSET SIZE OTHER", the fields apart by
/// tabs, and for NAME "write" SIZE bytes and an end of line.  Nothing for paths outside the folder.
struct Event {
  std::string_view name;
  std::string path;
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
  const void* data = nullptr;  ///< of a write
  std::string other = "-";     ///< the new name of a rename
};
void record(const Event& event);

/// Where the open file is; with " (deleted)" when it has no name any more.
[[nodiscard]] std::string path_of(int file);
/// An absolute path for one that is relative to the working directory.
[[nodiscard]] std::string absolute(const char* path);
[[nodiscard]] bool is_watched(const std::string& path);

}  // namespace mw::faults
