// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels in floats and behind a slope and intercept.
#include "io/volume/decode.h"
#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/mesh/open_mesh.h"
#include "io/names/read_names.h"
#include "io/volume/cropped_volume.h"
#include "io/volume/hdf5/open_hdf5.h"
#include "io/volume/open_volume.h"
#include "io/volume/tiff/open_tiff.h"
#include "tests/io/labels/memory_volume.h"
#include "tests/io/mesh/sample_mesh.h"
#include "tests/io/volume/sample_files.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

template <class Real>
std::string real_bytes(const std::vector<double>& values, bool big) {
  std::string bytes;
  for (const double value : values) {
    const auto real = static_cast<Real>(value);
    std::uint64_t bits = 0;
    std::memcpy(&bits, &real, sizeof real);
    bytes += number_bytes(bits, sizeof real, big);
  }
  return bytes;
}

TEST(Floats, WholeNumbersAreLabels) {
  const TempDir dir;
  const std::vector<double> values{0, 1, -3, 16777215, 255, 1048576, -0.0, 7};
  const std::vector<RawLabel> labels{0, 1, ~std::uint64_t{2}, 16777215, 255, 1048576, 0, 7};
  for (const bool big : {false, true}) {
    const std::string order = big ? ">" : "<";
    const auto narrow = dir.file(
        "a.npy", npy_file(order + "f4", false, "(2, 2, 2)", real_bytes<float>(values, big)));
    const auto wide = dir.file(
        "b.npy", npy_file(order + "f8", false, "(2, 2, 2)", real_bytes<double>(values, big)));
    EXPECT_EQ(read_all(*open_volume(narrow)), labels);
    EXPECT_EQ(read_all(*open_volume(wide)), labels);
    EXPECT_TRUE(has_signed_labels(open_volume(wide)->info()));
  }
}

TEST(Floats, TheFirstThatIsNoLabelIsNamed) {
  const TempDir dir;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad :
       {1.5, 1.002, nan, std::numeric_limits<double>::infinity(), 0x1p63, 1e300}) {
    for (std::size_t position = 0; position < 12; ++position) {
      std::vector<double> values(12, 4);
      values[position] = bad;
      const auto path =
          dir.file("a.npy", npy_file("<f8", false, "(2, 2, 3)", real_bytes<double>(values, false)));
      const std::string where = "voxel (" + std::to_string(position % 3) + ", " +
                                std::to_string(position / 3 % 2) + ", " +
                                std::to_string(position / 6) + ")";
      const std::string why = bad > 2 && std::isfinite(bad) ? "64 bits" : "not a whole number";
      expect_not_read(path, {"a.npy", where, why});
    }
  }
}

TEST(Floats, NearlyWholeNumbersAreRoundedAndCounted) {
  const TempDir dir;
  const std::vector<double> values{0, 0.9991, 2.0009, -3.0001, 1e-7, -1e-7, 5, 7};
  const std::vector<RawLabel> labels{0, 1, 2, static_cast<RawLabel>(-3), 0, 0, 5, 7};
  const auto path =
      dir.file("a.npy", npy_file("<f8", false, "(2, 2, 2)", real_bytes<double>(values, false)));
  const std::uint64_t before = rounded_voxels();
  EXPECT_EQ(read_all(*open_volume(path)), labels);
  EXPECT_GE(rounded_voxels(), before + 5);
  EXPECT_EQ((rounded_voxels() - before) % 5, 0U);  // of the two that are whole, and of 0, none is
}

