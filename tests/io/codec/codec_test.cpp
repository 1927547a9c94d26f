// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Every codec gives back what was packed, and refuses what is damaged, cut or too much.
#include <thread>

#include "io/chunks/chunk.h"
#include "io/codec/checksums.h"
#include "io/codec/codec.h"
#include "tests/io/codec/packers.h"
#include "tests/peak_growth.h"
#include "tests/sanitizers.h"

namespace mw::io {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

std::string unpacked(Codec codec, const std::string& packed, std::size_t max) {
  const auto bytes = unpack(codec, bytes_of(packed), max, "chunk 7");
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

struct Packer {
  Codec codec;
  std::string (*pack)(const std::string& plain);
  bool has_checksum;  ///< against flips of what is packed
};

const std::vector<Packer> kPackers{
    {Codec::kNone, [](const std::string& s) { return s; }, false},
    {Codec::kGzip, gzip, true},
    {Codec::kGzip, [](const std::string& s) { return gzip(s.substr(0, 9)) + gzip(s.substr(9)); },
     true},
    {Codec::kZlib, zlib_packed, true},
    {Codec::kZstd, [](const std::string& s) { return zstd_packed(s); }, true},
    {Codec::kZstd, [](const std::string& s) { return zstd_packed(s, true); }, true},
    {Codec::kZstd,
     [](const std::string& s) { return zstd_packed(s.substr(0, 9)) + zstd_packed(s.substr(9)); },
     true},
    {Codec::kBlosc, [](const std::string& s) { return blosc_packed(s, "blosclz", 1, 4); }, false},
    {Codec::kBlosc, [](const std::string& s) { return blosc_packed(s, "lz4", 1, 8); }, false},
    {Codec::kBlosc, [](const std::string& s) { return blosc_packed(s, "lz4hc", 2, 2); }, false},
    {Codec::kBlosc, [](const std::string& s) { return blosc_packed(s, "zlib", 0, 1); }, false},
    {Codec::kBlosc, [](const std::string& s) { return blosc_packed(s, "zstd", 2, 4); }, false},
    {Codec::kLz4, lz4_packed, false},
    {Codec::kLz4Java, java_packed, true},
    {Codec::kBzip2, bzip2_packed, true},
    {Codec::kBzip2,
     [](const std::string& s) { return bzip2_packed(s.substr(0, 9)) + bzip2_packed(s.substr(9)); },
     true},
    {Codec::kXz, [](const std::string& s) { return xz_packed(s); }, true},
    {Codec::kXz, [](const std::string& s) { return xz_packed(s, 9); }, true},
};

/// Bytes with runs, as labels have; at least 9.
std::string some_bytes(std::mt19937& random, std::size_t size) {
  std::string out;
  while (out.size() < size) out.append(random() % 50, static_cast<char>(random()));
  out.resize(size);
  return out;
}

TEST(Codec, RoundTripsOfAllSizes) {
  std::mt19937 random(1);
  for (const Packer& packer : kPackers) {
    for (const std::size_t size : {9U, 10U, 100U, 127U, 128U, 4096U, 300000U, 3000000U}) {
      const std::string plain = some_bytes(random, size);
      const std::string packed = packer.pack(plain);
      EXPECT_EQ(unpacked(packer.codec, packed, size), plain) << name(packer.codec) << " " << size;
      EXPECT_EQ(unpacked(packer.codec, packed, size + 5), plain) << name(packer.codec);
    }
    const std::string noise = [&] {
      std::string out(70000, '\0');
      for (char& c : out) c = static_cast<char>(random());
      return out;
    }();
    EXPECT_EQ(unpacked(packer.codec, packer.pack(noise), noise.size()), noise)
        << name(packer.codec);
  }
}

TEST(Codec, RowsComeBack) {
  std::mt19937 random(417);
  for (int round = 0; round < 200; ++round) {
    const std::size_t row = 1 + random() % 255, rows = 1 + random() % 3000;
    const unsigned kinds = 1 + random() % 256;
    std::vector<std::byte> bytes(row * rows);
    for (std::byte& b : bytes) b = static_cast<std::byte>(random() % kinds);
    const std::vector<std::byte> packed = pack_rows(bytes, row);
    EXPECT_EQ(unpack_blosc(packed, bytes.size(), "rows"), bytes);
    if (kinds < 4 && bytes.size() > 10000) {
      EXPECT_LT(packed.size(), bytes.size());
    }
  }
}

TEST(Codec, MoreThanTheMostIsRefused) {
  std::mt19937 random(2);
  for (const Packer& packer : kPackers) {
    for (const std::size_t size : {200U, 300000U}) {
      const std::string packed = packer.pack(some_bytes(random, size));
      for (const std::size_t max : {std::size_t{0}, std::size_t{10}, size - 1}) {
        expect_error(ErrorKind::kInput, {"chunk 7", name(packer.codec), std::to_string(max)},
                     [&] { static_cast<void>(unpacked(packer.codec, packed, max)); });
      }
    }
  }
}

TEST(Codec, EveryTruncationIsRefused) {
  std::mt19937 random(3);
  for (const Packer& packer : kPackers) {
    if (packer.codec == Codec::kNone) continue;
    const std::string plain = some_bytes(random, 2500);
    const std::string packed = packer.pack(plain);
    for (std::size_t size = 0; size < packed.size(); ++size) {
      try {
        // Several members that end where one ends are whole for the codec; their bytes are too few.
        EXPECT_LT(unpacked(packer.codec, packed.substr(0, size), plain.size()).size(), plain.size())
            << name(packer.codec) << " " << size << " of " << packed.size();
      } catch (const Error& error) {
        ASSERT_EQ(error.kind(), ErrorKind::kInput);
        ASSERT_NE(std::string(error.what()).find("get a whole copy"), std::string::npos);
      }
    }
  }
}

TEST(Codec, FlipsAreRefusedOrHarmless) {
  std::mt19937 random(4);
  for (const Packer& packer : kPackers) {
    const std::string plain = some_bytes(random, 2500);
    const std::string packed = packer.pack(plain);
    for (std::size_t bit = 0; bit < 8 * packed.size(); ++bit) {
      std::string bent = packed;
      bent[bit / 8] = static_cast<char>(bent[bit / 8] ^ (1 << (bit % 8)));
      try {
        const std::string got = unpacked(packer.codec, bent, plain.size());
        if (packer.has_checksum) {
          // What a flip in a header may not matter to, or cut a member off, but not change a byte.
          EXPECT_EQ(got, plain.substr(0, got.size())) << name(packer.codec) << " bit " << bit;
        }
      } catch (const Error& error) {
        ASSERT_EQ(error.kind(), ErrorKind::kInput) << error.what();
      }
    }
  }
}

TEST(Codec, NoiseIsRefused) {
  std::mt19937 random(5);
  for (const Packer& packer : kPackers) {
    if (packer.codec == Codec::kNone) continue;
    for (int round = 0; round < 300; ++round) {
      std::string noise(random() % 200, '\0');
      for (char& c : noise) c = static_cast<char>(random());
      try {
        EXPECT_LE(unpacked(packer.codec, noise, 1000).size(), 1000U);
      } catch (const Error& error) {
        ASSERT_EQ(error.kind(), ErrorKind::kInput) << error.what();
      }
    }
  }
}

/// Zeros that take packed a thousandth of their bytes or less.
std::vector<std::pair<Codec, std::string>> bombs() {
  const std::string zeros(std::size_t{16} << 20U, '\0');
  std::vector<std::pair<Codec, std::string>> out;
  for (const Packer& packer : kPackers) {
    if (packer.codec != Codec::kNone) out.emplace_back(packer.codec, packer.pack(zeros));
  }
  return out;
}

TEST(Codec, BombsTakeNoMemory) {
  if (!test::kResidentMemoryIsOurs) GTEST_SKIP() << "resident memory is a sanitizer's";
  const auto packed = bombs();
  const long growth = test::growth_of([&] {
    for (const auto& bomb : packed) {
      expect_error(ErrorKind::kInput, {name(bomb.first), "more than"},
                   [&] { static_cast<void>(unpacked(bomb.first, bomb.second, 1 << 20)); });
    }
  });
  EXPECT_GE(growth, 0);
  EXPECT_LE(growth, 12 * 1024);
}

// A few bytes that claim as much as there may be.
TEST(Codec, ClaimsTakeNoMemory) {
  if (!test::kResidentMemoryIsOurs) GTEST_SKIP() << "resident memory is a sanitizer's";
  const std::size_t max = std::size_t{2} << 30U;
  const std::string size = number_bytes(0x7e000000, 4, false);
  const std::string block = "LZ4Block" + std::string("\x26") + number_bytes(5, 4, false) + size;
  const long growth = test::growth_of([&] {
    expect_error(ErrorKind::kInput, {"lz4", "too short"},
                 [&] { static_cast<void>(unpacked(Codec::kLz4, size + "abcdef", max)); });
    expect_error(ErrorKind::kInput, {"lz4", "too short"}, [&] {
      static_cast<void>(unpacked(Codec::kLz4Java, block + "sum." + "abcde" + kJavaEnd, max));
    });
    for (const Packer& packer : kPackers) {
      EXPECT_EQ(unpacked(packer.codec, packer.pack("123456789"), max), "123456789");
    }
  });
  EXPECT_GE(growth, 0);
  EXPECT_LE(growth, 24 * 1024);
}

// To a file, piece by piece, comes what comes to memory.
TEST(Codec, StreamsToAFile) {
  std::mt19937 random(7);
  for (const std::size_t size : {std::size_t{100}, std::size_t{3000000}}) {
    const std::string plain = some_bytes(random, size);
    for (const Packer& packer : kPackers) {
      if (!max_streamed(packer.codec)) continue;
      const std::string packed = packer.pack(plain);
      const auto bytes = std::as_bytes(std::span(packed));
      const auto source = written_to_file(bytes, "packed");
      const auto out = unpack_to_file(packer.codec, source, plain.size());
      EXPECT_EQ(read_whole(*out, plain.size()), plain);
      if (packed.size() < 2) continue;
      const auto cut = written_to_file(bytes.first(packed.size() / 2), "packed");
      if (packer.codec != Codec::kNone) {
        expect_error(ErrorKind::kInput, {"packed", name(packer.codec)},
                     [&] { static_cast<void>(unpack_to_file(packer.codec, cut, plain.size())); });
      }
      if (size > 0) {
        expect_error(ErrorKind::kInput, {"more than"}, [&] {
          static_cast<void>(unpack_to_file(packer.codec, source, plain.size() - 1));
        });
      }
    }
  }
}

TEST(Codec, ManyThreadsAtOnce) {
  std::mt19937 random(6);
  const std::string plain = some_bytes(random, 100000);
  std::vector<std::thread> threads;
  for (const Packer& packer : kPackers) {
    threads.emplace_back([&, packed = packer.pack(plain)] {
      for (int round = 0; round < 10; ++round) {
        EXPECT_EQ(unpacked(packer.codec, packed, plain.size()), plain);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(Checksums, KnownValues) {
  EXPECT_EQ(crc32c(bytes_of("123456789")), 0xe3069283U);              // the check of the CRC
  EXPECT_EQ(crc32c(bytes_of(std::string(32, '\0'))), 0x8a9136aaU);    // RFC 3720, B.4
  EXPECT_EQ(crc32c(bytes_of(std::string(32, '\xff'))), 0x62a8ab43U);  // RFC 3720, B.4
  std::mt19937 random(8);
  for (std::size_t size = 1; size < 200; ++size) {
    const std::string plain = some_bytes(random, size);
    EXPECT_EQ(xxhash32(bytes_of(plain), 0), xxhash_of_frame(plain)) << size;
  }
}

// LZF and HDF5's framing of LZ4, by hand.

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
