// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// PNG pictures, and folders of TIFF or PNG slices.
#include "io/volume/slices/slice_folder.h"
#include "tests/io/test_files.h"
#include "tests/io/volume/tiff/tiff_maker.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

// PNG files byte by byte, by the PNG specification (second edition).

struct PngSample {
  std::int64_t width = 5;
  std::int64_t height = 4;
  int depth = 8;
  int kind = 0;  ///< 0: grey, 3: palette
  bool interlaced = false;

  /// Values x fastest, below 2^depth.
  [[nodiscard]] std::string file(const std::vector<RawLabel>& values) const {
    std::string header = number_bytes(static_cast<std::uint64_t>(width), 4, true) +
                         number_bytes(static_cast<std::uint64_t>(height), 4, true);
    header += static_cast<char>(depth);
    header += static_cast<char>(kind);
    header += std::string("\0\0", 2) + (interlaced ? '\1' : '\0');
    std::string rows;
    if (interlaced) {
      // Adam7: first column and row of each pass, and its steps.
      constexpr std::array<std::array<std::int64_t, 4>, 7> kPasses{{{0, 0, 8, 8},
                                                                    {4, 0, 8, 8},
                                                                    {0, 4, 4, 8},
                                                                    {2, 0, 4, 4},
                                                                    {0, 2, 2, 4},
                                                                    {1, 0, 2, 2},
                                                                    {0, 1, 1, 2}}};
      for (const auto& [x, y, dx, dy] : kPasses) rows += pass(values, {x, y, 0}, {dx, dy, 1});
    } else {
      rows = pass(values, {0, 0, 0}, {1, 1, 1});
    }
    std::string out = "\x89PNG\r\n\x1a\n" + chunk("IHDR", header);
    if (kind == 3) out += chunk("PLTE", std::string(3 * (std::size_t{1} << depth), 'p'));
    return out + chunk("IDAT", deflated(rows, 15)) + chunk("IEND", "");
  }

 private:
  [[nodiscard]] std::string pass(const std::vector<RawLabel>& values, Index3 first,
                                 Index3 step) const {
    std::string rows;
    for (std::int64_t y = first.y; y < height; y += step.y) {
      if (first.x >= width) break;
      rows += '\0';  // no filter
      std::uint64_t bits = 0;
      int filled = 0;
      for (std::int64_t x = first.x; x < width; x += step.x) {
        bits = bits << depth | values[static_cast<std::size_t>(y * width + x)];
        filled += depth;
        for (; filled >= 8; filled -= 8) rows += static_cast<char>(bits >> (filled - 8));
      }
      if (filled > 0) rows += static_cast<char>(bits << (8 - filled));
    }
    return rows;
  }

  [[nodiscard]] static std::string chunk(const std::string& name, const std::string& content) {
    const std::string body = name + content;
    const auto crc =
        crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    return number_bytes(content.size(), 4, true) + body + number_bytes(crc, 4, true);
  }
};

std::vector<RawLabel> values_below(std::size_t count, int bits, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::vector<RawLabel> values(count);
  for (RawLabel& value : values) value = random() % (1U << static_cast<unsigned>(bits));
  return values;
}

TEST(Png, EveryDepthKindAndInterlace) {
  const TempDir dir;
  for (const int kind : {0, 3}) {
    for (const int depth : {1, 2, 4, 8, 16}) {
      if (kind == 3 && depth == 16) continue;
      for (const bool interlaced : {false, true}) {
        for (const std::int64_t width : {1, 3, 13}) {
          const PngSample sample{
              .width = width, .height = 11, .depth = depth, .kind = kind, .interlaced = interlaced};
          const auto values = values_below(static_cast<std::size_t>(width * 11), depth);
          const auto volume = open_volume(dir.file("a.png", sample.file(values)));
          EXPECT_EQ(volume->info().shape, (Index3{width, 11, 1}));
          EXPECT_EQ(volume->info().type, depth == 16 ? VoxelType::kU16 : VoxelType::kU8);
          EXPECT_EQ(read_all(*volume), values) << kind << depth << interlaced << width;
        }
      }
    }
  }
}

TEST(Png, WhatIsWrongIsNamed) {
  const TempDir dir;
  const PngSample good;
  const std::string file = good.file(values_below(20, 8));
  const auto refuse = [&](const std::string& content, std::vector<std::string> pieces) {
    expect_not_read(dir.file("a.png", content), pieces);
  };
  refuse(file.substr(0, 20), {"PNG header"});
  refuse(file.substr(0, 60), {"PNG data", "truncated"});
  std::string colour = file;
  colour[25] = 2;
  refuse(colour, {"colours", "palette"});
  std::string huge = file;
  huge.replace(16, 8, number_bytes(1 << 19, 4, true) + number_bytes(1 << 19, 4, true));
  refuse(huge, {"524288 x 524288", "the file has"});
  std::string flipped = file;
  flipped[50] = static_cast<char>(flipped[50] ^ 4);
  refuse(flipped, {"PNG data"});
}

TEST(Png, DamagedFilesAreReadOrRefused) {
  const TempDir dir;
  damage_everywhere(dir, "a.png", PngSample{}.file(values_below(20, 8)));
  damage_everywhere(dir, "p.png",
                    PngSample{.depth = 2, .kind = 3, .interlaced = true}.file(values_below(20, 2)));
}

