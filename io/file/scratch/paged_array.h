// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An array in a temporary file, whose records are read and changed by their place.
#pragma once

#include <algorithm>
#include <vector>

#include "io/file/scratch/scratch_file.h"

namespace mw::io {

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
  /// REQUIRES: at < size(), also for change().
  [[nodiscard]] Record get(std::uint64_t at) { return page_of(at).records[at % kPageRecords]; }
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
