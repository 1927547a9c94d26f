// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Every format, voxel type, byte order and axis order gives back the labels that were written.
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
    for (std::size_t at = 0; at < labels.size(); at += 20) {
      npy.write(std::span(labels).subspan(at, 20));
    }
    npy.finish();
    EXPECT_EQ(read_all(*open_volume(dir.path() / "w.npy")), labels);
    const OpenOptions options{.raw = RawLayout{kShape, type}, .spacing = {}, .origin = {}};
    const auto raw = dir.file("w.raw", voxel_bytes(labels, type, false));
    EXPECT_EQ(read_all(*open_volume(raw, options)), labels);
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

// Every broken or unsupported volume is refused with a message that names file and field.

const std::string kEight(8, 'a');

void expect_refused(const TempDir& dir, const std::string& file, const std::string& content,
                    std::vector<std::string> pieces) {
  expect_not_opened(dir.file(file, content), pieces);
}

TEST(VolumeErrors, Files) {
  const TempDir dir;
  expect_not_opened(dir.path() / "missing.npy", {"missing.npy", "cannot open"});
  expect_not_opened(dir.path(), {"folder"});
  expect_refused(dir, "empty.npy", "", {"empty"});
  expect_refused(dir, "a.xyz", "what is this", {"unknown", volume_endings(), volume_folders()});
}

/// They would say nothing about this file: that is an error, and names the formats they are for.
TEST(VolumeErrors, OptionsThatAFormatDoesNotHave) {
  const TempDir dir;
  const auto path = dir.file("a.npy", npy_file("|u1", false, "(2, 2, 2)", kEight));
  const auto refuse = [&](const OpenOptions& options, const std::vector<std::string>& pieces) {
    expect_misused(path, options, pieces);
  };
  refuse({.dataset = "labels"}, {"--dataset", "a.npy", "NumPy", formats_with_datasets()});
  refuse({.scale = 0}, {"--scale", "a.npy", "NumPy", formats_with_scales()});
  refuse({.raw = RawLayout{{2, 2, 2}}, .scale = 0}, {"--scale", "raw", formats_with_scales()});
}

/// What help and errors list.
TEST(VolumeFormats, AreListedFromOneTable) {
  for (const char* ending : {".npy", ".nii", ".hdr", ".img", ".mgh", ".mgz", ".nrrd", ".mha",
                             ".vti", ".h5", ".tif", ".png", ".zip"}) {
    EXPECT_NE((volume_endings() + ",").find(text(ending, ",")), std::string::npos) << ending;
  }
  const std::string stores = "neuroglancer precomputed, N5, Zarr";
  EXPECT_EQ(formats_with_datasets(), "HDF5, VTK image, zipped Zarr, " + stores);
  EXPECT_EQ(formats_with_scales(), "zipped Zarr, " + stores);
  EXPECT_EQ(volume_folders(), stores + ", TIFF or PNG slices, masks");
}

TEST(VolumeErrors, Gzip) {
  const TempDir dir;
  const std::string packed =
      gzip(npy_file("|u1", false, "(2, 2, 2)", "12345678") + std::string(5000, 'x'));
  expect_refused(dir, "a.npy.gz", packed.substr(0, packed.size() - 9), {"truncated", "gzip"});
  std::string corrupt = packed;
  corrupt[corrupt.size() - 6] = static_cast<char>(corrupt[corrupt.size() - 6] ^ 1);
  expect_refused(dir, "b.npy.gz", corrupt, {"corrupt", "gzip"});
}

