// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Opens files for reading by region; inflates gzip into a temporary file.
#include "io/file/open_bytes.h"

#include <array>

#include "io/file/errors.h"
#include "io/file/file_source.h"
#include "io/file/inflater.h"
#include "io/file/scratch_file.h"

namespace mw::io {
namespace {

constexpr std::size_t kChunkBytes = 1 << 18;

}  // namespace

bool is_gzip(const ByteSource& source, std::uint64_t offset) {
  std::array<std::byte, 3> magic;
  if (source.size() < offset || source.size() - offset < magic.size()) return false;
  source.read_at(offset, magic);
  return magic == std::array{std::byte{0x1f}, std::byte{0x8b}, std::byte{8}};
}

std::unique_ptr<ByteSource> inflate_bytes(const ByteSource& packed, std::uint64_t offset) {
  if (!is_gzip(packed, offset)) {
    fail_input(packed.name(), "gzip data", "no gzip data at offset " + std::to_string(offset));
  }
  ScratchFile scratch(scratch_folder());
  Inflater inflater(packed, {.offset = offset, .end = packed.size()});
  std::vector<std::byte> buffer(kChunkBytes);
  while (const std::size_t count = inflater.read(buffer)) {
    scratch.append(std::span(buffer).first(count));
  }
  const std::uint64_t total = scratch.size();
  return std::make_unique<FileSource>(scratch.release(), total, packed.name());
}

std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& path) {
  auto file = std::make_unique<FileSource>(path);
  if (file->size() == 0) fail_input(file->name(), {}, "the file is empty", "check how it was made");
  if (is_gzip(*file)) return inflate_bytes(*file, 0);
  return file;
}

}  // namespace mw::io
