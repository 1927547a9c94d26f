// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The array of an N5 container, and its blocks.
#include "io/volume/n5/open_n5.h"

#include <algorithm>

#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "io/volume/checks.h"
#include "kernels/core/index.h"

namespace mw::io {
namespace {

/// The most axes that an array may have.
constexpr std::size_t kMaxAxes = 16;

Codec codec_of_name(const JsonFields& attributes, const std::string& field,
                    const std::string& type) {
  if (type == "raw") return Codec::kNone;
  if (type == "gzip") return Codec::kGzip;
  if (type == "zlib") return Codec::kZlib;
  if (type == "bzip2") return Codec::kBzip2;
  if (type == "xz") return Codec::kXz;
  if (type == "lz4") return Codec::kLz4Java;
  if (type == "blosc") return Codec::kBlosc;
  if (type == "zstd") return Codec::kZstd;
  attributes.fail(field, text("compression '", type, "' is not read here"),
                  "supported are raw, gzip, zlib, bzip2, xz, lz4, blosc and zstd");
}

/// Below version 1.0 of N5 the compression is one text, "compressionType".
Codec codec_of(const JsonFields& attributes) {
  if (!attributes.has("compression") && attributes.has("compressionType")) {
    return codec_of_name(attributes, "compressionType", attributes.text("compressionType"));
  }
  const JsonFields compression = attributes.object("compression");
  const Codec codec = codec_of_name(attributes, "compression.type", compression.text("type"));
  const bool zlib = compression.has("useZlib") && compression.flag("useZlib");
  if (codec == Codec::kGzip && zlib) return Codec::kZlib;
  // zarr-python gives an id to what is in the framing of numcodecs.
  if (codec == Codec::kLz4Java && compression.has("id")) return Codec::kLz4;
  return codec;
}

/// Returns the axes that make the volume: of more than three, the slowest of extent 1 are left out.
std::array<int, 3> axes_of(const JsonFields& attributes,
                           const std::vector<std::int64_t>& dimensions) {
  std::vector<int> kept;
  for (std::size_t i = 0; i < dimensions.size(); ++i) kept.push_back(static_cast<int>(i));
  for (std::size_t i = kept.size(); i-- > 0 && kept.size() > 3;) {
    if (dimensions[i] == 1) kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
  }
  if (kept.size() > 3) {
    attributes.fail("dimensions", text(kept.size(), " axes are longer than 1, and a volume has 3"),
                    "pick one of the volumes in it, and write that to an array of its own");
  }
  kept.resize(3, -1);
  return {kept[0], kept[1], kept[2]};
}

Index3 picked(const N5Array& array, const std::vector<std::int64_t>& of) {
  const auto at = [&](std::size_t i) {
    return array.axes[i] < 0 ? 1 : of[static_cast<std::size_t>(array.axes[i])];
  };
  return {at(0), at(1), at(2)};
}

void check_block_size(const JsonFields& attributes, const N5Array& array) {
  if (array.block_size.size() != array.dimensions.size()) {
    attributes.fail(
        "blockSize",
        text("has ", array.block_size.size(), " numbers, and dimensions ", array.dimensions.size()),
        "the file is damaged");
  }
  std::uint64_t max = kMaxChunkBytes / static_cast<std::uint64_t>(byte_size(array.type));
  for (const std::int64_t extent : array.block_size) {
    if (extent < 1) {
      attributes.fail("blockSize", text("extent ", extent, " is not positive"),
                      "the file is damaged");
    }
    max /= static_cast<std::uint64_t>(extent);
  }
  if (max > 0) return;
  attributes.fail("blockSize", text("blocks of ", name(array.type), " are larger than 2 GiB"),
                  "write the volume in smaller blocks");
}

}  // namespace

bool is_n5_array(const JsonFields& attributes) {
  return attributes.has("dimensions");
}

N5Array parse_n5_array(const JsonFields& attributes) {
  if (attributes.has("isLabelMultiset") && attributes.flag("isLabelMultiset")) {
    attributes.fail("isLabelMultiset", "voxels that have several labels are not read here",
                    "export the array with one label a voxel");
  }
  N5Array array{.type = store_type(attributes, "dataType"),
                .codec = codec_of(attributes),
                .dimensions = attributes.integers("dimensions"),
                .block_size = attributes.integers("blockSize")};
  const std::size_t count = array.dimensions.size();
  if (count < 2 || count > kMaxAxes) {
    attributes.fail("dimensions",
                    text("the array has ", count, " axes, and a volume 3 (a slice 2)"),
                    "give another array with --dataset");
  }
  array.axes = axes_of(attributes, array.dimensions);
  const Index3 shape = shape_of(array);
  static_cast<void>(checked_shape(attributes.file(), attributes.name_of("dimensions"),
                                  {shape.x, shape.y, shape.z}));
  check_block_size(attributes, array);
  return array;
}

Index3 shape_of(const N5Array& array) {
  return picked(array, array.dimensions);
}

Index3 block_of(const N5Array& array) {
  return picked(array, array.block_size);
}

namespace {

constexpr std::string_view kWayOut = "get a whole copy of the store";

struct BlockHeader {
  std::vector<std::int64_t> extents;
  std::uint64_t bytes = 0;  ///< length of the header
};

/// Reads the numbers of a file one after the other.
class NumberReader {
 public:
  explicit NumberReader(const ByteSource& source) : source_(source) {}

