// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Every layout, type, filter and index of chunks of HDF5 gives back the labels that were written.
#include <cmath>
#include <limits>

#include "io/volume/number_volume.h"
#include "io/volume/open_volume.h"
#include "tests/io/codec/packers.h"
#include "tests/io/volume/hdf5/hdf5_files.h"
#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

constexpr VoxelType kEveryType[] = {
    VoxelType::kU8,  VoxelType::kU16, VoxelType::kU32, VoxelType::kU64, VoxelType::kI8,
    VoxelType::kI16, VoxelType::kI32, VoxelType::kI64, VoxelType::kF32, VoxelType::kF64};

std::filesystem::path one_data_set(const TempDir& dir, const Hdf5Sample& sample,
                                   const std::vector<RawLabel>& labels, bool latest = false) {
  auto path = dir.path() / "a.h5";
  const Hdf5Handle file = create_hdf5(path, latest);
  write_data_set(file, "/labels", sample, labels);
  return path;
}

void expect_same(const TempDir& dir, const Hdf5Sample& sample, bool latest = false) {
  const auto labels = labels_of(sample);
  OpenOptions options;
  options.dataset = "labels";  // floats are not taken for labels unasked
  const auto volume = open_volume(one_data_set(dir, sample, labels, latest), options);
  EXPECT_EQ(volume->info().type, sample.type);
  EXPECT_EQ(volume->info().format, "hdf5");
  EXPECT_EQ(read_all(*volume), labels);
}

TEST(Hdf5, EveryTypeByteOrderAndLayout) {
  const TempDir dir;
  for (const VoxelType type : kEveryType) {
    for (const bool big : {false, true}) {
      SCOPED_TRACE(std::string(name(type)) + (big ? " big" : " little"));
      Hdf5Sample sample{.type = type, .big = big};
      expect_same(dir, sample);
      sample.layout = H5D_COMPACT;
      expect_same(dir, sample);
      sample.layout = H5D_CHUNKED;
      sample.chunk = {2, 3, 2};
      expect_same(dir, sample);
      sample.shuffle = sample.deflate = true;
      expect_same(dir, sample);
    }
  }
}

TEST(Hdf5, EverySetOfFilters) {
  const TempDir dir;
  for (int bits = 0; bits < 8; ++bits) {
    for (const unsigned options : {0U, unsigned{H5D_CHUNK_DONT_FILTER_PARTIAL_CHUNKS}}) {
      SCOPED_TRACE(bits);
      Hdf5Sample sample{.shape = {7, 9, 11}, .type = VoxelType::kI32, .layout = H5D_CHUNKED};
      sample.chunk = {3, 4, 5};
      sample.shuffle = (bits & 1) != 0;
      sample.deflate = (bits & 2) != 0;
      sample.fletcher = (bits & 4) != 0;
      sample.chunk_options = options;
      expect_same(dir, sample, options != 0);
    }
  }
}

/// The library indexes chunks in seven ways: one B-tree in old files; in new ones none for a single
/// chunk and for chunks that all exist, and an array or a tree otherwise.
TEST(Hdf5, EveryIndexOfChunks) {
  const TempDir dir;
  const hsize_t any = H5S_UNLIMITED;
  for (const bool latest : {false, true}) {
    for (const bool deflate : {false, true}) {
      Hdf5Sample sample{.shape = {20, 21, 22}, .layout = H5D_CHUNKED, .deflate = deflate};
      for (const auto& max : std::vector<std::vector<hsize_t>>{
               {}, {40, 40, 40}, {any, 21, 22}, {any, any, 22}, {any, any, any}}) {
        sample.max_shape = max;
        for (const auto& chunk : std::vector<std::vector<hsize_t>>{{4, 5, 6}, {20, 21, 22}}) {
          sample.chunk = chunk;
          expect_same(dir, sample, latest);
        }
      }
    }
  }
}

