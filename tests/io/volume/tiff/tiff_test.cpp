// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// TIFF stacks of every type, byte order and layout against the labels that were written.
#include <thread>

#include "tests/io/volume/tiff/tiff_maker.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

TEST(Tiff, EveryTypeByteOrderAndSizeOfOffsets) {
  const TempDir dir;
  for (const VoxelType type : kAllTypes) {
    for (const bool big_endian : {false, true}) {
      for (const bool big_tiff : {false, true}) {
        const TiffSample sample{.type = type, .big_endian = big_endian, .big_tiff = big_tiff};
        const auto labels = sample_labels(sample.shape, type);
        const auto volume = open_volume(dir.file("a.tif", sample.file(labels)));
        EXPECT_EQ(volume->info().shape, sample.shape);
        EXPECT_EQ(volume->info().type, type);
        EXPECT_EQ(volume->info().format, "tiff");
        EXPECT_EQ(volume->info().space.origin, (Vector3{0, 0, 0}));
        EXPECT_EQ(read_all(*volume), labels) << name(type) << big_endian << big_tiff;
      }
    }
  }
}

/// Any layout, packing and box.
TEST(Tiff, StripsAndTilesByRegion) {
  const TempDir dir;
  std::mt19937 random(7);
  for (const TiffPacking packing :
       {TiffPacking::kNone, TiffPacking::kLzw, TiffPacking::kDeflate, TiffPacking::kPackBits}) {
    for (int i = 0; i < 12; ++i) {
      const auto size = [&](std::int64_t max) {
        return 1 + static_cast<std::int64_t>(random() % static_cast<unsigned>(max));
      };
      TiffSample sample{.shape = {size(70), size(70), size(4)},
                        .type = VoxelType::kU16,
                        .big_endian = i % 2 == 1,
                        .rows_per_strip = size(30),
                        .packing = packing};
      if (i % 3 == 0) sample.tile_width = 16 * size(3), sample.tile_height = 16 * size(2);
      if (packing == TiffPacking::kPackBits) sample.shape.x = 50;  // 100 bytes: one run a row
      if (packing == TiffPacking::kPackBits) sample.tile_width = 0;
      const auto labels = sample_labels(sample.shape, sample.type);
      const auto path = dir.file("a.tif", sample.file(labels));
      // With and without room for more than one chunk.
      for (const std::uint64_t cache : {std::uint64_t{0}, std::uint64_t{64} << 20U}) {
        const auto volume = open_volume(path, {.cache_bytes = cache});
        expect_boxes(*volume, labels, static_cast<unsigned>(i));
      }
    }
  }
}