TEST(VolumeErrors, Npy) {
  const TempDir dir;
  const auto npy = [](const std::string& descr, const std::string& shape) {
    return npy_file(descr, false, shape, kEight);
  };
  expect_refused(dir, "a.npy", "\x93NUMPY\1", {"header", "truncated"});
  expect_refused(dir, "a.npy", npy("|u1", "(2, 2, 2)").substr(0, 40), {"header", "truncated"});
  expect_refused(dir, "a.npy", "something else", {"magic"});
  expect_refused(dir, "a.npy", npy("<f2", "(2, 2, 2)"), {"descr", "floats of 32"});
  expect_refused(dir, "a.npy", npy("<c8", "(2, 2, 2)"), {"descr", "unsupported"});
  expect_refused(dir, "a.npy", npy("<u3", "(2, 2, 2)"), {"descr", "unsupported"});
  expect_refused(dir, "a.npy", npy("<U4", "(2, 2, 2)"), {"descr", "unsupported"});
  expect_refused(dir, "a.npy", npy("|u1", "(8,)"), {"shape", "1 axes"});
  expect_refused(dir, "a.npy", npy("|u1", "(2, 2, 2, 1, 2)"), {"shape", "5 axes"});
  std::string axes = "(";
  for (int i = 0; i < 61; ++i) axes += "1, ";
  EXPECT_EQ(read_all(*open_volume(dir.file("b.npy", npy("|u1", axes + "2, 2, 2)")))).size(), 8U);
  expect_refused(dir, "a.npy", npy("|u1", axes + "1, 2, 2, 2)"), {"shape", "65 axes"});
  expect_refused(dir, "a.npy", npy("|u1", "(2, 0, 2)"), {"shape", "(y)", "not positive"});
  expect_refused(dir, "a.npy", npy("|u1", "(2, 2, -2)"), {"shape", "(x)", "not positive"});
  expect_refused(dir, "a.npy", npy("|u1", "(2, 2, 1048577)"), {"shape", "1048576", "32-bit"});
  expect_refused(dir, "a.npy", npy("|u1", "(2, 2, 99999999999999999999)"), {"shape", "64 bits"});
  expect_refused(dir, "a.npy", npy("|u1", "(2, 2, 3)"), {"12 bytes", "holds 8"});
  expect_refused(dir, "a.npy", npy("<u8", "(1048576, 1048576, 1048576)"), {"9223372036854775808"});
  std::string version = npy("|u1", "(2, 2, 2)");
  version[6] = 4;
  expect_refused(dir, "a.npy", version, {"version"});
}

TEST(VolumeErrors, Nifti) {
  const TempDir dir;
  const auto refuse = [&](const NiftiSample& sample, std::vector<std::string> pieces) {
    expect_refused(dir, "a.nii", sample.header() + std::string(60, 'a'), std::move(pieces));
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const int version : {1, 2}) {
    NiftiSample good{.version = version, .magic = {}};
    expect_refused(dir, "a.nii", good.header().substr(0, 200), {"header", "truncated"});
    expect_refused(dir, "a.nii", good.header() + "abc", {"60 bytes", "holds 3"});
    const auto bend = [&](auto change, std::vector<std::string> pieces) {
      NiftiSample bad = good;
      change(bad);
      refuse(bad, std::move(pieces));
    };
    bend([](NiftiSample& s) { s.datatype = 1536; }, {"datatype 1536", "floats of 32"});
    bend([](NiftiSample& s) { s.datatype = 128; }, {"datatype 128", "unsupported"});
    bend([](NiftiSample& s) { s.dim[0] = 2; }, {"dim[0]"});
    bend([](NiftiSample& s) { s.dim = {5, 5, 4, 3, 1, 2, 1, 1}; }, {"dim[5]"});
    bend([](NiftiSample& s) { s.dim = {4, 5, 4, 3, 2, 1, 1, 1}; }, {"voxel data", "2 times"});
    bend([](NiftiSample& s) { s.dim[2] = 0; }, {"dim", "(y)"});
    bend([](NiftiSample& s) { s.dim[1] = -5; }, {"dim", "(x)"});
    bend([](NiftiSample& s) { s.pixdim[2] = 0; }, {"pixdim (y)", "--spacing"});
    bend([&](NiftiSample& s) { s.pixdim[3] = nan; }, {"pixdim (z)", "--spacing"});
    bend([&](NiftiSample& s) { s.slope = std::numeric_limits<double>::infinity(); }, {"scl_slope"});
    bend([&](NiftiSample& s) { s.inter = -std::numeric_limits<double>::infinity(); },
         {"scl_inter"});
    bend([](NiftiSample& s) { s.vox_offset = 100; }, {"vox_offset"});
    bend([](NiftiSample& s) { s.magic = s.version == 1 ? "ni1" : "ni2"; }, {"magic", ".img"});
    bend([&](NiftiSample& s) { s.sform_code = 1, s.translation[1] = nan; }, {"sform offset"});
  }
}

TEST(VolumeErrors, OverridesReplaceBrokenGeometry) {
  const TempDir dir;
  NiftiSample sample{.pixdim = {1, 0, 0, 0}, .magic = {}};
  const auto path = dir.file("a.nii", sample.header() + std::string(60, 'a'));
  const OpenOptions options{.raw = {}, .spacing = std::array{1.0, 2.0, 3.0}, .origin = {}};
  EXPECT_EQ(open_volume(path, options)->info().space.spacing, *options.spacing);
  const OpenOptions bad{.raw = {}, .spacing = std::array{1.0, -2.0, 3.0}, .origin = {}};
  expect_error(ErrorKind::kUsage, {"--spacing: must be finite and positive"},
               [&] { static_cast<void>(open_volume(path, bad)); });
}