TEST(Hdf5, FillValuesThatAreNoLabelsMatterOnlyWhereTheyAreRead) {
  const TempDir dir;
  const auto path = dir.path() / "a.h5";
  constexpr double kOfNetcdf = 9.969209968386869e+36;
  for (const double fill : {std::numeric_limits<double>::quiet_NaN(), kOfNetcdf, 0.25}) {
    Hdf5Sample sample{.type = VoxelType::kF32, .layout = H5D_CHUNKED, .chunk = {3, 4, 5}};
    sample.real_fill = fill;
    {
      const Hdf5Handle file = create_hdf5(path);
      write_data_set(file, "/whole", sample, labels_of(sample));
      create_data_set(file, "/missing", sample);
    }
    OpenOptions options;
    options.dataset = "/whole";
    EXPECT_EQ(read_all(*open_volume(path, options)), labels_of(sample));
    options.dataset = "/missing";
    const auto volume = open_volume(path, options);
    expect_error(ErrorKind::kInput, {path.string(), "fill value", "no label"},
                 [&] { static_cast<void>(read_all(*volume)); });
    std::vector<double> numbers(60);
    dynamic_cast<const NumberVolume&>(*volume).read_numbers({{0, 0, 0}, {5, 4, 3}}, numbers);
    for (const double number : numbers) {
      EXPECT_TRUE(std::isnan(fill) ? std::isnan(number) : number == fill) << number;
    }
  }
}

TEST(Hdf5, ChunksThatWereNeverWrittenAreTheFillValue) {
  const TempDir dir;
  const auto path = dir.path() / "a.h5";
  for (const bool latest : {false, true}) {
    Hdf5Sample sample{.shape = {4, 6, 8}, .type = VoxelType::kI16, .big = true};
    sample.layout = H5D_CHUNKED;
    sample.chunk = {2, 3, 4};
    sample.fill = -300;
    {
      const Hdf5Handle file = create_hdf5(path, latest);
      const Hdf5Handle set = create_data_set(file, "/labels", sample);
      const std::array<hsize_t, 3> first{2, 0, 4}, size{2, 3, 4};
      const Hdf5Handle position(H5Dget_space(set.get()), &H5Sclose);
      H5Sselect_hyperslab(position.get(), H5S_SELECT_SET, first.data(), nullptr, size.data(),
                          nullptr);
      const Hdf5Handle memory(H5Screate_simple(3, size.data(), nullptr), &H5Sclose);
      const std::vector<std::int64_t> ones(24, 1);
      H5Dwrite(set.get(), H5T_NATIVE_INT64, memory.get(), position.get(), H5P_DEFAULT, ones.data());
    }
    const auto labels = read_all(*open_volume(path));
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const bool written = i / 48 >= 2 && i / 8 % 6 < 3 && i % 8 >= 4;
      ASSERT_EQ(labels[i], written ? 1 : static_cast<RawLabel>(std::int64_t{-300})) << i;
    }
  }
}

TEST(Hdf5, UserBlocksAndGzippedFiles) {
  const TempDir dir;
  const Hdf5Sample sample{.chunk = {2, 2, 2}};
  Hdf5Sample chunked = sample;
  chunked.layout = H5D_CHUNKED;
  const auto labels = labels_of(chunked);
  for (const hsize_t block : {512U, 1024U}) {
    const auto path = dir.path() / "user.h5";
    {
      const Hdf5Handle file = create_hdf5(path, false, block);
      write_data_set(file, "/labels", chunked, labels);
      write_data_set(file, "/same", {}, labels);
    }
    for (const char* name : {"labels", "/same"}) {
      OpenOptions options;
      options.dataset = name;
      EXPECT_EQ(read_all(*open_volume(path, options)), labels) << name << block;
    }
  }
  const auto packed = dir.file("b.h5.gz", gzip(content_of(one_data_set(dir, chunked, labels))));
  EXPECT_EQ(read_all(*open_volume(packed)), labels);
}

TEST(Hdf5, RandomBoxesEqualThePartOfTheWhole) {
  const TempDir dir;
  Hdf5Sample sample{.shape = {30, 40, 50}, .type = VoxelType::kU64, .layout = H5D_CHUNKED};
  sample.chunk = {7, 8, 9};
  sample.shuffle = sample.deflate = true;
  const auto labels = labels_of(sample);
  const auto path = one_data_set(dir, sample, labels);
  OpenOptions options;
  options.cache_bytes = 1 << 14;  // a few chunks, so that they come and go
  const auto volume = open_volume(path, options);
  EXPECT_EQ(volume->info().chunk, (Index3{9, 8, 7}));
  Random random(3);
  expect_regions(random, *volume, {50, 40, 30}, labels, 100);
}

