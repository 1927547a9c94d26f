// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Damaged and hostile HDF5 files: an error, never a crash, and no more memory than the data need.
#include "io/file/source/file_source.h"
#include "io/volume/hdf5/description.h"
#include "io/volume/hdf5/open_hdf5.h"
#include "io/volume/open_volume.h"
#include "tests/io/volume/hdf5/hdf5_files.h"
#include "tests/io/volume/volume_checks.h"
#include "tests/peak_growth.h"

namespace mw::io {
namespace {

/// A small file of each kind of storage; where the data sets are and what they say is not the same.
std::string small_file(const TempDir& dir, bool latest) {
  const auto path = dir.path() / "good.h5";
  {
    const Hdf5Handle file = create_hdf5(path, latest);
    Hdf5Sample sample{.layout = H5D_CHUNKED, .fill = 7};
    sample.chunk = {2, 2, 3};
    sample.shuffle = sample.deflate = sample.fletcher = true;
    write_data_set(file, "/volumes/labels/neuron_ids", sample, labels_of(sample));
    write_attribute(file, "/volumes/labels/neuron_ids", "resolution", {40, 4, 4});
    write_text_attribute(file, "/volumes/labels/neuron_ids", "axistags",
                         R"({"axes": [{"key": "z"}, {"key": "y"}, {"key": "x"}]})", true);
  }
  return content_of(path);
}

/// Each `step`-th place of good files of both kinds, damaged by damage(bytes, place): read or
/// refused.  Returns how many were refused, and how many tried, of each kind.
template <class Damage>
std::vector<std::pair<int, int>> refused_of_tried(std::size_t step, Damage damage) {
  const TempDir dir;
  std::vector<std::pair<int, int>> counts;
  for (const bool latest : {false, true}) {
    const std::string good = small_file(dir, latest);
    auto& [refused, tried] = counts.emplace_back(0, 0);
    for (std::size_t at = 0; at < good.size(); at += step, ++tried) {
      std::string bad = good;
      damage(bad, at);
      write_file(dir.path() / "bad.h5", bad);
      refused += is_refused(dir.path() / "bad.h5", {}, text("at ", at)) ? 1 : 0;
    }
  }
  return counts;
}

TEST(Hdf5Damage, EightBytesOfOnesAnywhere) {
  const auto damage = [](std::string& bytes, std::size_t at) {
    const std::size_t count = std::min<std::size_t>(8, bytes.size() - at);
    bytes.replace(at, count, count, '\xff');
  };
  for (const auto& [refused, tried] : refused_of_tried(8, damage)) EXPECT_GT(refused, 20);
}

TEST(Hdf5Damage, FlippedBits) {
  const auto damage = [](std::string& bytes, std::size_t at) {
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (at % 8)));
  };
  for (const auto& [refused, tried] : refused_of_tried(7, damage)) EXPECT_GT(refused, 20);
}

TEST(Hdf5Damage, Truncation) {
  const auto damage = [](std::string& bytes, std::size_t at) { bytes.resize(at); };
  for (const auto& [refused, tried] : refused_of_tried(17, damage)) EXPECT_EQ(refused, tried);
}

/// Cell data of DREAM.3D 7, whose spacing is in data sets of their own, and axes told by a text
/// that lies apart from its attribute.
std::string placed_file(const TempDir& dir, bool latest) {
  const auto path = dir.path() / "good.h5";
  {
    const Hdf5Handle file = create_hdf5(path, latest);
    Hdf5Sample sample{.shape = {3, 4, 5}, .layout = H5D_CHUNKED};
    sample.chunk = {3, 4, 5};
    const std::string image = "/DataContainers/Image/";
    write_data_set(file, image + "CellData/FeatureIds", sample, labels_of(sample));
    const Hdf5Sample numbers{.shape = {3}, .type = VoxelType::kF32};
    write_data_set(file, image + "_SIMPL_GEOMETRY/SPACING", numbers, {2, 3, 4});
    write_data_set(file, image + "_SIMPL_GEOMETRY/ORIGIN", numbers, {10, 20, 30});
    write_text_attribute(file, image + "CellData/FeatureIds", "axistags",
                         R"({"axes": [{"key": "x"}, {"key": "y"}, {"key": "z"}]})", true);
  }
  return content_of(path);
}

