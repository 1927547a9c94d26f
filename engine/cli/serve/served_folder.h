// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The files of a folder by the paths of requests, and the part of a file that a request asks for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "io/file/source/file_source.h"

namespace mw::cli {

/// Thread safety: all members may be called from many threads.
class ServedFolder {
 public:
  /// ERRORS: std::filesystem::filesystem_error if there is no such folder.
  explicit ServedFolder(const std::filesystem::path& folder);

  /// Returns the open file; null where the folder has no file of this path, which begins with '/'.
  /// Links are followed only to where they stay in the folder.
  /// ERRORS: mw::Error(kResource) when too many files are open.
  [[nodiscard]] std::shared_ptr<const io::FileSource> open(const std::string& path) const;

 private:
  [[nodiscard]] bool has(const std::filesystem::path& file) const;

  std::filesystem::path root_;  ///< without links
};

/// The bytes [begin, end) of a file.
struct ByteRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;

  [[nodiscard]] std::uint64_t size() const { return end - begin; }
  [[nodiscard]] bool empty() const { return begin == end; }
};

/// Returns which bytes of a file of `size` bytes the header Range asks for: "bytes=FIRST-LAST",
/// "bytes=FIRST-" or "bytes=-COUNT".  They are empty where the file has none of them.  Any other
/// header asks for nothing, as RFC 9110 allows, and the whole file is the answer: one of several
/// ranges, which may ask for the file many times over, and one with a number above 64 bits.
[[nodiscard]] std::optional<ByteRange> asked_range(std::string_view header, std::uint64_t size);

}  // namespace mw::cli
