// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads numbers word by word.
#include "io/volume/text_voxels.h"

#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/source/file_source.h"
#include "io/file/text_numbers.h"

namespace mw::io {
namespace {

/// No number of a voxel has more characters.
constexpr std::size_t kMaxWord = 400;

bool is_separator(int c) {
  return c == ',' || is_blank(c);
}

/// Reads the next word; an empty one at the end of the text.
std::string next_word(ByteCursor& cursor) {
  while (is_separator(cursor.peek())) cursor.take();
  std::string word;
  while (cursor.peek() >= 0 && !is_separator(cursor.peek()) && word.size() < kMaxWord) {
    word += static_cast<char>(cursor.peek());
    cursor.take();
  }
  return word;
}

template <class T, class Number>
bool append_as(ScratchFile& file, const std::optional<Number>& number) {
  if constexpr (std::is_integral_v<T>) {
    if (!number || !std::in_range<T>(*number)) return false;
  } else if (!number) {
    return false;
  }
  append_little(file, static_cast<T>(*number));
  return true;
}

/// Appends the number of the word; false where it is none of the type.
bool append_number(ScratchFile& file, const std::string& word, VoxelType type) {
  switch (type) {
    case VoxelType::kU8:
      return append_as<std::uint8_t>(file, parse_count(word));
    case VoxelType::kU16:
      return append_as<std::uint16_t>(file, parse_count(word));
    case VoxelType::kU32:
      return append_as<std::uint32_t>(file, parse_count(word));
    case VoxelType::kU64:
      return append_as<std::uint64_t>(file, parse_count(word));
    case VoxelType::kI8:
      return append_as<std::int8_t>(file, parse_integer(word));
    case VoxelType::kI16:
      return append_as<std::int16_t>(file, parse_integer(word));
    case VoxelType::kI32:
      return append_as<std::int32_t>(file, parse_integer(word));
    case VoxelType::kI64:
      return append_as<std::int64_t>(file, parse_integer(word));
    case VoxelType::kF32:
      return append_as<float>(file, parse_real(word));
    case VoxelType::kF64:
      break;
  }
  return append_as<double>(file, parse_real(word));
}

}  // namespace

std::unique_ptr<ByteSource> voxels_of_text(const ByteSource& source, VoxelType type,
                                           std::uint64_t count, std::string_view field) {
  ByteCursor cursor(source);
  ScratchFile file(scratch_folder());
  std::uint64_t found = 0;
  for (std::string word = next_word(cursor); !word.empty(); word = next_word(cursor)) {
    if (found++ == count) {
      fail_input(source.name(), field, text("more than the ", count, " numbers of the volume"),
                 "the shape is wrong");
    }
    if (append_number(file, word, type)) continue;
    fail_input(source.name(), field,
               text("number ", found, ": '", printable(word, 40), "' is no ", name(type)),
               "the file is damaged, or the type is wrong");
  }
  if (found < count) {
    fail_input(source.name(), field, text("holds ", found, " numbers, the volume has ", count),
               "the file is truncated or the shape is wrong");
  }
  const std::uint64_t bytes = file.size();
  return std::make_unique<FileSource>(file.release(), bytes, source.name());
}

}  // namespace mw::io