TEST(Scaling, KeepsIntegersOrSaysWhichItDoesNot) {
  const TempDir dir;
  NiftiSample sample{.dim = {3, 3, 1, 1, 1, 1, 1, 1}, .slope = 2, .inter = -5, .magic = {}};
  const auto open = [&](const std::string& voxels) {
    return open_volume(dir.file("a.nii", sample.header() + voxels));
  };
  EXPECT_EQ(read_all(*open(std::string("\0\1\7", 3))),
            (std::vector<RawLabel>{static_cast<RawLabel>(-5), static_cast<RawLabel>(-3), 9}));
  EXPECT_TRUE(has_signed_labels(open("abc")->info()));
  sample.slope = 0.5;
  sample.inter = 1;
  EXPECT_EQ(read_all(*open("\4\2\6")), (std::vector<RawLabel>{3, 2, 4}));
  expect_error(ErrorKind::kInput, {"a.nii", "voxel (2, 0, 0)", "times 0.5", "whole"},
               [&] { static_cast<void>(read_all(*open("\4\2\7"))); });
  sample.slope = 0;  // says that nothing is scaled
  EXPECT_EQ(read_all(*open("\4\2\6")), (std::vector<RawLabel>{4, 2, 6}));
}

TEST(Scaling, LargeIntegersLoseNothing) {
  const std::vector<RawLabel> stored{(1ULL << 60) + 1, 3};
  const std::string bytes = voxel_bytes(stored, VoxelType::kU64, false);
  std::vector<RawLabel> out(2);
  const VoxelCoding coding{VoxelType::kU64, ByteOrder::kLittle, {.slope = 2, .intercept = 1}};
  const auto* data = reinterpret_cast<const std::byte*>(bytes.data());
  EXPECT_EQ(decode_voxels(data, 2, 1, coding, out.data(), 1), 2U);
  EXPECT_EQ(out[0], (1ULL << 61) + 3);
  const VoxelCoding much{VoxelType::kU64, ByteOrder::kLittle, {.slope = 1024, .intercept = 0}};
  EXPECT_EQ(decode_voxels(data, 2, 1, much, out.data(), 1), 0U);
}

// A few packed bytes may unpack to any number: no more are unpacked than the header asks for.

constexpr Index3 kShape{5, 4, 3};

/// The content, then more zeros than any header may have, and damage: a reader that unpacks that
/// far learns of it.
std::string bomb(const std::string& content) {
  std::string damaged = gzip("the end of it");
  damaged[damaged.size() - 5] = static_cast<char>(damaged[damaged.size() - 5] ^ 1);
  return gzip(content + std::string(20 << 20, '\0')) + damaged;
}

class PackedBytes : public testing::Test {
 protected:
  void expect_read(const std::string& name, const std::string& file) const {
    const auto path = dir_.file(name, file);
    EXPECT_EQ(read_all(*open_volume(path)), labels_) << name;
  }

  TempDir dir_;
  std::vector<RawLabel> labels_ = sample_labels(kShape, VoxelType::kU8);
  std::string voxels_ = voxel_bytes(labels_, VoxelType::kU8, false);
};

TEST_F(PackedBytes, BehindTheVoxelsAreNotUnpacked) {
  const std::string nrrd = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 5 4 3\n";
  const std::string mha =
      "ObjectType = Image\nNDims = 3\nDimSize = 5 4 3\nElementType = MET_UCHAR\n";
  expect_read("a.npy.gz", bomb(npy_file("|u1", false, "(3, 4, 5)", voxels_)));
  expect_read("a.nii.gz", bomb(NiftiSample{.magic = {}}.header() + voxels_));
  expect_read("a.nrrd.gz", bomb(nrrd + "encoding: raw\n\n" + voxels_));
  expect_read("a.nrrd", nrrd + "encoding: gzip\n\n" + bomb(voxels_));
  expect_read("b.nrrd", nrrd + "encoding: gzip\nbyte skip: 7\n\n" + bomb("1234567" + voxels_));
  expect_read("a.mha.gz", bomb(mha + "ElementDataFile = LOCAL\n" + voxels_));
  expect_read("a.mha", mha + "CompressedData = True\nElementDataFile = LOCAL\n" + bomb(voxels_));
  expect_read("b.mha.gz",
              bomb(mha + "CompressedData = True\nElementDataFile = LOCAL\n" + gzip(voxels_)));
}

