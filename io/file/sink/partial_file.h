// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An output while it is written: its name, the removal of what killed runs have left under such
// names, and the bytes that other processes put into it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "io/file/file_descriptor.h"

namespace mw::io {

/// ENSURES: names that were made, given and removed in this folder are so on the disk.  A file
/// system that cannot sync a folder is no error, since the user could do nothing about it.
void sync_folder(const std::filesystem::path& folder);

/// A file that this process or another has made, in which rows of columns go to their places.
class PlacedOutput {
 public:
  virtual ~PlacedOutput() = default;
  /// Writes bytes from offset on, over what is there and beyond the end.  ERRORS: as AtomicFile.
  virtual void write_at(std::uint64_t offset, std::span<const std::byte> bytes) = 0;
};

/// An output that is being written, ".NAME.partial-KERNEL-PID-N" beside the target NAME.  KERNEL
/// tells apart machines, and the starts of one machine; all containers of a machine share it.  Of a
/// NAME that is too long for that it has the beginning, and digits of the whole.
///
/// The output is locked (flock) until it has its own name or its writer is gone, so that one whose
/// lock is free is left over from a run that was killed, even if another process has its PID.  Some
/// shared file systems do not show locks to other machines; there only leftovers of this machine
/// are removed.
struct PartialOutput {
  std::filesystem::path path;
  FileDescriptor file;
};

enum class PartialKind { kFile, kFolder };

/// Makes a partial output, and removes what killed runs have left of the same target.  (A folder is
/// searched for such leftovers once in the life of the process.)
/// REQUIRES: target has a file name.
/// ENSURES: It is locked where the file system has locks; a file is open to read and write.
/// ERRORS: mw::Error(kUsage or kResource) naming the target.  Thread safety: any.
[[nodiscard]] PartialOutput make_partial(const std::filesystem::path& target, PartialKind kind);

/// Returns the folder that a path is in, which is "." for a name alone.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& path);

/// The partial file of an AtomicFile of this or another process, maybe on another machine, opened
/// to write some of its bytes.  Its maker gives it its name, or removes it.
///
/// Each writer, the maker too, writes by one of these, which is open for writing alone: a client of
/// NFS that may also read fetches the page around a few bytes and writes it back whole, over what
/// others have written.  So the file also has its size before that (AtomicFile::resize()).
/// ERRORS (all members): as AtomicFile.  Thread safety: none.
class JoinedPartial : public PlacedOutput {
 public:
  explicit JoinedPartial(const std::filesystem::path& partial);

  void write_at(std::uint64_t offset, std::span<const std::byte> bytes) override;
  /// Puts what was written on the disk.
  void sync();

 private:
  std::filesystem::path path_;
  FileDescriptor file_;
};

}  // namespace mw::io
