// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The files in which an NRRD volume has its voxels, and the bytes in them.
#include <algorithm>

#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/file/text_numbers.h"
#include "io/volume/nrrd/open_nrrd.h"
#include "io/volume/numbered_name.h"
#include "io/volume/text_voxels.h"

namespace mw::io {
namespace {

constexpr const char* kDataFile = "NRRD field 'data file'";
constexpr std::int64_t kMaxDataFiles = 1 << 20;

std::vector<std::string> names_of_lines(std::string_view lines) {
  std::vector<std::string> out;
  for (const std::string_view line : split_at('\n', lines)) {
    if (!trimmed(line).empty()) out.emplace_back(trimmed(line));
  }
  return out;
}

/// Returns the numbers behind a pattern, or the number of axes behind "LIST".
std::vector<std::int64_t> numbers_behind(const std::vector<std::string_view>& words,
                                         std::string_view file) {
  std::vector<std::int64_t> out;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto number = io::parse_integer(words[i]);
    constexpr std::int64_t kMost = 1'000'000'000;
    if (!number || *number < -kMost || *number > kMost) {
      fail_input(file, kDataFile, text("'", printable(words[i], 40), "' is no number"),
                 "correct the header");
    }
    out.push_back(*number);
  }
  return out;
}

/// Returns the names of "PATTERN MIN MAX STEP".
std::vector<std::string> names_of_pattern(std::string_view pattern,
                                          const std::vector<std::int64_t>& numbers,
                                          std::string_view file) {
  const NumberedName name(pattern, file, kDataFile);
  const auto fail = [&] {
    fail_input(file, kDataFile, "a pattern needs the first, the last and the step of its numbers",
               "give it as in slice%03d.raw 1 20 1");
  };
  if (numbers.size() < 3 || numbers.size() > 4 || numbers[2] == 0) fail();
  const std::int64_t steps = (numbers[1] - numbers[0]) / numbers[2];
  if (steps < 0 || steps >= kMaxDataFiles || numbers[0] < 0 || numbers[1] < 0) fail();
  std::vector<std::string> out;
  for (std::int64_t i = 0; i <= steps; ++i) out.push_back(name.with(numbers[0] + i * numbers[2]));
  return out;
}

/// Checks that the files, with their axes, make the volume.
void check_count(std::size_t files, std::int64_t axes, const std::vector<std::int64_t>& sizes,
                 std::string_view file) {
  const auto rank = static_cast<std::int64_t>(sizes.size());
  const auto count = static_cast<std::int64_t>(files);
  bool fits = axes >= 1 && axes <= rank && count > 0;
  if (fits && axes == rank) {
    fits = sizes.back() % count == 0;
  } else if (fits) {
    std::int64_t left = count;
    for (std::int64_t axis = axes; axis < rank; ++axis) {
      const std::int64_t size = sizes[static_cast<std::size_t>(axis)];
      fits = fits && size > 0 && left % size == 0;
      left = fits ? left / size : left;
    }
    fits = fits && left == 1;
  }
  if (fits) return;
  fail_input(file, kDataFile,
             text(files, " files of ", axes, " axes do not make the sizes of the volume"),
             "list one file for each slice, or say how many axes a file has");
}

std::unique_ptr<ByteSource> open_data_file(const std::string& header, const std::string& name,
                                           bool is_trusted) {
  return std::make_unique<FileSource>(named_beside(header, kDataFile, name, is_trusted));
}

/// Returns a file's voxels unpacked.
std::unique_ptr<ByteSource> unpacked_file(std::unique_ptr<ByteSource> source, std::uint64_t offset,
                                          const NrrdHeader& header, std::uint64_t bytes) {
  if (header.encoding == NrrdEncoding::kGzip) {
    return std::make_unique<InflatedSource>(std::move(source), offset);
  }
  const std::uint64_t first = offset + static_cast<std::uint64_t>(header.byte_skip);
  const std::shared_ptr<const ByteSource> shared = std::move(source);
  const std::uint64_t size = shared->size();
  const std::uint64_t begin = std::min(first, size);
  const BytesPart words(shared, begin, size - begin, shared->name());
  return voxels_of_text(words, header.type,
                        bytes / static_cast<std::uint64_t>(byte_size(header.type)), "voxel data");
}

/// Returns the voxels of many files, unpacked and joined.
std::unique_ptr<ByteSource> joined_files(const std::string& file, const NrrdHeader& header,
                                         std::uint64_t piece, bool is_trusted) {
  constexpr std::uint64_t kBufferBytes = 1 << 20;
  const bool is_gzip = header.encoding == NrrdEncoding::kGzip;
  const std::uint64_t skip = is_gzip ? static_cast<std::uint64_t>(header.byte_skip) : 0;
  ScratchFile scratch(scratch_folder());
  std::vector<std::byte> buffer;
  for (const std::string& name : header.data_files) {
    const auto part = unpacked_file(open_data_file(file, name, is_trusted), 0, header, piece);
    for (std::uint64_t done = 0; done < piece; done += buffer.size()) {
      buffer.resize(std::min(kBufferBytes, piece - done));
      part->read_at(skip + done, buffer);
      scratch.append(buffer);
    }
  }
  const std::uint64_t bytes = scratch.size();
  return std::make_unique<FileSource>(scratch.release(), bytes, file);
}

NrrdVoxels voxels_of_many(const std::string& file, const NrrdHeader& header, std::uint64_t bytes,
                          bool is_trusted) {
  const std::uint64_t piece = bytes / header.data_files.size();
  if (header.encoding != NrrdEncoding::kRaw) {
    return {joined_files(file, header, piece, is_trusted), 0};
  }
  std::vector<std::filesystem::path> paths;
  for (const std::string& name : header.data_files) {
    paths.push_back(named_beside(file, kDataFile, name, is_trusted));
  }
  return {std::make_unique<JoinedFiles>(std::move(paths), header.byte_skip, piece, file), 0};
}

}  // namespace

