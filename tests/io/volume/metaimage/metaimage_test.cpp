// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// MetaImage files, hand-made by the field table of MetaIO's documentation.
#include "tests/io/codec/packers.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

constexpr Index3 kShape{5, 4, 3};

std::string header(const std::string& type, const std::string& more,
                   const std::string& data_file = "LOCAL") {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 5 4 3\nElementType = " +
         type + "\n" + more + "ElementDataFile = " + data_file + "\n";
}

constexpr std::array<const char*, 8> kTypeNames{"MET_UCHAR",      "MET_USHORT",   "MET_UINT",
                                                "MET_ULONG_LONG", "MET_CHAR",     "MET_SHORT",
                                                "MET_INT",        "MET_LONG_LONG"};

TEST(MetaImage, EveryTypeByteOrderPlaceAndPacking) {
  const TempDir dir;
  for (const VoxelType type : kAllTypes) {
    const auto labels = sample_labels(kShape, type);
    const std::string type_name = kTypeNames[static_cast<std::size_t>(type)];
    for (const bool big : {false, true}) {
      const std::string data = voxel_bytes(labels, type, big);
      const std::string order =
          std::string(big ? "ElementByteOrderMSB" : "BinaryDataByteOrderMSB") +
          (big ? " = True\n" : " = False\n");
      for (const int packing : {0, 1, 2}) {
        const std::string body = packing == 0   ? data
                                 : packing == 1 ? zlib_packed(data)
                                                : gzip(data);
        const std::string more = order + "CompressedData = " + (packing == 0 ? "False" : "True") +
                                 "\nCompressedDataSize = " + std::to_string(body.size()) + "\n";
        const auto inside = dir.file("a.mha", header(type_name, more) + body + "trailing");
        const auto volume = open_volume(inside);
        EXPECT_EQ(volume->info().type, type);
        EXPECT_EQ(volume->info().format, "metaimage");
        EXPECT_EQ(read_all(*volume), labels) << type_name << big << packing;
        dir.file("a.zraw", body);
        const auto outside = dir.file("a.mhd", header(type_name, more, "a.zraw"));
        EXPECT_EQ(read_all(*open_volume(outside)), labels) << type_name << big << packing;
      }
    }
  }
}

TEST(MetaImage, LongHasFourBytesAndFloatsHoldWholeNumbers) {
  const TempDir dir;
  const auto labels = sample_labels(kShape, VoxelType::kI32);
  const auto path =
      dir.file("a.mha", header("MET_LONG", "") + voxel_bytes(labels, VoxelType::kI32, false));
  EXPECT_EQ(read_all(*open_volume(path)), labels);
  std::string floats;
  for (int i = 0; i < 60; ++i) {
    const auto value = static_cast<float>(i);
    floats.append(reinterpret_cast<const char*>(&value), 4);
  }
  const auto whole = read_all(*open_volume(dir.file("f.mha", header("MET_FLOAT", "") + floats)));
  for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(whole[i], i);
}

TEST(MetaImage, HeaderSizeCountsFromTheFileBeginningOrItsEnd) {
  const TempDir dir;
  const auto labels = sample_labels(kShape, VoxelType::kU8);
  const std::string data = voxel_bytes(labels, VoxelType::kU8, false);
  dir.file("front.raw", "1234567" + data + "behind");
  dir.file("end.raw", "any number of bytes" + data);
  const auto front = dir.file("f.mhd", header("MET_UCHAR", "HeaderSize = 7\n", "front.raw"));
  const auto end = dir.file("e.mhd", header("MET_UCHAR", "HeaderSize = -1\n", "end.raw"));
  EXPECT_EQ(read_all(*open_volume(front)), labels);
  EXPECT_EQ(read_all(*open_volume(end)), labels);
}