  template <class T>
  T next() {
    std::array<std::byte, sizeof(T)> bytes{};
    source_.read_at(at_, bytes);
    at_ += bytes.size();
    return load<T>(bytes.data(), ByteOrder::kBig);
  }
  [[nodiscard]] std::uint64_t position() const { return at_; }

 private:
  const ByteSource& source_;
  std::uint64_t at_ = 0;
};

[[noreturn]] void fail_header(const ByteSource& file, const std::string& reason) {
  fail_input(file.name(), "block header", reason, kWayOut);
}

/// Reads a block's header.  ENSURES: extents are positive and not beyond the array's block size.
BlockHeader read_header(const ByteSource& file, const N5Array& array) {
  NumberReader numbers(file);
  const auto mode = numbers.next<std::uint16_t>();
  if (mode > 1) fail_header(file, text("mode ", mode, " holds no plain numbers"));
  const auto axes = numbers.next<std::uint16_t>();
  if (axes != array.dimensions.size()) {
    fail_header(file, text(axes, " axes, and the array has ", array.dimensions.size()));
  }
  BlockHeader out;
  std::uint64_t values = 1;
  for (const std::int64_t max : array.block_size) {
    const auto extent = numbers.next<std::uint32_t>();
    if (extent == 0 || extent > max) {
      fail_header(file, text("extent ", extent, ", and the array's blocks have 1 to ", max));
    }
    out.extents.push_back(extent);
    values *= extent;
  }
  if (mode == 1) {
    const auto count = numbers.next<std::uint32_t>();
    if (count != values) fail_header(file, text(count, " values for ", values, " voxels"));
  }
  out.bytes = numbers.position();
  return out;
}

/// Returns how many values apart neighbours along each axis of the volume are.
Index3 strides_of(const N5Array& array, const std::vector<std::int64_t>& extents) {
  std::vector<std::int64_t> strides{1};
  for (const std::int64_t extent : extents) strides.push_back(strides.back() * extent);
  const auto of = [&](std::size_t i) {
    return array.axes[i] < 0 ? 0 : strides[static_cast<std::size_t>(array.axes[i])];
  };
  return {of(0), of(1), of(2)};
}

/// Blocks at the end of the array may be as large as the others, or end with it, but not before.
void check_reaches(const ByteSource& file, const N5Array& array,
                   const std::vector<std::int64_t>& extents, Index3 wanted) {
  const std::array<std::int64_t, 3> min{wanted.x, wanted.y, wanted.z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (array.axes[i] < 0) continue;
    const std::int64_t extent = extents[static_cast<std::size_t>(array.axes[i])];
    if (extent >= min[i]) continue;
    fail_header(file, text("extent ", extent, ", and the array has ", min[i],
                           " voxels there along ", std::string_view("xyz").substr(i, 1)));
  }
}

}  // namespace

/// Returns the file "x/y/z" of a block, with 0 for axes that are left out.
Place N5Blocks::path_of(Index3 chunk) const {
  const std::array<std::int64_t, 3> index{chunk.x, chunk.y, chunk.z};
  std::vector<std::int64_t> numbers(array_.dimensions.size(), 0);
  for (std::size_t i = 0; i < 3; ++i) {
    if (array_.axes[i] >= 0) numbers[static_cast<std::size_t>(array_.axes[i])] = index[i];
  }
  Place path = folder_;
  for (const std::int64_t number : numbers) path = path / std::to_string(number);
  return path;
}

std::optional<Chunk> N5Blocks::load(Index3 chunk, const Box3& box, ChunkPlace place) const {
  const std::shared_ptr<const ByteSource> file = path_of(chunk).open_if_there(max_file_bytes());
  if (!file) return std::nullopt;
  const BlockHeader header = read_header(*file, array_);
  check_reaches(*file, array_, header.extents, box.shape());
  const std::uint64_t wanted =
      product(header.extents) * static_cast<std::uint64_t>(byte_size(array_.type));
  Chunk out{.bytes = {}, .strides = strides_of(array_, header.extents)};
  if (place == ChunkPlace::kFile && streaming_bytes()) {
    const auto packed =
        std::make_shared<BytesPart>(file, header.bytes, file->size() - header.bytes, file->name());
    out.file = unpack_to_file(array_.codec, packed, wanted);
  } else {
    out.bytes = read_rest(*file, header.bytes, max_packed_bytes(wanted));
    if (array_.codec != Codec::kNone)
      out.bytes = unpack(array_.codec, out.bytes, wanted, file->name());
  }
  if (out.size() != wanted) {
    fail_input(file->name(), {},
               text(out.size(), " bytes of values, and its voxels of ", mw::io::name(array_.type),
                    " are ", wanted),
               kWayOut);
  }
  return out;
}

std::optional<std::uint64_t> N5Blocks::streaming_bytes() const {
  const auto codec = max_streamed(array_.codec);
  return codec ? std::optional(*codec + folder_.held_bytes(max_file_bytes())) : std::nullopt;
}

/// Returns the most bytes that the file of a block can have.
std::uint64_t N5Blocks::max_file_bytes() const {
  const std::uint64_t header = 8 + 4 * array_.dimensions.size();
  return header + max_packed_bytes(product(array_.block_size) *
                                   static_cast<std::uint64_t>(byte_size(array_.type)));
}

N5Blocks::N5Blocks(Place folder, N5Array array)
    : folder_(std::move(folder)), array_(std::move(array)), scratch_(found_scratch()) {}

/// Returns what the blocks that are there take, where they are large; else what any may take.
/// Blocks at the end may be larger than their voxels in the volume, and are kept as they are.
std::uint64_t N5Blocks::found_scratch() const {
  const std::uint64_t block =
      product(array_.block_size) * static_cast<std::uint64_t>(byte_size(array_.type));
  const std::uint64_t library = max_scratch(array_.codec, block);
  const Box3 grid = cells_of({{0, 0, 0}, shape_of(array_)}, block_of(array_));
  if (block < kLargeChunk || grid.voxels() > kMaxLooks || !folder_.is_near()) {
    return block + max_packed_bytes(block) + library + folder_.held_bytes(max_file_bytes());
  }
  std::uint64_t packed = 0;
  for_each_index(grid, [&](Index3 number) {
    const auto file = path_of(number).open_if_there(max_file_bytes());
    if (file) packed = std::max(packed, file->size());
  });
  return block + std::min(packed, max_packed_bytes(block)) + library;
}

}  // namespace mw::io
