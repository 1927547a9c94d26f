// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Every broken or unsupported volume is refused with a message that names file and field.
#include <limits>

#include "io/volume/open_volume.h"
#include "tests/io/volume/sample_files.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

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
  for (const char* ending : {".npy", ".nii", ".nrrd", ".mha", ".h5", ".tif", ".png"}) {
    EXPECT_NE((volume_endings() + ",").find(text(ending, ",")), std::string::npos) << ending;
  }
  EXPECT_EQ(formats_with_datasets(), "HDF5, neuroglancer precomputed, N5, Zarr");
  EXPECT_EQ(formats_with_scales(), "neuroglancer precomputed, N5, Zarr");
  EXPECT_EQ(volume_folders(), formats_with_scales() + ", TIFF or PNG slices");
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
    bend([](NiftiSample& s) { s.dim = {4, 5, 4, 3, 2, 1, 1, 1}; }, {"dim[4]"});
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
  expect_error(ErrorKind::kUsage, {"spacing must be finite and positive"},
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
  refuse("type: uchar\nencoding: ascii\n" + sizes, {"encoding", "ascii"});
  refuse("type: uchar\nencoding: gzip\n" + sizes, {"gzip"});
  refuse("type: uchar\nencoding: raw\ndimension: 2\nsizes: 4 2\n", {"2 axes"});
  refuse("type: uchar\nencoding: raw\ndimension: 3\nsizes: 2 2 x\n", {"sizes", "2 2 x"});
  refuse("type: uchar\nencoding: raw\ndimension: 3\nsizes: 2 2 3\n", {"12 bytes", "holds 8"});
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
  expect_refused(dir, "slice1", content, {"DICOM", "dcm2niix", "3D Slicer"});
  expect_refused(dir, "slice.dcm", "anything", {"DICOM", "dcm2niix"});
  expect_error(ErrorKind::kInput, {dir.path().string(), "DICOM", "dcm2niix"},
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
