// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Work in a process of its own, for libraries that damaged input can crash.  Volumes
// (io/volume/hdf5/description.h) and meshes (io/mesh/apart_mesh.h) call the HDF5 library so.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace mw::io {

struct ApartLimits {
  std::uint64_t memory_bytes = std::uint64_t{1} << 30U;  ///< beyond what this process has now
  std::uint64_t cpu_seconds = 5;                         ///< waiting for a disk does not count
  std::size_t answer_bytes = std::size_t{1} << 20U;
};

/// What came of the work.
struct ApartAnswer {
  std::optional<std::string> bytes;  ///< what the work returned, unless it died
  std::string death;                 ///< otherwise how: "it crashed (signal 11)"
};

/// Runs work in a child of this process, so that whatever it breaks or leaves open ends with the
/// child.  Its output and error streams lead nowhere.
/// REQUIRES: work starts no threads and needs no lock that another thread may hold.
/// ERRORS: the mw::Error that work throws; kResource when no child can be started.
[[nodiscard]] ApartAnswer run_apart(const ApartLimits& limits,
                                    const std::function<std::string()>& work);

/// The bytes that a child sends, in order.
class ApartStream {
 public:
  explicit ApartStream(int fd) : fd_(fd) {}
  /// Returns how many bytes came, at most the size of out; 0 when no more will come.
  [[nodiscard]] std::size_t read_some(std::span<std::byte> out);
  /// Fills all of out; false if the stream ended before.
  [[nodiscard]] bool read(std::span<std::byte> out);

 private:
  int fd_;
};

using SendBytes = std::function<void(std::span<const std::byte>)>;

/// Runs work apart as run_apart() does, but work sends as it goes; limits.answer_bytes has no
/// effect.  consume takes in this process what comes, while it comes; if it throws, the child ends.
/// It must not take the end of the stream for success: errors and deaths are known only afterwards.
/// ENSURES: returns how the work died; an empty text when it came to its end.
[[nodiscard]] std::string stream_apart(const ApartLimits& limits,
                                       const std::function<void(const SendBytes&)>& work,
                                       const std::function<void(ApartStream&)>& consume);

/// Lets work, which calls this, take this much processor time, counted from its start.
void allow_cpu_seconds(std::uint64_t seconds);

}  // namespace mw::io