TEST(NaturalOrder, NumbersAreComparedAsNumbers) {
  const std::vector<std::string> ordered{
      "1",     "2",        "10",     "a",       "a1b2",
      "a1b10", "a2",       "a02x",   "a2y",     "a10",
      "b",     "slice001", "slice2", "slice10", "slice99999999999999999999999",
      "t"};
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    for (std::size_t j = 0; j < ordered.size(); ++j) {
      EXPECT_EQ(comes_before(ordered[i], ordered[j]), i < j) << ordered[i] << " " << ordered[j];
    }
  }
}

/// Short names of few letters: any two are ordered, and any three in a row.
TEST(NaturalOrder, IsAStrictTotalOrder) {
  std::mt19937 random(3);
  const auto name = [&] {
    std::string out;
    for (auto i = random() % 5; i > 0; --i) out += "01a."[random() % 4];
    return out;
  };
  for (int i = 0; i < 20000; ++i) {
    const std::string a = name(), b = name(), c = name();
    EXPECT_EQ(comes_before(a, b) || comes_before(b, a), a != b) << a << " " << b;
    EXPECT_FALSE(comes_before(a, b) && comes_before(b, a)) << a << " " << b;
    if (comes_before(a, b) && comes_before(b, c)) {
      EXPECT_TRUE(comes_before(a, c)) << a << " " << b << " " << c;
    }
  }
}

TEST(NaturalOrder, GapsAreFoundWhereOnlyANumberDiffers) {
  const auto gap = [](const std::vector<std::string>& names) {
    const auto found = find_gap(names);
    return found ? found->a + "-" + found->b : "none";
  };
  EXPECT_EQ(gap({"s1", "s2", "s3"}), "none");
  EXPECT_EQ(gap({"s08", "s10", "s12"}), "none");
  EXPECT_EQ(gap({"s1", "s2", "s4"}), "s2-s4");
  EXPECT_EQ(gap({"s1", "s3", "s4"}), "s1-s3");
  EXPECT_EQ(gap({"s1", "s01", "s2"}), "s01-s2");
  EXPECT_EQ(gap({"a1", "a2", "b9"}), "none");
  EXPECT_EQ(gap({"a1b1", "a2b2", "a2b9"}), "none");
  EXPECT_EQ(gap({"a1", "a9"}), "none");
}

TEST(SliceFolder, PngAndTiffInNaturalOrder) {
  const TempDir dir;
  const Index3 shape{5, 4, 12};
  const auto labels = sample_labels(shape, VoxelType::kU8);
  for (const bool png : {true, false}) {
    const auto folder = dir.path() / (png ? "png" : "tif");
    std::filesystem::create_directory(folder);
    std::ofstream(folder / "notes.txt") << "no slice";
    std::ofstream(folder / ".hidden.tif") << "no slice";
    std::filesystem::create_directory(folder / "sub.tif");
    for (std::size_t z = 0; z < 12; ++z) {
      const auto from = labels.begin() + static_cast<std::ptrdiff_t>(20 * z);
      const std::vector<RawLabel> slice(from, from + 20);
      const std::string name = "s" + std::to_string(z + 1) +
                               (png          ? ".PNG"
                                : z % 2 == 0 ? ".tif"
                                             : ".tiff");
      const TiffSample tiff{.shape = {5, 4, 1},
                            .big_endian = z % 3 == 0,
                            .rows_per_strip = 1 + static_cast<std::int64_t>(z % 4),
                            .packing = z % 2 == 0 ? TiffPacking::kNone : TiffPacking::kDeflate};
      std::ofstream(folder / name, std::ios::binary)
          << (png ? PngSample{}.file(slice) : tiff.file(slice));
    }
    const auto volume = open_volume(folder, {.cache_bytes = 100});
    EXPECT_EQ(volume->info().format, png ? "png" : "tiff");
    EXPECT_EQ(volume->info().shape, shape);
    expect_boxes(*volume, labels);
  }
}

TEST(SliceFolder, WhatIsWrongIsNamed) {
  const TempDir dir;
  const auto values = values_below(20, 8);
  const auto refuse = [&](std::vector<std::string> pieces) { expect_not_read(dir.path(), pieces); };
  refuse({"folder"});
  const std::string good = PngSample{}.file(values);
  for (const char* name : {"s1.png", "s2.png", "s4.png"}) dir.file(name, good);
  refuse({"s4.png", "s2.png", "missing"});
  dir.file("s3.png", PngSample{.width = 4, .height = 5}.file(values));
  refuse({"s3.png", "4 x 5 pixels", "the first slice is 5 x 4"});
  dir.file("s3.png", PngSample{.depth = 16}.file(values));
  refuse({"s3.png", "u16", "u8"});
  dir.file("s3.png", "");
  refuse({"s3.png"});
  dir.file("s3.png", good);
  dir.file("s5.tif", "");
  refuse({"s5.tif", "s1.png", "TIFF and PNG"});
  for (const char* name : {"s1.png", "s2.png", "s3.png", "s4.png"}) {
    std::filesystem::remove(dir.path() / name);
  }
  refuse({"s5.tif", "empty"});
  const auto labels = sample_labels({5, 4, 3}, VoxelType::kU8);
  dir.file("s5.tif", TiffSample{}.file(labels));
  refuse({"s5.tif", "several"});
  const TiffSample one{.shape = {5, 4, 1}};
  dir.file("s5.tif", one.file(labels));
  dir.file("s6.tif", TiffSample{.shape = {5, 4, 1}, .type = VoxelType::kI8}.file(labels));
  refuse({"s6.tif", "i8", "u8"});
  dir.file("s6.tif", one.file(labels));
  EXPECT_EQ(open_volume(dir.path())->info().shape, (Index3{5, 4, 2}));
}

}  // namespace
}  // namespace mw::io
