// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens files for reading by region, whether they are gzipped or not.
#include "io/file/open_bytes.h"

#include <array>

#include "io/file/errors.h"
#include "io/file/file_source.h"
#include "io/file/inflated_source.h"

namespace mw::io {

bool is_gzip(const ByteSource& source, std::uint64_t offset) {
  std::array<std::byte, 3> magic;
  const std::uint64_t end = offset + magic.size();
  if (end < offset || source.size_within(end) < end) return false;
  source.read_at(offset, magic);
  return magic == std::array{std::byte{0x1f}, std::byte{0x8b}, std::byte{8}};
}

std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& path) {
  auto file = std::make_unique<FileSource>(path);
  if (file->size() == 0) fail_input(file->name(), {}, "the file is empty", "check how it was made");
  if (is_gzip(*file)) return std::make_unique<InflatedSource>(std::move(file), 0);
  return file;
}

}  // namespace mw::io
