// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A few packed bytes may unpack to any number: no more are unpacked than the header asks for.
#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/mesh/open_mesh.h"
#include "io/names/read_names.h"
#include "io/volume/hdf5/open_hdf5.h"
#include "io/volume/open_volume.h"
#include "io/volume/tiff/open_tiff.h"
#include "tests/io/mesh/sample_mesh.h"
#include "tests/io/volume/sample_files.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

constexpr Index3 kShape{5, 4, 3};

/// The content, then more zeros than any header may have, and damage: a reader that unpacks that
/// far reports it.
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

}  // namespace
}  // namespace mw::io
