// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The seam between the store and the file system; tests put failing disks and power cuts here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "kernels/core/error.h"

namespace mw::engine {

/// Thrown when what comes back is not what was stored: "PLACE: corrupt: REASON", with the exit code
/// of bad input.  A caller that knows the work folder adds the way out (run.cpp).
class DamagedWork : public Error {
 public:
  DamagedWork(const std::string& where, const std::string& reason)
      : Error(ErrorKind::kInput, where + ": corrupt: " + reason) {}
};

/// What a reader does with bytes that are there only while it runs.
using UseBytes = std::function<void(std::span<const std::byte>)>;

/// A file of the work folder.
/// ERRORS (all members): mw::Error(kResource) naming the file when the disk is full or broken.
/// Thread safety: write and read of different bytes, prefetch and sync may run at the same time;
/// resize may not run beside anything but reads.
class WorkFile {
 public:
  virtual ~WorkFile() = default;

  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// Makes the file this long.  ENSURES: new bytes are 0 and have their place on the disk, so that
  /// writing them cannot run out of it.
  virtual void resize(std::uint64_t size) = 0;
  /// REQUIRES: inside the file.
  virtual void write(std::uint64_t offset, std::span<const std::byte> bytes) = 0;
  /// REQUIRES: inside the file.
  virtual void read(std::uint64_t offset, std::uint64_t size, const UseBytes& use) const = 0;
  /// A hint that these bytes will be read soon.
  virtual void prefetch(std::uint64_t offset, std::uint64_t size) const = 0;
  /// ENSURES: all that was written survives a power cut.
  virtual void sync() = 0;
};

/// The files of a work folder by name; one that is not there yet is made, empty.
class WorkFiles {
 public:
  virtual ~WorkFiles() = default;
  [[nodiscard]] virtual std::unique_ptr<WorkFile> open(const std::string& name) = 0;
};

}  // namespace mw::engine
