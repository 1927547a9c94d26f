// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The files of a folder by the paths of requests, and their parts.
#include "engine/cli/serve/served_folder.h"

#include <algorithm>

#include "engine/settings/number_text.h"
#include "kernels/core/error.h"

namespace mw::cli {

ServedFolder::ServedFolder(const std::filesystem::path& folder)
    : root_(std::filesystem::canonical(folder)) {}

std::shared_ptr<const io::FileSource> ServedFolder::open(const std::string& path) const {
  // What is behind a NUL would be dropped by the system, which then opens another file.
  if (path.find('\0') != path.npos) return nullptr;
  std::error_code failed;
  const std::filesystem::path file =
      std::filesystem::canonical(root_.string() + "/" + path, failed);
  if (failed || !has(file)) return nullptr;
  try {
    return std::make_shared<io::FileSource>(file);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInput) return nullptr;  // a folder, or not to be read
    throw;
  }
}

bool ServedFolder::has(const std::filesystem::path& file) const {
  return std::mismatch(root_.begin(), root_.end(), file.begin(), file.end()).first == root_.end();
}

std::optional<ByteRange> asked_range(std::string_view header, std::uint64_t size) {
  constexpr std::string_view kUnit = "bytes=";
  const std::size_t dash = header.find('-');
  if (!header.starts_with(kUnit) || dash == header.npos) return std::nullopt;
  const std::string_view first = header.substr(kUnit.size(), dash - kUnit.size());
  const std::string_view last = header.substr(dash + 1);
  std::uint64_t from = 0, to = 0;
  if (!last.empty() && !engine::read_number(last, to)) return std::nullopt;
  if (first.empty()) {
    if (last.empty()) return std::nullopt;
    return ByteRange{size - std::min(to, size), size};
  }
  if (!engine::read_number(first, from)) return std::nullopt;
  if (!last.empty() && to < from) return std::nullopt;
  const std::uint64_t end = last.empty() || to >= size ? size : to + 1;
  return ByteRange{std::min(from, end), end};
}

}  // namespace mw::cli
