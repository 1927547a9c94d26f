// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A folder of files out of one run of bytes, for formats that are more than one file.
#pragma once

#include <algorithm>
#include <cctype>

#include "tests/fuzz/target.h"
#include "tests/temp_folder.h"

namespace mw::fuzz {

/// Each file begins with a line "@@ PATH", up to the next such line or the end; the line end in
/// front of that belongs to it.  Files of odd names are left out, so that nothing is written
/// outside the folder.  The folder goes away with the object.
class FileTree {
 public:
  explicit FileTree(Bytes bytes) {
    const std::string_view text = text_of(bytes);
    std::size_t at = next_mark(text, 0);
    for (std::size_t files = 0; at != text.npos && files < kMaxFiles; ++files) {
      const std::size_t line_end = std::min(text.find('\n', at), text.size());
      const std::size_t next = next_mark(text, line_end);
      const std::size_t begin = std::min(line_end + 1, text.size());
      const std::size_t end = next == text.npos ? text.size() : std::max(begin, next - 1);
      add(text.substr(at + kMark.size(), line_end - at - kMark.size()),
          text.substr(begin, end - begin));
      at = next;
    }
  }

  [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }

 private:
  static constexpr std::string_view kMark = "@@ ";
  static constexpr std::size_t kMaxFiles = 16;

  /// Where the next mark that begins a line is, from `from` on.
  static std::size_t next_mark(std::string_view text, std::size_t from) {
    for (std::size_t at = text.find(kMark, from); at != text.npos; at = text.find(kMark, at + 1)) {
      if (at == 0 || text[at - 1] == '\n') return at;
    }
    return text.npos;
  }

  static bool is_plain(std::string_view name) {
    const auto is_plain_character = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
             std::string_view("._-/").find(c) != std::string_view::npos;
    };
    return !name.empty() && name.size() <= 60 && name.front() != '/' && name.back() != '/' &&
           name.find("..") == name.npos &&
           std::all_of(name.begin(), name.end(), is_plain_character);
  }

  void add(std::string_view name, std::string_view content) const {
    if (!is_plain(name)) return;
    const std::filesystem::path path = folder_.path() / name;
    std::error_code ignored;
    std::filesystem::create_directories(path.parent_path(), ignored);
    std::ofstream(path, std::ios::binary)
        .write(content.data(), static_cast<std::streamsize>(content.size()));
  }

  test::TempFolder folder_;
};

}  // namespace mw::fuzz