TEST_F(PackedBytes, OfARawVolumeMustBeAsManyAsItsVoxels) {
  const OpenOptions options{.raw = RawLayout{kShape, VoxelType::kU8}, .spacing = {}, .origin = {}};
  EXPECT_EQ(read_all(*open_volume(dir_.file("a.gz", gzip(voxels_)), options)), labels_);
  const auto more = dir_.file("b.gz", bomb(voxels_));
  expect_not_opened(more, {"b.gz", "needs 60 bytes", "holds at least 960"}, options);
}

TEST_F(PackedBytes, BehindAMeshAreNotUnpacked) {
  const auto path = dir_.path() / "m.mesh";
  write_mesh(sample_mesh(7, false), *open_mesh_sink(path));
  const MeshData good = read_mesh(path);
  const MeshData same = read_mesh(dir_.file("n.mesh", bomb(content_of(path))));
  EXPECT_EQ(same.vertices, good.vertices);
  EXPECT_EQ(same.tets, good.tets);
}

TEST_F(PackedBytes, OfATableOfNamesAreLimited) {
  const std::string many(kMaxNamesBytes + 1, ' ');
  expect_error(ErrorKind::kInput, {"n.csv", "more than"},
               [&] { static_cast<void>(read_names(dir_.file("n.csv", bomb(many)))); });
}

TEST_F(PackedBytes, WithoutXmlAreNoXml) {
  for (const char* name : {"m.vtu", "m.pvtu"}) {
    const auto path = dir_.file(name, bomb(""));
    expect_error(ErrorKind::kInput, {name}, [&] { static_cast<void>(read_mesh(path)); });
  }
}

using Open = std::unique_ptr<LabelVolume> (*)(std::unique_ptr<ByteSource>, const OpenOptions&);

struct Bomb {
  const char* name;
  std::string head;
  Open open;
};

/// Formats that are read from their end: each begins as its format does, and goes on with 200 MB of
/// nothing.
TEST(GzipBombs, AreGivenUpWhenTheyHaveFilledTheirRoom) {
  const TempDir dir;
  constexpr std::uint64_t kMax = 8 << 20;
  const std::vector<Bomb> bombs{{"a.tif.gz", std::string("II*\0\x08\0\0\0", 8), open_tiff},
                                {"a.h5.gz", "\x89HDF\r\n\x1a\n", open_hdf5}};
  for (const Bomb& bomb : bombs) {
    const auto path = dir.file(bomb.name, gzip(bomb.head + std::string(200'000'000, '\0')));
    ASSERT_LE(std::filesystem::file_size(path), 1U << 20);
    expect_error(ErrorKind::kResource, {bomb.name, "more than 8388608 bytes", "TMPDIR"}, [&] {
      static_cast<void>(bomb.open(
          std::make_unique<InflatedSource>(std::make_unique<FileSource>(path), 0, kMax), {}));
    });
  }
}

// Crops against the whole volume, and where they lie.

constexpr Index3 kWhole{7, 5, 6};

std::string npy() {
  const std::vector<RawLabel> labels = sample_labels(kWhole, VoxelType::kU16);
  return npy_file("<u2", false, "(6, 5, 7)", voxel_bytes(labels, VoxelType::kU16, false));
}

TEST(CroppedVolume, ReadsItsBoxOfTheWhole) {
  const TempDir dir;
  const auto path = dir.file("v.npy", npy());
  const MemoryVolume whole(kWhole, VoxelType::kU16, sample_labels(kWhole, VoxelType::kU16));
  std::mt19937 random(8);
  for (int i = 0; i < 300 && !testing::Test::HasFailure(); ++i) {
    OpenOptions options;
    options.crop = random_box(random, kWhole);
    const auto volume = open_volume(path, options);
    EXPECT_EQ(volume->info().shape, options.crop->shape());
    std::vector<RawLabel> wanted(static_cast<std::size_t>(options.crop->voxels()));
    whole.read(*options.crop, wanted);
    EXPECT_EQ(read_all(*volume), wanted);
    expect_box(*volume, wanted, random);
  }
}