/// Names by which things are looked up: after damage to them there is nothing of that name.
std::vector<bool> where_names_are(const std::string& bytes) {
  std::vector<bool> out(bytes.size());
  for (const std::string name : {"_SIMPL_GEOMETRY", "SPACING", "axistags"}) {
    for (std::size_t at = bytes.find(name); at != bytes.npos; at = bytes.find(name, at + 1)) {
      std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(at), name.size() + 1, true);
    }
  }
  return out;
}

/// What cannot be read is not taken for what is not there: spacing and axes are the file's, be they
/// damaged, and not those of a file that tells none.
TEST(Hdf5Damage, WhereItLiesIsNotForgotten) {
  const TempDir dir;
  for (const bool latest : {false, true}) {
    const std::string good = placed_file(dir, latest);
    const std::vector<bool> named = where_names_are(good);
    int refused = 0;
    for (std::size_t at = 0; at < good.size(); at += 4) {
      if (named[at] || named[std::min(at + 3, good.size() - 1)]) continue;
      std::string bad = good;
      bad.replace(at, 4, std::min<std::size_t>(4, good.size() - at), '\xff');
      try {
        const VolumeInfo info = open_volume(dir.file("bad.h5", bad))->info();
        EXPECT_NE(info.space.spacing, (std::array<double, 3>{1, 1, 1})) << latest << " " << at;
        EXPECT_EQ(info.shape, (Index3{3, 4, 5})) << latest << " " << at;
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::kInput) << error.what();
        ++refused;
      }
    }
    EXPECT_GT(refused, 20);
  }
}

TEST(Hdf5Damage, OtherFilesAndMeshes) {
  const TempDir dir;
  const auto refuse = [&](const std::filesystem::path& path,
                          const std::vector<std::string>& pieces) {
    expect_not_opened(path, pieces);
  };
  refuse(dir.file("a.h5", "what is this"), {"a.h5", "HDF5 structure", "signature"});
  const auto mesh = dir.path() / "a.vtkhdf";
  {
    const Hdf5Handle file = create_hdf5(mesh);
    write_data_set(file, "/VTKHDF/Points", {.shape = {4, 3}}, labels_of({.shape = {4, 3}}));
  }
  refuse(mesh, {"a.vtkhdf", "VTKHDF", "mesh"});
}

class Hdf5Refused : public ::testing::Test {
 protected:
  void expect_refused(const std::vector<std::string>& pieces) {
    expect_error(ErrorKind::kInput, pieces, [&] {
      OpenOptions options;
      options.dataset = "a";
      static_cast<void>(open_volume(path_, options));
    });
  }

  TempDir dir_;
  std::filesystem::path path_ = dir_.path() / "a.h5";
};

TEST_F(Hdf5Refused, FiltersThatAreNotKnown) {
  Hdf5Sample sample{.layout = H5D_CHUNKED};
  sample.chunk = {3, 4, 5};
  for (const auto& [id, name] : std::vector<std::pair<unsigned, std::string>>{
           {32008, "32008 (bitshuffle)"}, {32013, "32013 (zfp)"}, {400, "filter 400"}}) {
    {
      const Hdf5Handle file = create_hdf5(path_);
      sample.other_filter = id;
      create_data_set(file, "/a", sample);
    }
    expect_refused({path_.string(), "data set /a", name, "h5repack -f GZIP=4"});
  }
}

