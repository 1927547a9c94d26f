// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An output while it is written: its name, and the removal of what killed runs have left under such
// names.
#pragma once

#include <filesystem>

#include "io/file/file_descriptor.h"

namespace mw::io {

/// ENSURES: names that were made, given and removed in this folder are so on the disk.  A file
/// system that cannot sync a folder is no error, since the user could do nothing about it.
void sync_folder(const std::filesystem::path& folder);

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

}  // namespace mw::io