/// The corner of a voxel stays where it was, unless the origin is given.
TEST(CroppedVolume, LiesWhereItLayInTheWhole) {
  auto whole = std::make_unique<MemoryVolume>(
      kWhole, VoxelType::kU16, std::vector<RawLabel>(static_cast<std::size_t>(kWhole.product())));
  VolumeSpace& space = whole->info().space;
  space = {.spacing = {0.5, 2, 3}, .origin = {10, 20, 30}};
  space.axes = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
  whole->info().chunk = {4, 4, 4};
  const VolumeSpace before = space;
  OpenOptions options;
  options.crop = Box3{{1, 2, 3}, {4, 4, 4}};
  const auto part = cropped(std::move(whole), "v", options);
  EXPECT_EQ(to_world(part->info().space, {0.5, 1, 0}), to_world(before, {1.5, 3, 3}));
  EXPECT_EQ(part->info().chunk, (Index3{4, 4, 4}));

  const TempDir dir;
  options.origin = {1, 2, 3};
  const auto placed = open_volume(dir.file("v.npy", npy()), options);
  EXPECT_EQ(placed->info().space.origin, (Vector3{1, 2, 3}));
}

/// A box counts as the data set does, which gives its first voxel a number.
TEST(CroppedVolume, CountsFromTheOffset) {
  const std::vector<RawLabel> labels = sample_labels(kWhole, VoxelType::kU16);
  const MemoryVolume whole(kWhole, VoxelType::kU16, labels);
  std::mt19937 random(9);
  const Index3 offset{26, -30, 14};
  for (int i = 0; i < 50 && !testing::Test::HasFailure(); ++i) {
    auto volume = std::make_unique<MemoryVolume>(kWhole, VoxelType::kU16, labels);
    volume->info().offset = offset;
    const Box3 box = random_box(random, kWhole);
    OpenOptions options;
    options.crop = Box3{box.lo + offset, box.hi + offset};
    const auto part = cropped(std::move(volume), "v", options);
    std::vector<RawLabel> wanted(static_cast<std::size_t>(box.voxels()));
    whole.read(box, wanted);
    EXPECT_EQ(read_all(*part), wanted);
    EXPECT_EQ(part->info().first, box.lo);
    EXPECT_EQ(first_number(part->info()), options.crop->lo);
  }
  auto volume = std::make_unique<MemoryVolume>(kWhole, VoxelType::kU16, labels);
  volume->info().offset = offset;
  OpenOptions options;
  options.crop = Box3{{0, 0, 0}, {2, 2, 2}};
  expect_error(ErrorKind::kUsage,
               {"--crop 0,0,0,2,2,2", "26,-30,14,33,-25,20", "0,0,0,7,5,6 in its array"},
               [&] { (void)cropped(std::move(volume), "v", options); });
}

TEST(CroppedVolume, RefusesWhatIsNoBoxOfTheVolume) {
  const TempDir dir;
  const auto path = dir.file("v.npy", npy());
  for (const Box3 crop :
       {Box3{{0, 0, 0}, {8, 5, 6}}, Box3{{-1, 0, 0}, {7, 5, 6}}, Box3{{0, 0, 0}, {7, 5, 7}},
        Box3{{3, 0, 0}, {3, 5, 6}}, Box3{{0, 4, 0}, {7, 3, 6}}, Box3{{9, 9, 9}, {10, 10, 10}}}) {
    OpenOptions options;
    options.crop = crop;
    expect_error(ErrorKind::kUsage, {"--crop", "v.npy", "7 x 5 x 6"},
                 [&] { (void)open_volume(path, options); });
  }
}

}  // namespace
}  // namespace mw::io
