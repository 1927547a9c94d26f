// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the blocks of an N5 array.
#include "io/volume/n5/open_n5.h"

#include <algorithm>

#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "kernels/core/index.h"

namespace mw::io {
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
