// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// LZF and HDF5's framing of LZ4, by hand.
#include "io/codec/codec.h"

#include "tests/io/codec/packers.h"

namespace mw::io {
namespace {

using Unpack = std::vector<std::byte> (*)(std::span<const std::byte>, std::size_t,
                                          std::string_view);

std::string run(Unpack unpack, const std::string& packed, std::size_t max = 1000) {
  const auto out = unpack(std::as_bytes(std::span(packed)), max, "f");
  return {reinterpret_cast<const char*>(out.data()), out.size()};
}

void refuse(Unpack unpack, const std::string& packed, const char* piece, std::size_t max = 1000) {
  expect_error(ErrorKind::kInput, {"f: ", piece},
               [&] { static_cast<void>(run(unpack, packed, max)); });
}

TEST(Lzf, RunsAndCopies) {
  EXPECT_EQ(run(unpack_lzf, ""), "");
  EXPECT_EQ(run(unpack_lzf, std::string("\2abc", 4)), "abc");
  // Three bytes from three back; then 7 + 4 + 2 of the last byte.
  EXPECT_EQ(run(unpack_lzf, std::string("\2abc\x20\2", 6)), "abcabc");
  EXPECT_EQ(run(unpack_lzf, std::string("\0x\xe0\4\0", 5)), std::string(14, 'x'));
  // A distance of 259 = 1 * 256 + 2 + 1.
  const std::string far = std::string("\2abc") + std::string("\xe0\xf7\0", 3);
  EXPECT_EQ(run(unpack_lzf, far + std::string("\x21\2", 2)).substr(259), "abc");
}

TEST(Lzf, Damage) {
  refuse(unpack_lzf, std::string("\2ab", 3), "truncated");
  refuse(unpack_lzf, std::string("\0x\xe0", 3), "truncated");
  refuse(unpack_lzf, std::string("\0x\x20\1", 4), "before the data");
  refuse(unpack_lzf, std::string("\2abc", 4), "more than the 2 bytes", 2);
  refuse(unpack_lzf, std::string("\0x\xe0\4\0", 5), "more than the 13 bytes", 13);
}

TEST(Lz4OfHdf5, BlocksAndDamage) {
  const std::string plain(250, 'a');
  const std::string head = number_bytes(250, 8, true) + number_bytes(200, 4, true);
  const std::string first = lz4_block(plain.substr(0, 200));
  const std::string packed = head + number_bytes(first.size(), 4, true) + first +
                             number_bytes(50, 4, true) + plain.substr(200);
  EXPECT_EQ(run(unpack_lz4_hdf5, packed), plain);
  for (std::size_t length = 0; length < packed.size(); ++length) {
    refuse(unpack_lz4_hdf5, packed.substr(0, length), "lz4");
  }
  refuse(unpack_lz4_hdf5, packed, "more than the 249 bytes", 249);
  refuse(unpack_lz4_hdf5, number_bytes(~std::uint64_t{0}, 8, true) + packed.substr(8), "more than");
  refuse(unpack_lz4_hdf5, number_bytes(250, 8, true) + number_bytes(0, 4, true), "empty");
}

}  // namespace
}  // namespace mw::io
