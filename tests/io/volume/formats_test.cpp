// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Every format, voxel type, byte order and axis order gives back the labels that were written.
#include <limits>

#include "io/file/errors.h"
#include "io/volume/npy/open_npy.h"
#include "io/volume/open_volume.h"
#include "tests/io/volume/sample_files.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

constexpr Index3 kShape{5, 4, 3};

std::vector<RawLabel> z_fastest(const std::vector<RawLabel>& labels, Index3 n) {
  std::vector<RawLabel> out;
  for (std::int64_t x = 0; x < n.x; ++x) {
    for (std::int64_t y = 0; y < n.y; ++y) {
      for (std::int64_t z = 0; z < n.z; ++z) {
        out.push_back(labels[static_cast<std::size_t>((z * n.y + y) * n.x + x)]);
      }
    }
  }
  return out;
}

std::string npy_descr(VoxelType type, bool big) {
  std::string descr(1, byte_size(type) == 1 ? '|' : big ? '>' : '<');
  return descr + (is_signed(type) ? 'i' : 'u') + std::to_string(byte_size(type));
}

TEST(Npy, EveryTypeByteOrderAndAxisOrder) {
  const TempDir dir;
  for (const VoxelType type : kAllTypes) {
    const auto labels = sample_labels(kShape, type);
    for (const bool big : {false, true}) {
      for (const bool fortran : {false, true}) {
        const auto stored = fortran ? z_fastest(labels, kShape) : labels;
        const auto path = dir.file("a.npy", npy_file(npy_descr(type, big), fortran, "(3, 4, 5)",
                                                     voxel_bytes(stored, type, big)));
        const auto volume = open_volume(path);
        EXPECT_EQ(volume->info().shape, kShape);
        EXPECT_EQ(volume->info().type, type);
        EXPECT_EQ(volume->info().format, "npy");
        EXPECT_EQ(read_all(*volume), labels) << name(type) << big << fortran;
      }
    }
  }
}

TEST(Npy, VersionsBooleansSlicesAndTrailingBytes) {
  const TempDir dir;
  for (const int version : {1, 2, 3}) {
    const auto path = dir.file(
        "v.npy", npy_file("|b1", false, "(2,3)", std::string("\1\0\1\0\0\1xx", 8), version));
    const auto volume = open_volume(path);
    EXPECT_EQ(volume->info().shape, (Index3{3, 2, 1}));
    EXPECT_EQ(read_all(*volume), (std::vector<RawLabel>{1, 0, 1, 0, 0, 1}));
  }
  const auto native = dir.file("n.npy", npy_file("=u2", false, "(1, 1, 1L)", "\x34\x12"));
  EXPECT_EQ(read_all(*open_volume(native)), std::vector<RawLabel>{0x1234});
}

TEST(Npy, GzipByContentAndChainedMembers) {
  const TempDir dir;
  const auto labels = sample_labels(kShape, VoxelType::kU16);
  const auto plain =
      npy_file("<u2", false, "(3, 4, 5)", voxel_bytes(labels, VoxelType::kU16, false));
  const auto one = dir.file("a.npy.gz", gzip(plain));
  EXPECT_EQ(read_all(*open_volume(one)), labels);
  const auto two =
      dir.file("b.npy", gzip(plain.substr(0, 50)) + gzip(plain.substr(50)) + std::string(2, '\0'));
  EXPECT_EQ(read_all(*open_volume(two)), labels);
}

TEST(Npy, WriterAndReaderRoundTripInAnySlabs) {
  const TempDir dir;
  for (const VoxelType type : kAllTypes) {
    const auto labels = sample_labels(kShape, type);
    const VolumeInfo info{.shape = kShape, .type = type, .format = {}};
    NpyWriter npy(dir.path() / "w.npy", info);
    RawWriter raw(dir.path() / "w.raw", info);
    for (std::size_t at = 0; at < labels.size(); at += 20) {
      npy.write(std::span(labels).subspan(at, 20));
      raw.write(std::span(labels).subspan(at, 20));
    }
    npy.finish();
    raw.finish();
    EXPECT_EQ(read_all(*open_volume(dir.path() / "w.npy")), labels);
    const OpenOptions options{.raw = RawLayout{kShape, type}, .spacing = {}, .origin = {}};
    EXPECT_EQ(read_all(*open_volume(dir.path() / "w.raw", options)), labels);
  }
}

