// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An output folder that appears under its name only when it is whole.
#pragma once

#include <filesystem>

#include "io/file/file_descriptor.h"

namespace mw::io {

/// Files are written into ".<name>.partial-..." beside the target (partial_file.h); commit() gives
/// it its name in one step.  The destructor of a folder that was not committed removes it and all
/// that is in it. ERRORS (all members): mw::Error(kResource) when the disk is full; kUsage when the
/// folder cannot be made, or exists and is not empty.  Thread safety: none.
class AtomicFolder {
 public:
  explicit AtomicFolder(const std::filesystem::path& target);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// Where the files go until commit().
  [[nodiscard]] const std::filesystem::path& path() const { return partial_; }
  /// REQUIRES: called once; nothing is written afterwards.
  void commit();
  /// Removes the folder with its name, for what should have come with it and did not.
  /// REQUIRES: commit() was called; nothing else is in it.
  void withdraw();

 private:
  std::filesystem::path target_;
  std::filesystem::path partial_;
  FileDescriptor lock_;
  bool committed_ = false;
};

}  // namespace mw::io
