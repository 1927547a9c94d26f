// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Output files that appear under their names only when they are whole; files that belong together
// appear together.
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

/// Writes to ".<name>.partial-..." beside the target (partial_file.h); commit() gives that file its
/// name in one step.  The destructor removes a partial file that was not committed.
/// ERRORS (all members): mw::Error(kResource) when the disk is full; kUsage when the path cannot be
/// written.  Thread safety: none.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Adds bytes at the end of what was appended before; buffered.
  void append(std::span<const std::byte> bytes);
  void append(std::string_view text);
  /// Appends both texts and the end of their line.
  void append_line(std::string_view line, std::string_view more = {});
  /// Writes bytes at offset, unbuffered, over what was appended there; does not move the place
  /// where append() writes.
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes);
  /// Fills out with the bytes of the file from offset on, and with zeros behind its end.  It sees
  /// what write_at() wrote, but not what append() still buffers.
  void read_at(std::uint64_t offset, std::span<std::byte> out) const;
  /// Cuts or extends the file.
  void resize(std::uint64_t bytes);
  /// Number of bytes appended so far.
  [[nodiscard]] std::uint64_t appended() const { return flushed_ + buffer_.size(); }
  /// Flushes, syncs and renames.  REQUIRES: called once; nothing is written afterwards.
  void commit();

  // The steps of commit(), for files that belong together (commit_together()).

  /// Puts all bytes on the disk.  REQUIRES: nothing is written afterwards.
  void sync();
  /// Removes the file that has the name, be it this one or an older one; its absence is no error.
  /// ENSURES: it stays removed after a power cut.
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

/// Commits all files.  Each may need those before it in the list, so that the one that users open
/// comes last.  All are whole on the disk before the first name changes; then the old files go,
/// from the last to the second, and the new ones get their names from the first to the last.
/// ENSURES: at any instant, also after a kill or a power cut, the names hold the first few files of
/// the old set or the first few of the new one, and never some of both.
/// ERRORS: those of AtomicFile; before the first name changes the old files stay, afterwards none
/// of the new ones is left.
void commit_together(std::initializer_list<std::reference_wrapper<AtomicFile>> files);

/// Files are written into a folder ".<name>.partial-..." beside the target (partial_file.h);
/// commit() gives it its name in one step.  The destructor removes a folder that was not committed.
/// ERRORS (all members): mw::Error(kResource) when the disk is full; kUsage when the folder cannot
/// be made, or exists and is not empty.  Thread safety: none.
class AtomicFolder {
 public:
  explicit AtomicFolder(const std::filesystem::path& target);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// Returns the folder in which the files are until commit().
  [[nodiscard]] const std::filesystem::path& path() const { return partial_; }
  /// REQUIRES: called once; nothing is written afterwards.
  void commit();
  /// Removes the committed folder, for a caller whose other outputs failed.
  /// REQUIRES: commit() was called; nothing else is in it.
  void withdraw();

 private:
  std::filesystem::path target_;
  std::filesystem::path partial_;
  FileDescriptor lock_;
  bool committed_ = false;
};

}  // namespace mw::io
