// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Temporary folders, bytes of all kinds and expected errors for the tests of io.
#pragma once

#include <zlib.h>

#include "io/volume/label_volume.h"
#include "tests/expect_error.h"
#include "tests/temp_folder.h"

namespace mw::io {

using test::content_of;

/// A folder with files.
class TempDir : public test::TempFolder {
 public:
  std::filesystem::path file(const std::string& name, const std::string& content) const {
    std::ofstream(path() / name, std::ios::binary) << content;
    return path() / name;
  }
  [[nodiscard]] std::size_t entries() const {
    const std::filesystem::directory_iterator begin(path());
    return static_cast<std::size_t>(std::distance(begin, std::filesystem::directory_iterator()));
  }
};

/// Deflated in the framing that zlib means by these bits: 31, gzip; 15, zlib; -15, none.
inline std::string deflated(const std::string& plain, int bits) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, bits, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, static_cast<uLong>(plain.size())) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
  stream.avail_in = static_cast<uInt>(plain.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

inline std::string gzip(const std::string& plain) {
  return deflated(plain, 31);
}

/// The low `size` bytes of value.
inline std::string number_bytes(std::uint64_t value, int size, bool big) {
  std::string bytes;
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i)));
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

inline std::vector<RawLabel> read_all(const LabelVolume& volume) {
  const Box3 all{{0, 0, 0}, volume.info().shape};
  std::vector<RawLabel> labels(static_cast<std::size_t>(all.voxels()));
  volume.read(all, labels);
  return labels;
}

inline constexpr VoxelType kAllTypes[] = {VoxelType::kU8,  VoxelType::kU16, VoxelType::kU32,
                                          VoxelType::kU64, VoxelType::kI8,  VoxelType::kI16,
                                          VoxelType::kI32, VoxelType::kI64};

/// Labels that use all bits of the type, sign-extended.
inline std::vector<RawLabel> sample_labels(Index3 shape, VoxelType type) {
  std::vector<RawLabel> labels(static_cast<std::size_t>(shape.product()));
  std::uint64_t state = 12345;
  const int unused = 64 - 8 * byte_size(type);
  for (RawLabel& label : labels) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    const std::uint64_t bits = (state ^ (state >> 29)) << unused;
    label = is_signed(type) ? static_cast<RawLabel>(static_cast<std::int64_t>(bits) >> unused)
                            : bits >> unused;
  }
  return labels;
}

inline std::string voxel_bytes(const std::vector<RawLabel>& labels, VoxelType type, bool big) {
  std::string bytes;
  for (const RawLabel label : labels) bytes += number_bytes(label, byte_size(type), big);
  return bytes;
}

}  // namespace mw::io
