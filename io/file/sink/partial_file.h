// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An output while it is written: its name, what killed runs have left under such names, and the
// bytes that other processes put into it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "io/file/file_descriptor.h"

namespace mw::io {

/// ENSURES: names made, given and removed in this folder before are so on the disk.  File systems
/// that cannot sync a folder say so, and that is not the user's problem: nothing else would help.
void sync_folder(const std::filesystem::path& folder);

/// Where rows of columns go, in a file that this process or another has made.
class PlacedOutput {
 public:
  virtual ~PlacedOutput() = default;
  /// Over what is there, and beyond the end.  ERRORS: as AtomicFile.
  virtual void write_at(std::uint64_t offset, std::span<const std::byte> bytes) = 0;
};

/// An output that is being written: ".NAME.partial-KERNEL-PID-N" beside the target NAME.  KERNEL
/// tells apart machines, and the times between their starts; it is the same in all containers of
/// one.
///
/// Its file (flock) is locked until it has its own name or its writer is gone, so that one whose
/// lock is free is left over from a run that was killed; numbers of processes, which are used
/// again, do not matter. Some shared file systems keep locks from other machines: there only what
/// this one has left is taken for left over.
struct PartialOutput {
  std::filesystem::path path;
  FileDescriptor file;
};

enum class PartialKind { kFile, kFolder };

/// Makes a new one, and removes what killed runs have left of the same target.  (A folder is
/// searched for such leftovers once in the life of the process.)
/// REQUIRES: target has a file name.
/// ENSURES: file is locked where the file system has locks; of a file, open to read and write.
/// ERRORS: mw::Error(kUsage or kResource) naming the target.  Thread safety: any.
[[nodiscard]] PartialOutput make_partial(const std::filesystem::path& target, PartialKind kind);

/// The folder that a path is in, "." of a name alone.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& path);

/// The partial file of an AtomicFile of this or another process, maybe on another machine: opened
/// to write some of its bytes.  Its maker gives it its name, or removes it.
///
/// Opened for writing alone, and by the maker too: a client of NFS that may read fetches the whole
/// page around a few bytes and writes it back whole, over what others have written there meanwhile.
/// For the same reason the file has its size before anybody writes (AtomicFile::resize()).
/// ERRORS (all members): as AtomicFile.  Thread safety: none.
class JoinedPartial : public PlacedOutput {
 public:
  explicit JoinedPartial(const std::filesystem::path& partial);

  void write_at(std::uint64_t offset, std::span<const std::byte> bytes) override;
  /// What was written is on the disk.
  void sync();

 private:
  std::filesystem::path path_;
  FileDescriptor file_;
};

}  // namespace mw::io
