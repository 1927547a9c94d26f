// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Temporary files without a name, for data that must not stay in memory.  They are written at their
// end or anywhere, and read by place, also as a long list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "io/file/file_descriptor.h"

namespace mw::io {

/// How the name of a file begins where the file system can make none without a name.  The file
/// loses that name at once; only a kill in that instant leaves it behind.
inline constexpr const char* kScratchPrefix = ".mwmesh-scratch-";

/// A file without a name, written and read by place.
/// ERRORS (all members): mw::Error(kResource) naming the folder when the disk is full; kUsage when
/// the folder cannot be written.  Thread safety: different places may be used at once.
class UnlinkedFile {
 public:
  /// REQUIRES: an existing folder.
  explicit UnlinkedFile(const std::filesystem::path& folder);

  void write_at(std::uint64_t offset, std::span<const std::byte> bytes) const;
  /// REQUIRES: these bytes were written.
  void read_at(std::uint64_t offset, std::span<std::byte> out) const;
  /// Gives the disk back what lies in this range, as far as the file system can; reads of it give
  /// anything from then on.
  void give_up(std::uint64_t offset, std::uint64_t bytes) const;
  /// Returns the file itself.  REQUIRES: the object is not used afterwards.
  [[nodiscard]] FileDescriptor release() { return std::move(file_); }

 private:
  std::string folder_;
  FileDescriptor file_;
};

/// Returns $TMPDIR, or /tmp when it is not set.
[[nodiscard]] std::filesystem::path scratch_folder();

/// A file to which bytes are appended, and which is read by place.  Its space is free again when
/// the object is destroyed or the process ends, however it does.
/// ERRORS (all members): mw::Error(kResource) naming the folder when the disk is full; kUsage when
/// the folder cannot be written.  Thread safety: several threads may read at once after flush(), or
/// after a read, until more is appended.
class ScratchFile {
 public:
  /// REQUIRES: an existing folder.
  explicit ScratchFile(const std::filesystem::path& folder) : file_(folder) {}

  void append(std::span<const std::byte> bytes);
  void append(std::string_view text) { append(std::as_bytes(std::span(text))); }
  [[nodiscard]] std::uint64_t size() const { return flushed_ + buffer_.size(); }
  /// Puts what was appended into the file.
  void flush();
  /// REQUIRES: offset + out.size() <= size().
  void read_at(std::uint64_t offset, std::span<std::byte> out);
  /// Calls visit(std::span<const Record>) on all records in their order, some thousands at once.
  /// REQUIRES: only records of this type were appended.
  template <typename Record, class Visit>
  void each_batch(Visit visit) {
    constexpr std::uint64_t kBatch = 4096;
    std::vector<Record> batch;
    for (std::uint64_t at = 0; at < size(); at += batch.size() * sizeof(Record)) {
      batch.resize(std::min(kBatch, (size() - at) / sizeof(Record)));
      read_at(at, std::as_writable_bytes(std::span(batch)));
      visit(std::span<const Record>(batch));
    }
  }
  /// Appends `bytes` bytes from `offset` on to another file.  REQUIRES: that many bytes are there.
  template <class File>
  void copy_to(File& file, std::uint64_t offset, std::uint64_t bytes) {
    constexpr std::uint64_t kBatch = 1 << 18;
    std::vector<std::byte> batch;
    for (std::uint64_t done = 0; done < bytes; done += batch.size()) {
      batch.resize(std::min(kBatch, bytes - done));
      read_at(offset + done, batch);
      file.append(batch);
    }
  }
  /// See UnlinkedFile.  REQUIRES: all of the range was read since it was appended.
  void give_up(std::uint64_t offset, std::uint64_t bytes) const { file_.give_up(offset, bytes); }
  /// Returns the file itself with all bytes in it.  REQUIRES: the object is not used afterwards.
  [[nodiscard]] FileDescriptor release();

 private:
  void write(std::span<const std::byte> bytes);

  UnlinkedFile file_;
  std::vector<std::byte> buffer_;
  std::uint64_t flushed_ = 0;
};

/// Pages of a file of records that were read last.
/// Memory: 4 KiB for each of the pages, once they are used.  ERRORS: see ScratchFile.
/// Thread safety: none, but several may read one file, if nothing of it waits to be written.
template <typename Record, std::size_t kPages>
class RecordPages {
  static_assert(std::is_trivially_copyable_v<Record>);

 public:
  RecordPages() : pages_(kPages), held_(kPages, kNone) {}

