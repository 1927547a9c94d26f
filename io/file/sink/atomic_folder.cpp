// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An output folder that appears under its name only when it is whole.
#include "io/file/sink/atomic_folder.h"

#include <cerrno>
#include <cstdio>

#include "io/file/errors.h"
#include "io/file/sink/partial_file.h"

namespace mw::io {
namespace {

/// Without a '/' at its end; nothing may be there but an empty folder.
std::filesystem::path free_target(const std::filesystem::path& target) {
  std::filesystem::path name = target.has_filename() ? target : target.parent_path();
  std::error_code failed;
  const bool exists = std::filesystem::exists(name, failed);
  const bool is_free = !exists || (std::filesystem::is_directory(name, failed) &&
                                   std::filesystem::is_empty(name, failed));
  if (is_free && !failed && name.has_filename()) return name;
  throw Error(ErrorKind::kUsage,
              target.string() +
                  ": is written as a new folder, and there is something already; "
                  "remove it or give another name");
}

}  // namespace

AtomicFolder::AtomicFolder(const std::filesystem::path& target) : target_(free_target(target)) {
  PartialOutput partial = make_partial(target_, PartialKind::kFolder);
  partial_ = std::move(partial.path);
  lock_ = std::move(partial.file);
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  if (!committed_) std::filesystem::remove_all(partial_, ignored);
}

void AtomicFolder::commit() {
  if (std::rename(partial_.c_str(), target_.c_str()) != 0) {
    fail_output(target_.string(), "rename to", errno);
  }
  committed_ = true;
  lock_ = FileDescriptor();
}

void AtomicFolder::withdraw() {
  std::error_code ignored;
  std::filesystem::remove_all(target_, ignored);
}

}  // namespace mw::io