/// h5py writes them as an enumeration of two names.
TEST(Hdf5, BooleansAreNumbers) {
  const TempDir dir;
  const auto path = dir.path() / "a.h5";
  const std::vector<std::int8_t> values{0, 1, 1, 0, 1, 0, 0, 1};
  {
    const Hdf5Handle file = create_hdf5(path);
    const Hdf5Handle type(H5Tenum_create(H5T_STD_I8LE), &H5Tclose);
    H5Tenum_insert(type.get(), "FALSE", &values[0]);
    H5Tenum_insert(type.get(), "TRUE", &values[1]);
    const std::array<hsize_t, 3> shape{2, 2, 2};
    const Hdf5Handle space(H5Screate_simple(3, shape.data(), nullptr), &H5Sclose);
    const Hdf5Handle set(H5Dcreate2(file.get(), "/labels", type.get(), space.get(), H5P_DEFAULT,
                                    H5P_DEFAULT, H5P_DEFAULT),
                         &H5Dclose);
    ASSERT_GE(H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  }
  EXPECT_EQ(read_all(*open_volume(path)), (std::vector<RawLabel>{0, 1, 1, 0, 1, 0, 0, 1}));
}

TEST(Hdf5, ChunksBeyondAnArrayThatShrankAreNoVoxels) {
  const TempDir dir;
  Hdf5Sample sample{.shape = {13, 11, 17}, .layout = H5D_CHUNKED, .chunk = {4, 5, 6}};
  sample.max_shape = {H5S_UNLIMITED, 11, H5S_UNLIMITED};
  const auto labels = labels_of(sample);
  const auto path = one_data_set(dir, sample, labels);
  {
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), &H5Fclose);
    const Hdf5Handle set(H5Dopen2(file.get(), "/labels", H5P_DEFAULT), &H5Dclose);
    const std::array<hsize_t, 3> smaller{7, 11, 9};
    ASSERT_GE(H5Dset_extent(set.get(), smaller.data()), 0);
  }
  EXPECT_EQ(read_all(*open_volume(path)), part_of(labels, {17, 11, 13}, {{0, 0, 0}, {9, 11, 7}}));
}

using Packer = std::function<std::string(const std::string&)>;

/// What the registered LZ4 filter writes, blocks of 100 bytes; every other block stored.
std::string lz4_of_hdf5(const std::string& plain) {
  std::string out = number_bytes(plain.size(), 8, true) + number_bytes(100, 4, true);
  for (std::size_t at = 0; at < plain.size(); at += 100) {
    const std::string piece = plain.substr(at, 100);
    std::string block = lz4_block(piece);
    const bool shrank = block.size() < piece.size();
    if (!shrank || at % 200 == 0) block = piece;
    out += number_bytes(block.size(), 4, true) + block;
  }
  return out;
}

/// Chunks packed by filters that the library does not have, written as they are.
TEST(Hdf5, FiltersOfPlugins) {
  const TempDir dir;
  const std::vector<std::pair<unsigned, Packer>> filters{
      {307, [](const std::string& plain) { return bzip2_packed(plain); }},
      {32001, [](const std::string& plain) { return blosc_packed(plain, "zstd", 1, 2); }},
      {32004, lz4_of_hdf5},
      {32015, [](const std::string& plain) { return zstd_packed(plain); }}};
  for (const auto& [id, pack] : filters) {
    Hdf5Sample sample{.shape = {4, 6, 20}, .type = VoxelType::kU16, .layout = H5D_CHUNKED};
    sample.chunk = {2, 6, 10};
    sample.other_filter = id;
    std::vector<RawLabel> labels(480);
    for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = i / 7;
    const auto path = dir.path() / "a.h5";
    {
      const Hdf5Handle file = create_hdf5(path);
      const Hdf5Handle set = create_data_set(file, "/labels", sample);
      for (hsize_t number = 0; number < 4; ++number) {
        const std::array<hsize_t, 3> corner{number / 2 * 2, 0, number % 2 * 10};
        std::vector<RawLabel> chunk;
        for (std::size_t i = 0; i < 120; ++i) {
          const std::size_t z = corner[0] + i / 60, y = i / 10 % 6, x = corner[2] + i % 10;
          chunk.push_back(labels[(z * 6 + y) * 20 + x]);
        }
        const std::string plain = voxel_bytes(chunk, sample.type, false);
        // The last chunk skips the filter.
        const std::string bytes = number == 3 ? plain : pack(plain);
        ASSERT_GE(H5Dwrite_chunk(set.get(), H5P_DEFAULT, number == 3 ? 1 : 0, corner.data(),
                                 bytes.size(), bytes.data()),
                  0);
      }
    }
    EXPECT_EQ(read_all(*open_volume(path)), labels) << id;
  }
}

}  // namespace
}  // namespace mw::io
