// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The name of an output while it is written, and what killed runs have left under such names.
#pragma once

#include <filesystem>

#include "io/file/file_descriptor.h"

namespace mw::io {

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

}  // namespace mw::io
