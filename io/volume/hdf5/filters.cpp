// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The filters of HDF5, by their registered numbers.
#include "io/volume/hdf5/filters.h"

#include <algorithm>
#include <array>
#include <string>

#include "io/codec/checksums.h"
#include "io/codec/codec.h"
#include "io/codec/unpackers.h"
#include "io/file/errors.h"

namespace mw::io {
namespace {

enum FilterId : std::uint32_t {
  kDeflate = 1,
  kShuffle = 2,
  kFletcher32 = 3,
  kLzf = 32000,
  kBlosc = 32001,
  kLz4 = 32004,
  kZstd = 32015,
};
constexpr std::array kKnown{kDeflate, kShuffle, kFletcher32, kLzf, kBlosc, kLz4, kZstd};
constexpr std::size_t kChecksumBytes = 4;

/// Filters that files may have but that are not read here.
struct OtherFilter {
  std::uint32_t id;
  const char* name;
};
constexpr std::array<OtherFilter, 6> kOthers{{{4, "szip"},
                                              {5, "nbit"},
                                              {6, "scaleoffset"},
                                              {307, "bzip2"},
                                              {32008, "bitshuffle"},
                                              {32013, "zfp"}}};

std::string filter_text(std::uint32_t id) {
  for (const OtherFilter& other : kOthers) {
    if (other.id == id) return text("filter ", id, " (", other.name, ")");
  }
  return text("filter ", id);
}

/// Byte k of all elements, for every k, becomes elements again; bytes of no whole element are last.
std::vector<std::byte> unshuffle(const std::vector<std::byte>& bytes, std::size_t size) {
  const std::size_t count = size == 0 ? 0 : bytes.size() / size;
  std::vector<std::byte> out(bytes);
  for (std::size_t k = 0; k < size && count > 1; ++k) {
    for (std::size_t i = 0; i < count; ++i) out[i * size + k] = bytes[k * count + i];
  }
  return out;
}

/// The checksum is behind the data, least significant byte first.
std::vector<std::byte> without_checksum(std::vector<std::byte> bytes, std::string_view name) {
  if (bytes.size() < kChecksumBytes) {
    fail_input(name, "fletcher32", "truncated: no checksum", "get a whole copy of the file");
  }
  const std::size_t length = bytes.size() - kChecksumBytes;
  const auto kept = load<std::uint32_t>(bytes.data() + length, ByteOrder::kLittle);
  bytes.resize(length);
  if (fletcher32(bytes) != kept) {
    fail_input(name, "fletcher32", "the checksum is wrong: the chunk is damaged",
               "get a whole copy of the file");
  }
  return bytes;
}

std::vector<std::byte> undo(const Hdf5Filter& filter, std::vector<std::byte> bytes, std::size_t max,
                            std::string_view name) {
  switch (filter.id) {
    case kDeflate:
      return unpack(Codec::kZlib, bytes, max, name);
    case kShuffle:
      return filter.parameters.empty() ? bytes : unshuffle(bytes, filter.parameters[0]);
    case kFletcher32:
      return without_checksum(std::move(bytes), name);
    case kLzf:
      return unpack_lzf(bytes, max, name);
    case kBlosc:
      return unpack(Codec::kBlosc, bytes, max, name);
    case kLz4:
      return unpack_lz4_hdf5(bytes, max, name);
    default:
      return unpack(Codec::kZstd, bytes, max, name);
  }
}

}  // namespace

void check_filters(const Hdf5Description& description, std::string_view file) {
  for (const Hdf5Filter& filter : description.filters) {
    if (std::find(kKnown.begin(), kKnown.end(), filter.id) != kKnown.end()) continue;
    fail_input(file, text("data set ", description.path),
               text("packed by ", filter_text(filter.id), ", which is not read here"),
               "pack it anew: h5repack -f GZIP=4 IN OUT");
  }
}

std::vector<std::byte> unfilter(const std::vector<Hdf5Filter>& filters,
                                std::vector<std::byte> stored, const Unfiltering& wanted) {
  // Checksums may be packed with the voxels.
  const auto checksums = std::count_if(filters.begin(), filters.end(),
                                       [](const auto& filter) { return filter.id == kFletcher32; });
  const std::size_t max = wanted.bytes + kChecksumBytes * static_cast<std::size_t>(checksums);
  for (std::size_t i = filters.size(); i > 0; --i) {
    const bool skipped = i <= 32 && ((wanted.skipped >> (i - 1)) & 1U) != 0;
    if (!skipped) stored = undo(filters[i - 1], std::move(stored), max, wanted.name);
  }
  if (stored.size() != wanted.bytes) {
    fail_input(wanted.name, {},
               text("holds ", stored.size(), " bytes, its voxels need ", wanted.bytes),
               "the file is damaged: get a whole copy of it");
  }
  return stored;
}

std::uint64_t max_unfilter_scratch(const std::vector<Hdf5Filter>& filters, std::size_t bytes) {
  std::uint64_t max = 0;
  for (const Hdf5Filter& filter : filters) {
    const Codec codec = filter.id == kBlosc  ? Codec::kBlosc
                        : filter.id == kZstd ? Codec::kZstd
                                             : Codec::kZlib;
    max = std::max(max, bytes + max_scratch(codec, bytes));
  }
  return max;
}

}  // namespace mw::io