TEST(Npy, WriterRefusesLabelsThatDoNotFitAndMissingVoxels) {
  const TempDir dir;
  const VolumeInfo info{.shape = {2, 1, 1}, .type = VoxelType::kU8, .format = {}};
  expect_error(ErrorKind::kUsage, {"w.npy", "256"}, [&] {
    NpyWriter(dir.path() / "w.npy", info).write(std::vector<RawLabel>{1, 256});
  });
  expect_error(ErrorKind::kUsage, {"w.npy", "1 voxels"}, [&] {
    NpyWriter writer(dir.path() / "w.npy", info);
    writer.write(std::vector<RawLabel>{1});
    writer.finish();
  });
  EXPECT_EQ(dir.entries(), 0U);
}

TEST(Nifti, EveryTypeVersionAndByteOrder) {
  const TempDir dir;
  constexpr std::array<int, 8> kCodes{2, 512, 768, 1280, 256, 4, 8, 1024};
  for (const VoxelType type : kAllTypes) {
    const auto labels = sample_labels(kShape, type);
    for (const int version : {1, 2}) {
      for (const bool big : {false, true}) {
        NiftiSample sample{.version = version, .big = big, .magic = {}};
        sample.datatype = kCodes[static_cast<std::size_t>(type)];
        const auto file = sample.header() + voxel_bytes(labels, type, big) + "trailing";
        const auto volume = open_volume(dir.file("a.nii", file));
        EXPECT_EQ(volume->info().shape, kShape);
        EXPECT_EQ(volume->info().space.spacing, (std::array{0.5, 2.0, 3.0}));
        EXPECT_EQ(volume->info().space.origin, (std::array{-0.25, -1.0, -1.5}));
        EXPECT_EQ(read_all(*volume), labels) << name(type) << version << big;
        EXPECT_EQ(read_all(*open_volume(dir.file("a.nii.gz", gzip(file)))), labels);
      }
    }
  }
}

TEST(Nrrd, EveryTypeAndByteOrderInlineAndDetached) {
  const TempDir dir;
  const std::array<std::string, 8> names{
      "uint8",  "unsigned short", "uint",    "unsigned long long",
      "int8_t", "SHORT",          "int32_t", "longlong"};
  for (const VoxelType type : kAllTypes) {
    const auto labels = sample_labels(kShape, type);
    for (const bool big : {false, true}) {
      const std::string data = voxel_bytes(labels, type, big);
      const std::string head =
          "NRRD0004\n# a comment\ntype: " + names[static_cast<std::size_t>(type)] +
          "\ndimension: 3\nsizes: 5 4 3\nkey:=value: x\nendian: " + (big ? "big" : "little") + "\n";
      for (const bool packed : {false, true}) {
        const std::string encoding = packed ? "encoding: gzip\n" : "encoding: raw\n";
        const std::string body = packed ? gzip(data) : data;
        const auto inside = dir.file("a.nrrd", text(head, encoding, "\n", body));
        EXPECT_EQ(read_all(*open_volume(inside)), labels);
        dir.file("a.bin", body);
        const auto outside = dir.file("a.nhdr", head + encoding + "data file: a.bin\n");
        EXPECT_EQ(read_all(*open_volume(outside)), labels);
      }
    }
  }
}