/// Axis 0 of the array goes along the world's y, axis 1 against its x.
TEST(MetaImage, RowsOfTheMatrixAreTheArraysAxes) {
  const TempDir dir;
  const auto path =
      dir.file("a.mha", header("MET_UCHAR",
                               "TransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 10 20 30\n"
                               "ElementSpacing = 2 4 6\nAnatomicalOrientation = RAI\n"
                               "DistanceUnits = mm\n") +
                            std::string(60, 'a'));
  const VolumeSpace space = open_volume(path)->info().space;
  EXPECT_EQ(space.frame, WorldFrame::kLps);
  EXPECT_EQ(space.unit, "mm");
  EXPECT_EQ(space.spacing, (Vector3{2, 4, 6}));
  EXPECT_EQ(to_world(space, {0.5, 0.5, 0.5}), (Vector3{10, 20, 30}));
  EXPECT_EQ(to_world(space, {1.5, 0.5, 0.5}), (Vector3{10, 22, 30}));
  EXPECT_EQ(to_world(space, {0.5, 1.5, 0.5}), (Vector3{6, 20, 30}));
}

TEST(MetaImage, WithoutOffsetTheFirstCentreIsAtZero) {
  const TempDir dir;
  const auto path =
      dir.file("a.mha", header("MET_UCHAR", "ElementSize = 2 4 6\n") + std::string(60, 'a'));
  EXPECT_EQ(open_volume(path)->info().space.origin, (Vector3{-1, -2, -3}));
}

TEST(MetaImage, TwoAndFourAxes) {
  const TempDir dir;
  const auto flat =
      dir.file("2.mha",
               "NDims = 2\nDimSize = 3 2\nElementType = MET_UCHAR\nElementSpacing = 2 5\n"
               "TransformMatrix = 0 1 1 0\nOffset = 1 2\nElementDataFile = LOCAL\nabcdef");
  EXPECT_EQ(open_volume(flat)->info().shape, (Index3{3, 2, 1}));
  EXPECT_EQ(open_volume(flat)->info().space.spacing, (Vector3{2, 5, 1}));
  EXPECT_EQ(read_all(*open_volume(flat))[5], RawLabel{'f'});
  const std::string four = "NDims = 4\nElementType = MET_UCHAR\nDimSize = 3 2 1 ";
  const auto one = dir.file("4.mha", four + "1\nElementDataFile = LOCAL\nabcdef");
  EXPECT_EQ(open_volume(one)->info().shape, (Index3{3, 2, 1}));
  const auto two = dir.file("5.mha", four + "2\nElementDataFile = LOCAL\nabcdefabcdef");
  expect_not_opened(two, {"DimSize", "4 axes", "pick one"});
}

TEST(MetaImage, SlicesInFilesOfTheirOwn) {
  const TempDir dir;
  const auto labels = sample_labels(kShape, VoxelType::kU16);
  const std::string data = voxel_bytes(labels, VoxelType::kU16, false);
  std::filesystem::create_directory(dir.path() / "sub");
  for (int z = 0; z < 3; ++z) {
    const std::string slice = data.substr(static_cast<std::size_t>(z) * 40, 40);
    dir.file("s" + std::to_string(10 + 2 * z) + ".raw", "hh" + slice);
    dir.file("sub/s00" + std::to_string(1 + z), slice);
  }
  const std::string skip = "HeaderSize = 2\n";
  const auto list =
      dir.file("l.mhd", header("MET_USHORT", skip, "LIST") + "s10.raw\r\ns12.raw\n\ns14.raw");
  const auto range = dir.file("r.mhd", header("MET_USHORT", skip, "s%d.raw 10 14 2"));
  const auto numbered = dir.file("n.mhd", header("MET_USHORT", "", "sub/s%03d"));
  for (const auto& path : {list, range, numbered}) {
    EXPECT_EQ(read_all(*open_volume(path)), labels) << path;
    expect_boxes(*open_volume(path), labels);
  }
  dir.file("s12.raw", "short");
  expect_error(ErrorKind::kInput, {"s12.raw", "40 bytes", "holds 5"},
               [&] { static_cast<void>(open_volume(list)); });
}