  /// REQUIRES: the file, always the same one, has a record of this number.
  [[nodiscard]] const Record& at(ScratchFile& file, std::uint64_t number) {
    const std::uint64_t page = number / kPageRecords;
    const std::size_t slot = page % kPages;
    if (held_[slot] != page) load(file, page, slot);
    return pages_[slot][number % kPageRecords];
  }
  /// Must be called where the record changes, or comes to be.
  void forget(std::uint64_t number) {
    const std::uint64_t page = number / kPageRecords;
    if (held_[page % kPages] == page) held_[page % kPages] = kNone;
  }

 private:
  static constexpr std::size_t kPageRecords = 4096 / sizeof(Record);
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};

  void load(ScratchFile& file, std::uint64_t page, std::size_t slot) {
    const std::uint64_t first = page * kPageRecords;
    const std::uint64_t size = file.size() / sizeof(Record);
    pages_[slot].resize(std::min<std::uint64_t>(kPageRecords, size - first));
    file.read_at(first * sizeof(Record), std::as_writable_bytes(std::span(pages_[slot])));
    held_[slot] = page;
  }

  std::vector<std::vector<Record>> pages_;
  std::vector<std::uint64_t> held_;  ///< the page in each slot
};

/// Records are appended, and looked up through a cache of pages, which is fast where neighbours are
/// asked for together.  Memory: 4 KiB for each of the pages, once they are used.
/// ERRORS: see ScratchFile.
template <typename Record, std::size_t kPages = 2048>
class PagedFile {
 public:
  /// REQUIRES: an existing folder.
  explicit PagedFile(const std::filesystem::path& folder) : file_(folder) {}

  void append(const Record& record) {
    pages_.forget(size());
    file_.append(std::as_bytes(std::span(&record, 1)));
  }
  [[nodiscard]] std::uint64_t size() const { return file_.size() / sizeof(Record); }
  /// Returns the file, for several threads to read once it is flushed.
  [[nodiscard]] ScratchFile& file() { return file_; }
  /// Calls visit(std::span<const Record>) on all records in their order, some thousands at once.
  template <class Visit>
  void each_batch(Visit visit) {
    file_.template each_batch<Record>(visit);
  }
  /// REQUIRES: at < size().
  [[nodiscard]] Record operator[](std::uint64_t at) { return pages_.at(file_, at); }

 private:
  ScratchFile file_;
  RecordPages<Record, kPages> pages_;
};

/// Records whose bytes are all zero at first.  Access is fast where neighbours are asked for
/// together.
/// Memory: 8 MiB.  ERRORS: see ScratchFile.  Thread safety: none.
template <typename Record>
class PagedArray {
  static_assert(std::is_trivially_copyable_v<Record> && sizeof(Record) <= 4096);

 public:
  /// REQUIRES: an existing folder.
  PagedArray(const std::filesystem::path& folder, std::uint64_t size)
      : file_(folder), size_(size), pages_(kPages) {
    // A file has zeros where nothing was written.
    constexpr std::byte kLast{0};
    const std::uint64_t bytes = (size / kPageRecords + 1) * kPageRecords * sizeof(Record);
    file_.write_at(bytes - 1, std::span(&kLast, 1));
  }

  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// REQUIRES: at < size(), also for set() and change().
  [[nodiscard]] Record get(std::uint64_t at) { return page_of(at).records[at % kPageRecords]; }
  void set(std::uint64_t at, const Record& record) {
    change(at, [&](Record& place) { place = record; });
  }
  /// Calls change(Record&).  REQUIRES: change uses no member of this array.
  template <class Change>
  void change(std::uint64_t at, Change change) {
    Page& page = page_of(at);
    page.is_changed = true;
    change(page.records[at % kPageRecords]);
  }

 private:
  static constexpr std::uint64_t kPageRecords = 4096 / sizeof(Record);
  static constexpr std::uint64_t kPages = 2048;
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};

  struct Page {
    std::uint64_t number = kNone;
    bool is_changed = false;
    std::vector<Record> records{};
  };

  [[nodiscard]] static std::uint64_t place_of(std::uint64_t page) {
    return page * kPageRecords * sizeof(Record);
  }

  Page& page_of(std::uint64_t at) {
    const std::uint64_t number = at / kPageRecords;
    Page& page = pages_[number % kPages];
    if (page.number == number) return page;
    if (page.is_changed) {
      file_.write_at(place_of(page.number), std::as_bytes(std::span(page.records)));
    }
    page.number = number;
    page.is_changed = false;
    page.records.resize(kPageRecords);
    file_.read_at(place_of(number), std::as_writable_bytes(std::span(page.records)));
    return page;
  }

  UnlinkedFile file_;
  std::uint64_t size_;
  std::vector<Page> pages_;
};

}  // namespace mw::io
