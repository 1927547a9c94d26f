// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the header of a block, checks it against the array, and unpacks its values.
#include "io/volume/n5/n5_blocks.h"

#include "io/chunks/chunk_bytes.h"
#include "io/file/byte_order.h"
#include "io/file/errors.h"

namespace mw::io {
namespace {

constexpr std::string_view kWayOut = "get a whole copy of the store";

struct BlockHeader {
  std::vector<std::int64_t> extents;
  std::uint64_t bytes = 0;  ///< of the header
};

/// Numbers of a file one after the other.
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

/// ENSURES: the extents are positive, and not beyond the array's block size.
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

/// Values between neighbours along each axis of the volume.
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

std::uint64_t product(const std::vector<std::int64_t>& extents) {
  std::uint64_t out = 1;
  for (const std::int64_t extent : extents) out *= static_cast<std::uint64_t>(extent);
  return out;
}

}  // namespace

/// "x/y/z", and 0 for axes that are left out.
std::filesystem::path N5Blocks::path_of(Index3 chunk) const {
  const std::array<std::int64_t, 3> index{chunk.x, chunk.y, chunk.z};
  std::vector<std::int64_t> numbers(array_.dimensions.size(), 0);
  for (std::size_t i = 0; i < 3; ++i) {
    if (array_.axes[i] >= 0) numbers[static_cast<std::size_t>(array_.axes[i])] = index[i];
  }
  std::filesystem::path path = folder_;
  for (const std::int64_t number : numbers) path /= std::to_string(number);
  return path;
}

std::optional<Chunk> N5Blocks::load(Index3 chunk, const Box3& box) const {
  const auto file = open_if_there(path_of(chunk));
  if (!file) return std::nullopt;
  const BlockHeader header = read_header(*file, array_);
  check_reaches(*file, array_, header.extents, box.shape());
  const std::uint64_t wanted =
      product(header.extents) * static_cast<std::uint64_t>(byte_size(array_.type));
  std::vector<std::byte> bytes = read_rest(*file, header.bytes, max_packed_bytes(wanted));
  if (array_.codec != Codec::kNone) bytes = unpack(array_.codec, bytes, wanted, file->name());
  if (bytes.size() != wanted) {
    fail_input(file->name(), {},
               text(bytes.size(), " bytes of values, and its voxels of ", mw::io::name(array_.type),
                    " are ", wanted),
               kWayOut);
  }
  return Chunk{.bytes = std::move(bytes), .strides = strides_of(array_, header.extents)};
}

/// Blocks at the end may be larger than their voxels in the volume, and are kept as they are.
std::uint64_t N5Blocks::scratch_bytes() const {
  const std::uint64_t block =
      product(array_.block_size) * static_cast<std::uint64_t>(byte_size(array_.type));
  return block + max_packed_bytes(block) + max_scratch(array_.codec, block);
}

}  // namespace mw::io
