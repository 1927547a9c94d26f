// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A file that another process makes and this one writes into.
#pragma once

#include <filesystem>

#include "io/file/file_descriptor.h"
#include "io/file/placed_output.h"

namespace mw::io {

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