TEST(Tiff, ManyThreadsReadAtOnce) {
  const TempDir dir;
  TiffSample sample{
      .shape = {61, 47, 9}, .type = VoxelType::kU32, .packing = TiffPacking::kDeflate};
  sample.tile_width = sample.tile_height = 16;
  const auto labels = sample_labels(sample.shape, sample.type);
  const auto path = dir.file("a.tif", sample.file(labels));
  const auto volume = open_volume(path, {.cache_bytes = 4096});
  std::vector<std::thread> threads;
  for (unsigned seed = 0; seed < 4; ++seed) {
    threads.emplace_back([&, seed] { expect_boxes(*volume, labels, seed, 100); });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(Tiff, FloatsHoldWholeNumbers) {
  const TempDir dir;
  const TiffSample sample{.shape = {2, 1, 1}, .type = VoxelType::kF32};
  std::vector<RawLabel> bits;
  for (const float value : {3.0F, 1.5F}) bits.push_back(std::bit_cast<std::uint32_t>(value));
  const auto volume = open_volume(dir.file("a.tif", sample.file(bits)));
  std::vector<RawLabel> label(1);
  volume->read({{0, 0, 0}, {1, 1, 1}}, label);
  EXPECT_EQ(label[0], 3U);
  expect_error(ErrorKind::kInput, {"a.tif", "voxel (1, 0, 0)", "1.5"}, [&] {
    volume->read({{1, 0, 0}, {2, 1, 1}}, label);
  });
}

TEST(Tiff, SmallerCopiesAreNoSlices) {
  const TempDir dir;
  for (const std::int64_t at : {0, 1, 2}) {
    const TiffSample sample{.thumbnail_at = at};
    const auto labels = sample_labels(sample.shape, sample.type);
    EXPECT_EQ(read_all(*open_volume(dir.file("a.tif", sample.file(labels)))), labels);
  }
}

TEST(Tiff, PalettesGiveIndicesAndMissingBlocksZero) {
  const TempDir dir;
  const TiffSample palette{.photometric = 3};
  const auto labels = sample_labels(palette.shape, palette.type);
  EXPECT_EQ(read_all(*open_volume(dir.file("a.tif", palette.file(labels)))), labels);
  const TiffSample sparse{.leave_out_second_block = true};
  auto expected = labels;
  for (std::size_t z = 0; z < 3; ++z) {
    std::fill_n(expected.begin() + static_cast<std::ptrdiff_t>(20 * z + 10), 10, RawLabel{0});
  }
  EXPECT_EQ(read_all(*open_volume(dir.file("s.tif", sparse.file(labels)))), expected);
}

TEST(Tiff, ImageJSpacingAndUnit) {
  const TempDir dir;
  TiffSample sample{.description = "ImageJ=1.53t\nimages=3\nslices=3\nunit=micron\nspacing=2.5\n",
                    .resolution = {4, 1, 5, 2}};
  const auto labels = sample_labels(sample.shape, sample.type);
  const auto space = open_volume(dir.file("a.tif", sample.file(labels)))->info().space;
  EXPECT_EQ(space.spacing, (Vector3{0.25, static_cast<double>(1 / 2.5), 2.5}));
  EXPECT_EQ(space.unit, "um");
  EXPECT_TRUE(space.is_sized);
  // Dots per inch of other files are no size of a voxel.
  sample.description = "a scan";
  const auto scan = open_volume(dir.file("b.tif", sample.file(labels)));
  EXPECT_EQ(scan->info().space.spacing, (Vector3{1, 1, 1}));
  EXPECT_FALSE(scan->info().space.is_sized);
  EXPECT_EQ(scan->info().note, "");
  sample.description = "ImageJ=1.53t\nimages=6\nchannels=2\nslices=3\n";
  expect_not_opened(dir.file("c.tif", sample.file(labels)), {"ImageJ channels", "2"});
}

TEST(Tiff, ImageJUnitsOfYAndZ) {
  const TempDir dir;
  TiffSample sample{.resolution = {125, 1, 125, 1}};  // 0.008 of the unit
  const auto labels = sample_labels(sample.shape, sample.type);
  const auto path_of = [&](const std::string& lines) {
    sample.description = "ImageJ=1.53t\nimages=3\nslices=3\n" + lines;
    return dir.file("a.tif", sample.file(labels));
  };
  const auto expect = [&](const std::string& lines, const Vector3& spacing,
                          const std::string& unit) {
    SCOPED_TRACE(lines);
    const auto volume = open_volume(path_of(lines));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_DOUBLE_EQ(volume->info().space.spacing[i], spacing[i]) << i;
    }
    EXPECT_EQ(volume->info().space.unit, unit);
  };
  expect("unit=micron\nspacing=40\nzunit=nm\n", {0.008, 0.008, 0.04}, "um");
  expect("unit=nm\nspacing=0.04\nzunit=micron\n", {0.008, 0.008, 40}, "nm");
  expect("unit=mm\nspacing=2\nyunit=mm\nzunit=cm\n", {0.008, 0.008, 20}, "mm");
  expect("unit=mm\nspacing=2\nyunit=cm\n", {0.008, 0.08, 2}, "mm");
  expect("unit=\\u00B5m\nspacing=2\nyunit=\xc2\xb5m\nzunit=inch\n", {0.008, 0.008, 50800}, "um");
  // What cannot be turned is refused, unless the caller gives all three in one unit.
  expect_not_opened(path_of("unit=pixel\nspacing=2\nzunit=nm\n"), {"(z)", "--spacing"});
  const auto path = path_of("unit=mm\nspacing=2\nyunit=furlong\n");
  expect_not_opened(path, {"(y)", "--spacing"});
  EXPECT_EQ(open_volume(path, {.spacing = Vector3{3, 2, 1}})->info().space.spacing,
            (Vector3{3, 2, 1}));
}

TEST(Tiff, ResolutionInCentimetres) {
  const TempDir dir;
  TiffSample sample{.resolution = {2000, 1, 2500, 1}, .resolution_unit = 3};
  const auto labels = sample_labels(sample.shape, sample.type);
  const auto path = dir.file("a.tif", sample.file(labels));
  const auto volume = open_volume(path);
  EXPECT_EQ(volume->info().space.spacing, (Vector3{1, 1, 1}));
  EXPECT_FALSE(volume->info().space.is_sized);
  EXPECT_NE(volume->info().note.find("2000 x 2500 pixels a centimetre"), std::string::npos)
      << volume->info().note;
  EXPECT_NE(volume->info().note.find("0.005 mm in x"), std::string::npos) << volume->info().note;
  EXPECT_EQ(open_volume(path, {.spacing = Vector3{1, 1, 1}})->info().note, "");
  // ImageJ means it, and says the step in z.
  sample.description = "ImageJ=1.53t\nimages=3\nslices=3\nspacing=0.001\n";
  const auto stack = open_volume(dir.file("b.tif", sample.file(labels)));
  EXPECT_EQ(stack->info().space.spacing, (Vector3{0.0005, 0.0004, 0.001}));
  EXPECT_EQ(stack->info().space.unit, "cm");
  EXPECT_EQ(stack->info().note, "");
}

/// ImageJ's way above 4 GiB: one directory, all slices behind each other.
TEST(Tiff, ImageJStacksOfOneDirectory) {
  const TempDir dir;
  for (const bool big : {false, true}) {
    TiffSample sample{.shape = {5, 4, 6},
                      .type = VoxelType::kU16,
                      .big_endian = big,
                      .description = "ImageJ=1.53t\nimages=06\nslices=06\n",
                      .pages = 1};
    const auto labels = sample_labels(sample.shape, sample.type);
    // The first slice's strips are in front of its directory; ImageJ has the pixels last.
    TiffSample all = sample;
    all.shape = {5, 24, 1};
    all.rows_per_strip = 24;
    std::string file = all.file(labels);
    const std::string height =
        number_bytes(257, 2, big) + number_bytes(4, 2, big) + number_bytes(1, 4, big);
    const std::size_t at = file.find(height);
    ASSERT_NE(at, std::string::npos);
    file.replace(at + 8, 4, number_bytes(4, 4, big));
    const auto path = dir.file("a.tif", file);
    const auto volume = open_volume(path);
    EXPECT_EQ(volume->info().shape, sample.shape);
    expect_boxes(*volume, labels);
    const std::string images = "images=06";
    file.replace(file.find(images), images.size(), "images=99");
    file.replace(file.find("slices=06"), images.size(), "slices=99");
    expect_not_opened(dir.file("a.tif", file), {"a.tif", "3960 bytes"});
  }
}

std::string ome(const std::string& pixels, const std::string& more = "") {
  return "<?xml version=\"1.0\"?><OME xmlns=\"http://www.openmicroscopy.org/Schemas/OME/2016-06\">"
         "<Image ID=\"Image:0\"><Pixels DimensionOrder=\"XYZCT\" Type=\"uint8\" SizeX=\"5\" "
         "SizeY=\"4\" " +
         pixels + ">" + more + "</Pixels></Image></OME>";
}

TEST(Tiff, OmeSizesAndUnits) {
  const TempDir dir;
  const auto space_of = [&](const std::string& pixels, const std::string& more = "") {
    const TiffSample sample{.description = ome(pixels, more)};
    const auto labels = sample_labels(sample.shape, sample.type);
    return open_volume(dir.file("a.ome.tif", sample.file(labels)))->info().space;
  };
  const std::string sizes = "SizeZ=\"3\" SizeC=\"1\" SizeT=\"1\" ";
  const auto plain =
      space_of(sizes + "PhysicalSizeX=\"0.5\" PhysicalSizeY=\"0.25\" PhysicalSizeZ=\"2\"",
               "<TiffData IFD=\"0\" FirstZ=\"0\"/><TiffData IFD=\"2\" FirstZ=\"2\"/>");
  EXPECT_EQ(plain.spacing, (Vector3{0.5, 0.25, 2}));
  EXPECT_EQ(plain.unit, "um");
  const auto mixed =
      space_of(sizes +
               "PhysicalSizeX=\"500\" PhysicalSizeXUnit=\"nm\" PhysicalSizeY=\"500\" "
               "PhysicalSizeYUnit=\"nm\" PhysicalSizeZ=\"2\"");
  EXPECT_EQ(mixed.unit, "nm");
  EXPECT_NEAR(mixed.spacing[2], 2000, 1e-9);
  EXPECT_EQ(space_of(sizes).spacing, (Vector3{1, 1, 1}));
  EXPECT_EQ(space_of(sizes + "PhysicalSizeX=\"0.5\"").spacing, (Vector3{0.5, 0.5, 0.5}));
  const auto refuse = [&](const std::string& pixels, const std::vector<std::string>& pieces,
                          const std::string& more = "") {
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(space_of(pixels, more)); });
  };
  refuse(sizes + "PhysicalSizeX=\"1\" PhysicalSizeY=\"1\"", {"(z)", "--spacing"});
  refuse("SizeZ=\"4\"", {"4 slices", "3 pages"});
  refuse("SizeZ=\"3\" SizeC=\"2\"", {"SizeC", "2"});
  refuse("SizeZ=\"3\" SizeT=\"2\"", {"SizeT", "2"});
  refuse("SizeZ=\"3\" oops", {"OME-XML at offset"});
  refuse(sizes, {"TiffData", "slice 2 is page 0"}, "<TiffData IFD=\"0\" FirstZ=\"2\"/>");
}