TEST_F(Hdf5Refused, TypesThatAreNoNumbers) {
  const Hdf5Handle odd(H5Tcopy(H5T_STD_U32LE), &H5Tclose);
  H5Tset_precision(odd.get(), 20);
  const Hdf5Handle pair(H5Tcreate(H5T_COMPOUND, 8), &H5Tclose);
  H5Tinsert(pair.get(), "x", 0, H5T_STD_I32LE);
  const Hdf5Handle string(H5Tcopy(H5T_C_S1), &H5Tclose);
  for (const auto& [type, name] : std::vector<std::pair<hid_t, std::string>>{
           {odd.get(), "odd bits"}, {pair.get(), "compound"}, {string.get(), "strings"}}) {
    {
      const Hdf5Handle file = create_hdf5(path_);
      const std::array<hsize_t, 3> shape{2, 2, 2};
      const Hdf5Handle space(H5Screate_simple(3, shape.data(), nullptr), &H5Sclose);
      const Hdf5Handle set(
          H5Dcreate2(file.get(), "/a", type, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
          &H5Dclose);
    }
    expect_refused({path_.string(), "data set /a", name, "integers of 8 to 64 bits"});
  }
}

TEST_F(Hdf5Refused, VoxelsElsewhereOrNowhere) {
  const std::array<hsize_t, 3> shape{2, 2, 2};
  const Hdf5Handle space(H5Screate_simple(3, shape.data(), nullptr), &H5Sclose);
  const auto create = [&](hid_t storage) {
    const Hdf5Handle file = create_hdf5(path_, /*latest=*/true);
    const Hdf5Handle set(
        H5Dcreate2(file.get(), "/a", H5T_STD_U8LE, space.get(), H5P_DEFAULT, storage, H5P_DEFAULT),
        &H5Dclose);
    EXPECT_TRUE(set.valid());
  };
  const Hdf5Handle external(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
  H5Pset_external(external.get(), dir_.file("raw", "12345678").c_str(), 0, 8);
  create(external.get());
  expect_refused({"other files", "external"});
  const Hdf5Handle of_others(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
  H5Pset_virtual(of_others.get(), space.get(), "b.h5", "/b", space.get());
  create(of_others.get());
  expect_refused({"other files", "virtual"});
  create(H5P_DEFAULT);
  expect_refused({"nothing was written"});
}

TEST_F(Hdf5Refused, ShapesAndNumbersOfChunksThatAreTooLarge) {
  Hdf5Sample sample{.shape = {1 << 20, 1 << 20, 1 << 20}, .layout = H5D_CHUNKED};
  sample.chunk = {1, 1, 1};
  {
    const Hdf5Handle file = create_hdf5(path_);
    create_data_set(file, "/a", sample);
  }
  expect_refused({"/a", "4194304 chunks", "h5repack"});
  sample.shape = {4, hsize_t{1} << 21, 4};
  sample.chunk = {4, 1 << 20, 4};
  {
    const Hdf5Handle file = create_hdf5(path_);
    create_data_set(file, "/a", sample);
  }
  expect_refused({"/a", "shape (y)", "2097152", "1048576"});
}

std::string packed_zeros(std::size_t count) {
  const std::string zeros(count, '\0');
  uLongf size = compressBound(count);
  std::string packed(size, '\0');
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
            reinterpret_cast<const Bytef*>(zeros.data()), count, 1);
  packed.resize(size);
  return packed;
}

/// A kilobyte unpacks to a quarter of a megabyte: of a bomb no more comes out than the chunk has.
TEST(Hdf5Bombs, MemoryStaysWithinTheChunk) {
  const TempDir dir;
  Hdf5Sample sample{.shape = {8, 8, 8}, .type = VoxelType::kU8, .layout = H5D_CHUNKED};
  sample.chunk = {8, 8, 8};
  sample.deflate = true;
  const auto path = dir.path() / "bomb.h5";
  {
    const std::string bomb = packed_zeros(64 << 20);
    const Hdf5Handle file = create_hdf5(path);
    const Hdf5Handle set = create_data_set(file, "/a", sample);
    const std::array<hsize_t, 3> corner{0, 0, 0};
    ASSERT_GE(H5Dwrite_chunk(set.get(), H5P_DEFAULT, 0, corner.data(), bomb.size(), bomb.data()),
              0);
  }
  const long growth = test::growth_of([&] {
    const auto volume = open_volume(path);
    expect_error(ErrorKind::kInput, {path.string(), "chunk (0, 0, 0)", "512 bytes"},
                 [&] { static_cast<void>(read_all(*volume)); });
  });
  EXPECT_GE(growth, 0);
  EXPECT_LT(growth, 16 << 10);
}

TEST(Hdf5Description, BytesThatAreNoDescriptionAreRefused) {
  Hdf5Description whole{.path = "/a", .shape = {2, 2, 2}, .layout = Hdf5Layout::kChunked};
  whole.chunk_shape = {1, 2, 2};
  whole.filters = {{1, 4}, {2, 0}};
  whole.fill = "x";
  whole.chunks = {{0, 10, 4, 0}, {1, 14, 4, 2}};
  whole.numbers["resolution"] = {1, 2, 3};
  const std::string packed = pack(whole);
  const auto back = unpack_description(packed);
  ASSERT_TRUE(back);
  EXPECT_EQ(pack(*back), packed);
  EXPECT_EQ(back->chunks[1].offset, 14U);
  for (std::size_t length = 0; length < packed.size(); ++length) {
    EXPECT_FALSE(unpack_description(packed.substr(0, length))) << length;
  }
  for (std::size_t at = 0; at < packed.size(); ++at) {
    std::string bad = packed;
    bad[at] = '\xff';
    static_cast<void>(unpack_description(bad));  // whatever it is, it ends
  }
}

TEST(Hdf5Description, WhatIsNotInTheFileIsRefused) {
  const TempDir dir;
  const FileSource file(dir.file("a.h5", std::string(100, 'a')));
  Hdf5Description good{.path = "/a", .shape = {2, 2, 2}, .layout = Hdf5Layout::kChunked};
  good.chunk_shape = {1, 2, 2};
  good.fill = "x";
  good.chunks = {{0, 10, 50, 0}, {1, 60, 40, 0}};
  check_description(file, good);
  const auto refuse = [&](auto change, const char* piece) {
    Hdf5Description bad = good;
    change(bad);
    expect_error(ErrorKind::kInput, {"a.h5", "/a", piece}, [&] { check_description(file, bad); });
  };
  refuse([](auto& d) { d.chunks[1].bytes = 41; }, "outside");
  refuse([](auto& d) { d.chunks[1].offset = UINT64_MAX; }, "outside");
  refuse([](auto& d) { d.chunks[1].number = 0; }, "order");
  refuse([](auto& d) { d.chunks[0].bytes = 61; }, "overlap");
  refuse([](auto& d) { d.chunk_shape = {2, 2}; }, "axes");
  refuse([](auto& d) { d.chunk_shape = {1, 0, 2}; }, "empty");
  refuse([](auto& d) { d.fill = "xy"; }, "fill");
  refuse([](auto& d) { d.layout = Hdf5Layout::kContiguous, d.offset = 93; }, "holds 7");
  refuse([](auto& d) { d.layout = Hdf5Layout::kContiguous, d.offset = UINT64_MAX; }, "holds 0");
  refuse([](auto& d) { d.layout = Hdf5Layout::kCompact, d.bytes = "1234567"; }, "as long as");
  refuse([](auto& d) { d.layout = Hdf5Layout::kCompact, d.shape = {UINT64_MAX, 2, 3}; }, "long");
}

TEST(Hdf5Filters, DamageIsFound) {
  const std::vector<Hdf5Filter> checksum{{3}};
  std::vector<std::byte> stored(20, std::byte{5});
  expect_error(ErrorKind::kInput, {"chunk", "fletcher32", "checksum"}, [&] {
    static_cast<void>(unfilter(checksum, stored, {.bytes = 16, .name = "chunk"}));
  });
  expect_error(ErrorKind::kInput, {"chunk", "20 bytes", "need 16"}, [&] {
    static_cast<void>(unfilter(checksum, stored, {.skipped = 1, .bytes = 16, .name = "chunk"}));
  });
  stored.resize(3);
  expect_error(ErrorKind::kInput, {"chunk", "fletcher32", "truncated"}, [&] {
    static_cast<void>(unfilter(checksum, stored, {.bytes = 16, .name = "chunk"}));
  });
}

}  // namespace
}  // namespace mw::io