TEST(Nrrd, GeometryAndByteSkip) {
  const TempDir dir;
  const std::string head =
      "NRRD0005\r\ntype: uchar\r\ndimension: 3\r\nsizes: 2 1 1\r\nencoding: raw\r\n";
  const auto a = dir.file("a.nrrd", head +
                                        "space directions: (3,4,0) (-8,6,0) (0,0,1)\r\n"
                                        "space origin: (10,20,30)\r\nbyte skip: 3\r\n\r\nxxxAB");
  const auto volume = open_volume(a);
  EXPECT_EQ(volume->info().space.spacing, (std::array{5.0, 10.0, 1.0}));
  const Vector3 corner{10 - 1.5 + 4, 20 - 2 - 3, 29.5};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(volume->info().space.origin[k], corner[k], 1e-12);
  }
  EXPECT_EQ(read_all(*volume), (std::vector<RawLabel>{'A', 'B'}));
  const auto b = dir.file("b.nrrd", head + "spacings: 1 2 4\r\nbyteskip: -1\r\n\r\nxxxxxCD");
  EXPECT_EQ(open_volume(b)->info().space.spacing, (std::array{1.0, 2.0, 4.0}));
  EXPECT_EQ(read_all(*open_volume(b)), (std::vector<RawLabel>{'C', 'D'}));
}

TEST(FurtherAxes, OfOneElementGo) {
  const TempDir dir;
  const std::vector<RawLabel> labels{'a', 'b', 'c', 'd', 'e', 'f'};
  for (const std::string shape : {"(1, 2, 3, 1)", "(1, 1, 2, 3)", "(1, 1, 1, 2, 3)"}) {
    const auto volume = open_volume(dir.file("a.npy", npy_file("|u1", false, shape, "abcdef")));
    EXPECT_EQ(read_all(*volume), labels) << shape;
  }
  EXPECT_EQ(open_volume(dir.path() / "a.npy")->info().shape, (Index3{3, 2, 1}));
  const std::string head = "NRRD0005\ntype: uchar\nencoding: raw\ndimension: 4\n";
  const auto list = open_volume(
      dir.file("a.nrrd", head + "sizes: 1 3 2 1\nspace directions: none (1,0,0) (0,2,0) "
                                "(0,0,3)\n\nabcdef"));
  EXPECT_EQ(list->info().shape, (Index3{3, 2, 1}));
  EXPECT_EQ(list->info().space.spacing, (Vector3{1, 2, 3}));
  EXPECT_EQ(read_all(*list), labels);
  const auto plain = open_volume(dir.file("b.nrrd", head + "sizes: 3 2 1 1\n\nabcdef"));
  EXPECT_EQ(plain->info().shape, (Index3{3, 2, 1}));
  expect_not_opened(dir.file("c.nrrd", head + "sizes: 3 1 1 2\n\nabcdef"), {"c.nrrd", "4 axes"});
}

TEST(Raw, BothByteOrdersAndOverrides) {
  const TempDir dir;
  const auto labels = sample_labels(kShape, VoxelType::kI32);
  for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
    const auto path =
        dir.file("a.bin", voxel_bytes(labels, VoxelType::kI32, order == ByteOrder::kBig));
    const OpenOptions options{.raw = RawLayout{kShape, VoxelType::kI32, order},
                              .spacing = std::array{1.0, 2.0, 3.0},
                              .origin = std::array{-1.0, 0.0, 7.0}};
    const auto volume = open_volume(path, options);
    EXPECT_EQ(volume->info().space.spacing, *options.spacing);
    EXPECT_EQ(volume->info().space.origin, *options.origin);
    EXPECT_EQ(read_all(*volume), labels);
  }
}

TEST(Regions, RandomBoxesEqualThePartOfTheWhole) {
  const TempDir dir;
  constexpr Index3 kBig{70, 90, 130};
  const auto labels = sample_labels(kBig, VoxelType::kU16);
  for (const bool fortran : {false, true}) {
    const auto data =
        voxel_bytes(fortran ? z_fastest(labels, kBig) : labels, VoxelType::kU16, false);
    const auto volume =
        open_volume(dir.file("a.npy", npy_file("<u2", fortran, "(130, 90, 70)", data)));
    expect_boxes(*volume, labels, 7, 60);
  }
}

}  // namespace
}  // namespace mw::io
