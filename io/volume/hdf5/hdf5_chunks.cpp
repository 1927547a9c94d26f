// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads chunks of an HDF5 data set, and undoes what its filters did to them.
#include "io/volume/hdf5/open_hdf5.h"

#include <algorithm>
#include <array>
#include <string>

#include "io/codec/checksums.h"
#include "io/codec/codec.h"
#include "io/file/errors.h"
#include "io/file/scratch/scratch_file.h"
#include "io/file/source/file_source.h"
#include "io/volume/checks.h"
#include "io/volume/hdf5/description.h"

namespace mw::io {
namespace {

enum FilterId : std::uint32_t { kShuffle = 2, kFletcher32 = 3 };

struct FilterCodec {
  std::uint32_t id;
  Codec codec;
};
constexpr std::array<FilterCodec, 6> kFilterCodecs{{{1, Codec::kZlib},
                                                    {307, Codec::kBzip2},
                                                    {32000, Codec::kLzf},
                                                    {32001, Codec::kBlosc},
                                                    {32004, Codec::kLz4Hdf5},
                                                    {32015, Codec::kZstd}}};
constexpr std::size_t kChecksumBytes = 4;

std::optional<Codec> codec_of(const Hdf5Filter& filter) {
  const auto* const found = std::ranges::find(kFilterCodecs, filter.id, &FilterCodec::id);
  return found == kFilterCodecs.end() ? std::nullopt : std::optional(found->codec);
}

/// Filters that files may have but that are not read here.
struct OtherFilter {
  std::uint32_t id;
  const char* name;
};
constexpr std::array<OtherFilter, 5> kOthers{
    {{4, "szip"}, {5, "nbit"}, {6, "scaleoffset"}, {32008, "bitshuffle"}, {32013, "zfp"}}};

std::string filter_text(std::uint32_t id) {
  for (const OtherFilter& other : kOthers) {
    if (other.id == id) return text("filter ", id, " (", other.name, ")");
  }
  return text("filter ", id);
}

/// Undoes shuffle, which puts byte k of all elements in a row; bytes of no whole one stay last.
std::vector<std::byte> unshuffle(const std::vector<std::byte>& bytes, std::size_t size) {
  const std::size_t count = size == 0 ? 0 : bytes.size() / size;
  std::vector<std::byte> out(bytes);
  for (std::size_t k = 0; k < size && count > 1; ++k) {
    for (std::size_t i = 0; i < count; ++i) out[i * size + k] = bytes[k * count + i];
  }
  return out;
}

/// Checks and removes the checksum behind the data, least significant byte first.
std::vector<std::byte> without_checksum(std::vector<std::byte> bytes, std::string_view name) {
  const PackedName named{"fletcher32", name};
  if (bytes.size() < kChecksumBytes) fail_packed(named, "truncated: no whole checksum");
  const std::size_t length = bytes.size() - kChecksumBytes;
  const auto kept = load<std::uint32_t>(bytes.data() + length, ByteOrder::kLittle);
  bytes.resize(length);
  if (fletcher32(bytes) != kept) fail_packed(named, "damaged: the checksum is wrong");
  return bytes;
}

std::vector<std::byte> undo(const Hdf5Filter& filter, std::vector<std::byte> bytes, std::size_t max,
                            std::string_view name) {
  if (filter.id == kShuffle) return unshuffle(bytes, filter.parameter);
  if (filter.id == kFletcher32) return without_checksum(std::move(bytes), name);
  return unpack(*codec_of(filter), bytes, max, name);
}

}  // namespace

void check_filters(const Hdf5Description& description, std::string_view file) {
  for (const Hdf5Filter& filter : description.filters) {
    if (filter.id == kShuffle || filter.id == kFletcher32 || codec_of(filter)) continue;
    fail_input(file, text("data set ", description.path),
               text("packed by ", filter_text(filter.id), ", which is not read here"),
               "pack it anew: h5repack -f GZIP=4 IN OUT");
  }
}

namespace {

void check_size(std::uint64_t bytes, const Unfiltering& wanted) {
  if (bytes == wanted.bytes) return;
  fail_input(wanted.name, {}, text("holds ", bytes, " bytes, its voxels need ", wanted.bytes),
             "the file is damaged: get a whole copy of it");
}

}  // namespace

std::vector<std::byte> unfilter(const std::vector<Hdf5Filter>& filters,
                                std::vector<std::byte> stored, const Unfiltering& wanted) {
  // Checksums may be packed with the voxels.
  const auto checksums = std::count_if(filters.begin(), filters.end(),
                                       [](const auto& filter) { return filter.id == kFletcher32; });
  const std::size_t max = wanted.bytes + kChecksumBytes * static_cast<std::size_t>(checksums);
  for (std::size_t i = filters.size(); i > 0; --i) {
    if (!wanted.skips(i - 1)) stored = undo(filters[i - 1], std::move(stored), max, wanted.name);
  }
  check_size(stored.size(), wanted);
  return stored;
}

namespace {

/// The most bytes of elements that are unshuffled piece by piece.
constexpr std::uint32_t kMaxElement = 64;

/// Does what unshuffle() does, for a source.
std::shared_ptr<const ByteSource> unshuffled(const ByteSource& bytes, std::size_t size) {
  constexpr std::uint64_t kPiece = 1 << 14;  // elements
  ScratchFile out(scratch_folder());
  const std::uint64_t count = bytes.size() / size;
  std::vector<std::byte> row, elements;
  for (std::uint64_t first = 0; first < count; first += kPiece) {
    row.resize(std::min(kPiece, count - first));
    elements.resize(row.size() * size);
    for (std::size_t k = 0; k < size; ++k) {
      bytes.read_at(k * count + first, row);
      for (std::size_t i = 0; i < row.size(); ++i) elements[i * size + k] = row[i];
    }
    out.append(elements);
  }
  elements.resize(bytes.size() - count * size);
  bytes.read_at(count * size, elements);
  out.append(elements);
  return std::make_shared<FileSource>(out.release(), bytes.size(), bytes.name());
}

std::shared_ptr<const ByteSource> undone(const Hdf5Filter& filter,
                                         std::shared_ptr<const ByteSource> bytes,
                                         std::uint64_t max) {
  if (filter.id != kShuffle) return unpack_to_file(*codec_of(filter), std::move(bytes), max);
  return filter.parameter < 2 ? bytes : unshuffled(*bytes, filter.parameter);
}

}  // namespace

std::shared_ptr<const ByteSource> unfilter_to_file(const std::vector<Hdf5Filter>& filters,
                                                   std::shared_ptr<const ByteSource> stored,
                                                   const Unfiltering& wanted) {
  for (std::size_t i = filters.size(); i > 0; --i) {
    if (wanted.skips(i - 1)) continue;
    stored = undone(filters[i - 1], std::move(stored), wanted.bytes);
  }
  check_size(stored->size(), wanted);
  return stored;
}

std::optional<std::uint64_t> unfilter_streaming(const std::vector<Hdf5Filter>& filters) {
  std::uint64_t most = *max_streamed(Codec::kNone);
  for (const Hdf5Filter& filter : filters) {
    if (filter.id == kShuffle && filter.parameter <= kMaxElement) continue;
    const std::optional<Codec> codec = codec_of(filter);
    const auto bytes = codec ? max_streamed(*codec) : std::nullopt;
    if (!bytes) return std::nullopt;
    most = std::max(most, *bytes);
  }
  return most;
}

std::uint64_t max_unfilter_scratch(const std::vector<Hdf5Filter>& filters, std::size_t bytes) {
  std::uint64_t max = 0;
  for (const Hdf5Filter& filter : filters) {
    max = std::max(max, max_scratch(codec_of(filter).value_or(Codec::kNone), bytes));
  }
  const std::size_t between = filters.size() > 1 ? bytes : 0;  // from one filter to the next
  return max + between;
}

namespace {

/// Returns how many elements apart neighbours along an axis of the array are in a chunk.
std::int64_t stride_of(const Hdf5Description& description, std::optional<std::size_t> axis) {
  if (!axis) return 0;
  std::uint64_t stride = 1;
  for (std::size_t d = *axis + 1; d < description.chunk_shape.size(); ++d) {
    stride *= description.chunk_shape[d];
  }
  return static_cast<std::int64_t>(stride);
}

/// Returns the bytes of the voxels of a chunk.
std::size_t bytes_of_chunk(const Hdf5Description& description, std::string_view file) {
  auto bytes = static_cast<std::uint64_t>(byte_size(description.type));
  for (const std::uint64_t extent : description.chunk_shape) {
    if (__builtin_mul_overflow(bytes, extent, &bytes) || bytes > kMaxHdf5ChunkBytes) {
      fail_input(file, text("data set ", description.path),
                 text("a chunk of ", shape_text(description.chunk_shape), " of ",
                      name(description.type), " is above 4 GiB, the most of HDF5"),
                 "the file is damaged: check it with h5dump, or h5repack it");
    }
  }
  return bytes;
}

}  // namespace

Hdf5Chunks::Hdf5Chunks(std::unique_ptr<ByteSource> source, Hdf5Description description,
                       const Hdf5Axes& axes)
    : source_(std::move(source)),
      description_(std::move(description)),
      axes_(axes),
      strides_{stride_of(description_, axes[0]), stride_of(description_, axes[1]),
               stride_of(description_, axes[2])},
      chunk_bytes_(bytes_of_chunk(description_, source_->name())) {}

std::string Hdf5Chunks::name_of(Index3 chunk) const {
  return text(source_->name(), ": data set ", description_.path, ": chunk (", chunk.x, ", ",
              chunk.y, ", ", chunk.z, ")");
}

std::optional<Chunk> Hdf5Chunks::load(Index3 chunk, const Box3& /*box*/, ChunkPlace place) const {
  const std::vector<std::uint64_t> index = index_in_grid(chunk);
  const Hdf5Chunk* const stored = find(index);
  if (stored == nullptr) return std::nullopt;
  const bool unfiltered = description_.edges_unfiltered && sticks_out(index);
  const std::string name = name_of(chunk);
  const Unfiltering wanted{.skipped = unfiltered ? ~std::uint32_t{0} : stored->skipped,
                           .bytes = chunk_bytes_,
                           .name = name};
  if (place == ChunkPlace::kFile && streaming_bytes()) {
    auto part = std::make_shared<BytesPart>(source_, stored->offset, stored->bytes, name);
    return Chunk{.bytes = {},
                 .file = unfilter_to_file(description_.filters, std::move(part), wanted),
                 .strides = strides_};
  }
  std::vector<std::byte> bytes(stored->bytes);
  source_->read_at(stored->offset, bytes);
  return Chunk{.bytes = unfilter(description_.filters, std::move(bytes), wanted),
               .first = 0,
               .strides = strides_};
}

std::uint64_t Hdf5Chunks::scratch_bytes() const {
  std::uint64_t stored = 0;
  for (const Hdf5Chunk& chunk : description_.chunks) {
    stored = std::max<std::uint64_t>(stored, chunk.bytes);
  }
  return stored + max_unfilter_scratch(description_.filters, chunk_bytes_);
}

std::optional<std::uint64_t> Hdf5Chunks::streaming_bytes() const {
  return unfilter_streaming(description_.filters);
}

std::vector<std::uint64_t> Hdf5Chunks::index_in_grid(Index3 chunk) const {
  std::vector<std::uint64_t> index(description_.shape.size(), 0);
  const std::array<std::int64_t, 3> numbers{chunk.x, chunk.y, chunk.z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (axes_[i]) index[*axes_[i]] = static_cast<std::uint64_t>(numbers[i]);
  }
  return index;
}

const Hdf5Chunk* Hdf5Chunks::find(const std::vector<std::uint64_t>& index) const {
  std::uint64_t number = 0;
  for (std::size_t d = 0; d < index.size(); ++d) {
    const std::uint64_t extent = description_.chunk_shape[d];
    number = number * ((description_.shape[d] + extent - 1) / extent) + index[d];
  }
  const auto found = std::lower_bound(
      description_.chunks.begin(), description_.chunks.end(), number,
      [](const Hdf5Chunk& chunk, std::uint64_t wanted) { return chunk.number < wanted; });
  return found != description_.chunks.end() && found->number == number ? &*found : nullptr;
}

bool Hdf5Chunks::sticks_out(const std::vector<std::uint64_t>& index) const {
  for (std::size_t d = 0; d < index.size(); ++d) {
    if ((index[d] + 1) * description_.chunk_shape[d] > description_.shape[d]) return true;
  }
  return false;
}

Index3 chunk_extents(const Hdf5Description& description, const Hdf5Axes& axes) {
  const auto extent = [&](std::optional<std::size_t> axis) {
    return axis ? static_cast<std::int64_t>(description.chunk_shape[*axis]) : 1;
  };
  return {extent(axes[0]), extent(axes[1]), extent(axes[2])};
}

}  // namespace mw::io