bool is_nrrd_list(std::string_view value) {
  const auto words = words_of(value);
  return !words.empty() && words[0] == "LIST";
}

std::vector<std::string> nrrd_data_files(const std::string& value, std::string_view list,
                                         const std::vector<std::int64_t>& sizes,
                                         std::string_view file) {
  const auto words = words_of(value);
  const bool is_pattern = value.find('%') != std::string::npos && words.size() > 1;
  if (!is_nrrd_list(value) && !is_pattern) return {value};
  const std::vector<std::int64_t> numbers = numbers_behind(words, file);
  const std::vector<std::string> names =
      is_pattern ? names_of_pattern(words[0], numbers, file) : names_of_lines(list);
  const std::size_t before_axes = is_pattern ? 3 : 0;
  const std::int64_t axes = numbers.size() > before_axes
                                ? numbers[before_axes]
                                : static_cast<std::int64_t>(sizes.size()) - 1;
  check_count(names.size(), axes, sizes, file);
  return names;
}

NrrdVoxels find_nrrd_voxels(std::unique_ptr<ByteSource> source, const NrrdHeader& header,
                            std::uint64_t bytes, bool is_trusted) {
  const std::string file = source->name();
  if (header.data_files.size() > 1) return voxels_of_many(file, header, bytes, is_trusted);
  NrrdVoxels out{std::move(source), header.bytes};
  if (!header.data_files.empty()) {
    out = {open_data_file(file, header.data_files.front(), is_trusted), 0};
  }
  if (header.encoding != NrrdEncoding::kRaw) {
    out = {unpacked_file(std::move(out.source), out.offset, header, bytes), 0};
  }
  if (header.encoding == NrrdEncoding::kText) return out;
  if (header.byte_skip > 0) out.offset += static_cast<std::uint64_t>(header.byte_skip);
  if (header.byte_skip == -1) {
    const std::uint64_t size = out.source->size();
    if (size >= out.offset + bytes) out.offset = size - bytes;
  }
  return out;
}

}  // namespace mw::io
