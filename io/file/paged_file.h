// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A long list in a temporary file, looked up in any order.
#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "io/file/scratch_file.h"

namespace mw::io {

/// Records are appended, and looked up through a cache of pages: fast where neighbours are asked
/// for together.  Memory: 8 MiB.  ERRORS: see ScratchFile.
template <typename Record>
class PagedFile {
  static_assert(std::is_trivially_copyable_v<Record>);

 public:
  /// REQUIRES: an existing folder.
  explicit PagedFile(const std::filesystem::path& folder)
      : file_(folder), pages_(kPages), held_(kPages, kNone) {}

  void append(const Record& record) {
    // The page that it goes to is no longer what the cache may hold of it.
    const std::uint64_t page = size() / kPageRecords;
    if (held_[page % kPages] == page) held_[page % kPages] = kNone;
    file_.append(std::as_bytes(std::span(&record, 1)));
  }
  [[nodiscard]] std::uint64_t size() const { return file_.size() / sizeof(Record); }
  /// REQUIRES: at < size().
  [[nodiscard]] Record operator[](std::uint64_t at) {
    const std::uint64_t page = at / kPageRecords;
    const std::size_t slot = page % kPages;
    if (held_[slot] != page) load(page, slot);
    return pages_[slot][at % kPageRecords];
  }

 private:
  static constexpr std::size_t kPageRecords = 4096 / sizeof(Record);
  static constexpr std::size_t kPages = 2048;
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};

  void load(std::uint64_t page, std::size_t slot) {
    const std::uint64_t first = page * kPageRecords;
    pages_[slot].resize(std::min<std::uint64_t>(kPageRecords, size() - first));
    file_.read_at(first * sizeof(Record), std::as_writable_bytes(std::span(pages_[slot])));
    held_[slot] = page;
  }

  ScratchFile file_;
  std::vector<std::vector<Record>> pages_;
  std::vector<std::uint64_t> held_;  ///< by slot: its page
};

}  // namespace mw::io
