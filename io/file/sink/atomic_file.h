// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Output files that appear under their names only when they are whole, those that belong together
// at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

#include "io/file/file_descriptor.h"
#include "io/file/sink/partial_file.h"

namespace mw::io {

/// Writes to ".<name>.partial-..." beside the target (partial_file.h); commit() gives it its name
/// in one step. The destructor of a file that was not committed removes the partial one. ERRORS
/// (all members): mw::Error(kResource) when the disk is full; kUsage when the path cannot be
/// written.  Thread safety: none.
class AtomicFile : public PlacedOutput {
 public:
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile() override;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Adds bytes at the end of what was appended before; buffered.
  void append(std::span<const std::byte> bytes);
  void append(std::string_view text);
  /// Writes bytes at offset, unbuffered, over what was appended there; does not move the place
  /// where append() writes.
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes) override;
  /// What is in the file there; zeros behind its end.  Sees what write_at() wrote, not what
  /// append() still buffers.
  void read_at(std::uint64_t offset, std::span<std::byte> out) const;
  /// Cuts or extends the file.
  void resize(std::uint64_t bytes);
  /// Where it is until it has its name, for others to write into (JoinedPartial).
  [[nodiscard]] const std::filesystem::path& partial() const { return partial_; }
  /// Number of bytes appended so far.
  [[nodiscard]] std::uint64_t appended() const { return flushed_ + buffer_.size(); }
  /// Flushes, syncs and renames.  REQUIRES: called once; nothing is written afterwards.
  void commit();

  // The steps of commit(), for files that belong together (commit_together.h).

  /// All bytes are on the disk.  REQUIRES: nothing is written afterwards.
  void sync();
  /// Removes what has the name, be it this file or the one before it; none is no error.
  /// ENSURES: also after a power cut.
  void remove_named();
  /// REQUIRES: sync() was called; called once.
  void give_name();

 private:
  void flush();
  void write(std::uint64_t offset, std::span<const std::byte> bytes);

  std::filesystem::path target_;
  std::filesystem::path partial_;
  FileDescriptor file_;
  std::vector<std::byte> buffer_;
  std::uint64_t flushed_ = 0;
  bool committed_ = false;
};

/// Commits all, in an order in which each may need those before it: what is opened by its name
/// comes last.  All are whole on the disk before the first name changes; then the old files go,
/// from the last to the second, and the new ones get their names from the first to the last.
/// ENSURES: at any instant, also after a kill or a power cut, the names hold the first few files of
/// the old set or the first few of the new one, and never some of both.
/// ERRORS: those of AtomicFile; before the first name changes the old files stay, afterwards none
/// of the new ones is left.
void commit_together(std::initializer_list<std::reference_wrapper<AtomicFile>> files);

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