TEST(MetaImage, WhatIsWrongIsNamed) {
  const TempDir dir;
  const auto refuse = [&](const std::string& content, std::vector<std::string> pieces) {
    pieces.push_back((dir.path() / "a.mha").string());
    expect_not_opened(dir.file("a.mha", content), pieces);
  };
  const std::string data(60, 'a');
  const auto with = [&](const std::string& more) { return header("MET_UCHAR", more) + data; };
  refuse("plain text", {"MetaImage header", "no field"});
  refuse("NDims = 3\n", {"ElementDataFile", "missing"});
  refuse(header("MET_STRING", "") + data, {"ElementType", "MET_STRING"});
  refuse(header("MET_UCHAR_ARRAY", "") + data, {"ElementType"});
  refuse(with("ElementNumberOfChannels = 3\n"), {"ElementNumberOfChannels", "pick one"});
  refuse(with("ObjectType = Tube\n"), {"ObjectType", "Tube"});
  refuse(with("BinaryData = False\n"), {"BinaryData"});
  refuse(with("DimSize = 5 4\n"), {"DimSize"});
  refuse(with("DimSize = 5 0 3\n"), {"DimSize' (y)", "not positive"});
  refuse(with("DimSize = 5 4 4\n"), {"80 bytes", "holds 60"});
  refuse(with("DimSize = 1048576 1048576 1048576\n"), {"holds 60"});
  refuse(with("NDims = 99\n"), {"NDims"});
  refuse(with("ElementSpacing = 1 nan 1\n"), {"ElementSpacing", "(y)", "--spacing"});
  refuse(with("ElementSpacing = 1 -2 1\n"), {"ElementSpacing", "(y)", "--spacing"});
  refuse(with("ElementSpacing = 1 2\n"), {"ElementSpacing", "3 numbers"});
  refuse(with("Offset = 1 inf 2\n"), {"Offset", "--origin"});
  refuse(with("TransformMatrix = 1 1 0 0 1 0 0 0 1\n"), {"TransformMatrix", "right angles"});
  refuse(with("HeaderSize = -2\n"), {"HeaderSize"});
  refuse(with("CompressedData = True\n"), {"compressed voxel data", "corrupt"});
  refuse(header("MET_UCHAR", "CompressedData = True\n") + zlib_packed("abc"), {"needed"});
  refuse(
      header("MET_UCHAR", "CompressedData = True\nDimSize = 9999 9999 9999\n") + zlib_packed(data),
      {"cannot hold enough"});
  std::string bad = zlib_packed(data);
  bad.back() = static_cast<char>(bad.back() ^ 1);
  refuse(header("MET_UCHAR", "CompressedData = True\n") + bad, {"corrupt"});
  for (const char* name : {"/etc/passwd", "../a.raw", "sub/../../a.raw"}) {
    refuse(header("MET_UCHAR", "", name), {"ElementDataFile", "leads out"});
  }
  refuse(header("MET_UCHAR", "", "gone.raw"), {"ElementDataFile", "gone.raw", "missing"});
  refuse(header("MET_UCHAR", "", "LIST") + "one\ntwo\n", {"ElementDataFile", "2 files"});
  refuse(header("MET_UCHAR", "", "LIST 3") + "one\n", {"ElementDataFile"});
  refuse(header("MET_UCHAR", "", "s%s.raw"), {"ElementDataFile", "pattern"});
  refuse(header("MET_UCHAR", "", "s%99999d%n.raw"), {"ElementDataFile", "pattern"});
  refuse(header("MET_UCHAR", "", "s%d.raw 1 9"), {"ElementDataFile", "3 slices"});
}

TEST(MetaImage, DamagedFilesAreReadOrRefused) {
  const TempDir dir;
  const auto labels = sample_labels(kShape, VoxelType::kU16);
  const std::string data = voxel_bytes(labels, VoxelType::kU16, false);
  const std::string more =
      "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 1 2 3\nElementSpacing = 1 1 1\n";
  damage_everywhere(dir, "a.mha", header("MET_USHORT", more) + data);
  damage_everywhere(dir, "z.mha",
                    header("MET_USHORT", more + "CompressedData = True\n") + zlib_packed(data));
  for (int z = 1; z <= 3; ++z) dir.file("s" + std::to_string(z), std::string(40, 'a'));
  damage_everywhere(dir, "l.mhd", header("MET_USHORT", more, "LIST") + "s1\ns2\ns3\n");
  damage_everywhere(dir, "p.mhd", header("MET_USHORT", more, "s%d 1 3 1"));
}

}  // namespace
}  // namespace mw::io