TEST(Tiff, WhatIsWrongIsNamed) {
  const TempDir dir;
  const TiffSample good;
  const auto labels = sample_labels(good.shape, good.type);
  const auto refuse = [&](const std::string& content, std::vector<std::string> pieces) {
    expect_not_read(dir.file("a.tif", content), pieces);
  };
  refuse("II*", {"TIFF header"});
  refuse("plain text", {"TIFF header"});
  TiffSample colour = good;
  colour.samples = 3;
  refuse(colour.file(labels), {"page 1", "3 samples", "one channel"});
  std::string bits = good.file(labels);
  const std::string tag = number_bytes(258, 2, false) + number_bytes(3, 2, false);
  bits.replace(bits.rfind(tag) + 8, 2, number_bytes(16, 2, false));
  refuse(bits, {"page 3", "u16", "the first slice is 5 x 4 pixels of u8"});
  bits.replace(bits.rfind(tag) + 8, 2, number_bytes(12, 2, false));
  refuse(bits, {"page 3", "12 bits"});
  std::string packing = good.file(labels);
  const std::string compression = number_bytes(259, 2, false) + number_bytes(3, 2, false);
  packing.replace(packing.find(compression) + 8, 2, number_bytes(34892, 2, false));
  refuse(packing, {"page 1", "compression 34892"});
  std::string huge = good.file(labels);
  for (const int extent : {256, 257}) {
    const std::string field = number_bytes(static_cast<std::uint64_t>(extent), 2, false) +
                              number_bytes(4, 2, false) + number_bytes(1, 4, false);
    huge.replace(huge.find(field) + 8, 4, number_bytes(1000000, 4, false));
  }
  refuse(huge, {"page"});
  // The last directory is cut off.
  const std::string whole = good.file(labels);
  refuse(whole.substr(0, whole.size() - 40), {"page 3"});
}

TEST(Tiff, DamagedFilesAreReadOrRefused) {
  const TempDir dir;
  for (const bool big_tiff : {false, true}) {
    for (const TiffPacking packing : {TiffPacking::kNone, TiffPacking::kDeflate}) {
      TiffSample sample{
          .shape = {6, 5, 2}, .type = VoxelType::kU16, .big_tiff = big_tiff, .packing = packing};
      if (packing == TiffPacking::kDeflate) sample.tile_width = sample.tile_height = 16;
      const auto labels = sample_labels(sample.shape, sample.type);
      damage_everywhere(dir, "a.tif", sample.file(labels), 4096, 500);
    }
  }
}

}  // namespace
}  // namespace mw::io