TEST(VolumeErrors, Nrrd) {
  const TempDir dir;
  const auto refuse = [&](const std::string& fields, std::vector<std::string> pieces) {
    expect_refused(dir, "a.nrrd", "NRRD0004\n" + fields + "\n" + kEight, std::move(pieces));
  };
  const std::string sizes = "dimension: 3\nsizes: 2 2 2\n";
  const std::string good = "type: uchar\nencoding: raw\n" + sizes;
  refuse("encoding: raw\n" + sizes, {"type", "missing"});
  refuse("type: block\nencoding: raw\n" + sizes, {"block", "integers"});
  refuse("type: short\nencoding: raw\n" + sizes, {"endian", "missing"});
  for (const std::string encoding : {"bzip2", "hex"}) {
    refuse("type: uchar\nencoding: " + encoding + "\n" + sizes,
           {"encoding", encoding, "raw, gzip or text"});
  }
  refuse("type: short\nencoding: ascii\n" + sizes, {"voxel data", "is no i16"});
  refuse("type: uchar\nencoding: gzip\n" + sizes, {"gzip"});
  refuse("type: uchar\nencoding: raw\ndimension: 2\nsizes: 4 2\n", {"2 axes"});
  refuse("type: uchar\nencoding: raw\ndimension: 3\nsizes: 2 2 x\n", {"sizes", "2 2 x"});
  refuse("type: uchar\nencoding: raw\ndimension: 3\nsizes: 2 2 3\n", {"12 bytes", "holds 8"});
  std::string ones, nones;
  for (int i = 0; i < 14; ++i) {
    ones += " 1";
    nones += " none";
  }
  refuse("type: uchar\nencoding: raw\ndimension: 17\nsizes: 2 2 2" + ones + "\n", {"17 axes"});
  const std::string vectors = "space directions: (1,0,0) (0,1,0) (0,0,1)" + nones;
  const std::string most = "type: uchar\nencoding: raw\ndimension: 16\nsizes: 2 2 2" +
                           ones.substr(2) + "\n" + vectors.substr(0, vectors.size() - 5) + "\n";
  EXPECT_EQ(read_all(*open_volume(dir.file("d.nrrd", "NRRD0004\n" + most + "\n" + kEight))).size(),
            8U);
  refuse(good + "spacings: 1 nan 1\n", {"spacings", "--spacing"});
  refuse(good + "space directions: none (1,0,0) (0,1,0)\n", {"space directions"});
  refuse(good + "space origin: (0,inf,0)\n", {"space origin"});
  refuse(good + "line skip: 1\n", {"line skip"});
  refuse(good + "byte skip: -2\n", {"byte skip"});
  refuse(good + "data file: LIST\n", {"data file"});
  refuse(good + "data file: gone.raw\n", {"data file", "gone.raw"});
  expect_refused(dir, "b.nrrd", "plain text", {"magic"});
  // A header from a stranger opens nothing outside of its folder, unless the user says so.
  const auto data = dir.file("a.raw", kEight);
  for (const std::string& name : {data.string(), std::string("../a.raw")}) {
    refuse(good + "data file: " + name + "\n", {"data file", "leads out", "--trust-paths"});
  }
  const auto header =
      dir.file("c.nrrd", "NRRD0004\n" + good + "data file: " + data.string() + "\n\n");
  EXPECT_EQ(read_all(*open_volume(header, {.trust_paths = true})).size(), 8U);
}

TEST(VolumeErrors, DicomSaysWhatToDo) {
  const TempDir dir;
  const std::string content = std::string(128, '\0') + "DICM" + std::string(500, 'x');
  expect_refused(dir, "slice1", content, {"DICOM structure"});
  expect_refused(dir, "slice.dcm", "anything", {"DICOM structure", "complete"});
  expect_error(ErrorKind::kInput, {dir.path().string(), "DICOM", "segmentation"},
               [&] { static_cast<void>(open_volume(dir.path())); });
}

TEST(VolumeErrors, Raw) {
  const TempDir dir;
  const auto path = dir.file("a.bin", kEight);
  const auto open = [&](Index3 shape) {
    const OpenOptions options{.raw = RawLayout{shape, VoxelType::kU8}, .spacing = {}, .origin = {}};
    return open_volume(path, options);
  };
  EXPECT_EQ(open({2, 2, 2})->info().format, "raw");
  expect_error(ErrorKind::kInput, {path.string(), "12 bytes", "holds 8"}, [&] {
    static_cast<void>(open({2, 2, 3}));
  });
  expect_error(ErrorKind::kInput, {path.string(), "4 bytes", "holds 8"}, [&] {
    static_cast<void>(open({2, 2, 1}));
  });
  expect_error(ErrorKind::kInput, {path.string(), "shape (z)"}, [&] {
    static_cast<void>(open({2, 2, 0}));
  });
}

}  // namespace
}  // namespace mw::io
