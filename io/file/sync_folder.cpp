// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of files that are to survive a power cut.
#include "io/file/sync_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include "io/file/file_descriptor.h"

namespace mw::io {

void sync_folder(const std::filesystem::path& folder) {
  const FileDescriptor handle(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (handle.valid()) ::fsync(handle.get());
}

}  // namespace mw::io
