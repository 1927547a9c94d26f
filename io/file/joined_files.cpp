// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pieces of many files, read as if they were one.
#include "io/file/joined_files.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/file/file_source.h"

namespace mw::io {

JoinedFiles::JoinedFiles(std::vector<std::filesystem::path> files, std::int64_t skip,
                         std::uint64_t piece_bytes, std::string name)
    : files_(std::move(files)), skip_(skip), piece_bytes_(piece_bytes), name_(std::move(name)) {
  for (const std::filesystem::path& path : files_) {
    static_cast<void>(first_byte(FileSource(path)));
  }
}

std::uint64_t JoinedFiles::first_byte(const ByteSource& file) const {
  const std::uint64_t front = skip_ < 0 ? 0 : static_cast<std::uint64_t>(skip_);
  if (file.size() < front || file.size() - front < piece_bytes_) {
    fail_input(file.name(), "voxel data",
               text("needs ", piece_bytes_, " bytes after offset ", front, ", the file holds ",
                    file.size()),
               "the file is truncated or the shape or type is wrong");
  }
  return skip_ < 0 ? file.size() - piece_bytes_ : front;
}

void JoinedFiles::read_at(std::uint64_t offset, std::span<std::byte> out) const {
  while (!out.empty()) {
    const std::uint64_t number = offset / piece_bytes_;
    const std::uint64_t inside = offset % piece_bytes_;
    if (number >= files_.size()) fail_input(name_, "voxel data", "read behind the last file");
    const FileSource file(files_[number]);
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), piece_bytes_ - inside));
    file.read_at(first_byte(file) + inside, out.first(count));
    offset += count;
    out = out.subspan(count);
  }
}

}  // namespace mw::io
