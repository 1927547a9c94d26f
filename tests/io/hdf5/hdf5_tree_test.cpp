// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Files that are written without the HDF5 library, read by it.
#include "io/hdf5/hdf5_tree.h"

#include "io/hdf5/hdf5_file.h"
#include "io/mesh/vtkhdf/hdf5_output.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

namespace fs = std::filesystem;

/// These values are from the test of the checksum's author.
TEST(MetadataChecksum, IsLookup3) {
  EXPECT_EQ(metadata_checksum(""), 0xdeadbeefU);
  EXPECT_EQ(metadata_checksum("Four score and seven years ago"), 0x17770551U);
}

template <class T>
std::vector<T> read_set(hid_t file, const std::string& path, hid_t type, std::size_t numbers) {
  const Hdf5Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT), &H5Dclose);
  EXPECT_TRUE(set.valid()) << path;
  std::vector<T> out(numbers);
  EXPECT_GE(H5Dread(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()), 0) << path;
  const Hdf5Handle space(H5Dget_space(set.get()), &H5Sclose);
  EXPECT_EQ(H5Sget_simple_extent_npoints(space.get()), static_cast<hssize_t>(numbers)) << path;
  return out;
}

/// Any number of groups and of sets in them, with names of any length and empty sets.
TEST(Hdf5Tree, IsWhatTheLibraryReads) {
  silence_hdf5();
  std::mt19937 random(7101);
  const TempDir dir;
  for (int trial = 0; trial < 20; ++trial) {
    const fs::path path = dir.path() / "t.h5";
    Hdf5Output output(path);
    Hdf5Group root;
    std::vector<std::pair<std::string, std::vector<std::int64_t>>> expected;
    for (auto g = random() % 12; g > 0; --g) {
      Hdf5Group group{.name = "g" + std::to_string(g)};
      for (auto s = random() % 12; s > 0; --s) {
        const std::string name(1 + random() % 250, static_cast<char>('a' + static_cast<char>(s)));
        std::vector<std::int64_t> numbers(random() % 40);
        for (std::int64_t& n : numbers) n = static_cast<std::int64_t>(random()) - (1LL << 31);
        group.sets.push_back(
            output.add({.name = name, .kind = Hdf5Kind::kInt64, .shape = {numbers.size()}},
                       std::as_bytes(std::span(numbers))));
        expected.emplace_back(group.name + "/" + name, numbers);
      }
      root.groups.push_back(std::move(group));
    }
    output.commit(root);
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose);
    ASSERT_TRUE(file.valid());
    for (const auto& [name, numbers] : expected) {
      EXPECT_EQ(read_set<std::int64_t>(file.get(), name, H5T_NATIVE_INT64, numbers.size()),
                numbers);
    }
  }
}

/// More strings than one collection of the heap holds, short ones, long ones and none.
TEST(Hdf5Tree, HoldsStrings) {
  silence_hdf5();
  const TempDir dir;
  const fs::path path = dir.path() / "t.h5";
  std::vector<std::string> texts{"", "a", "eight by", std::string(9000, 'x'), "\xc3\xa4"};
  for (int i = 0; i < 2500; ++i) texts.push_back(std::to_string(i * i));
  {
    Hdf5Output output(path);
    Hdf5Group root;
    root.sets.push_back(output.add_texts("names", texts));
    output.commit(root);
  }
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose);
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  const auto read = read_set<char*>(file.get(), "names", type.get(), texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_EQ(read[i] == nullptr ? "" : std::string(read[i]), texts[i]);
    H5free_memory(read[i]);
  }
}

/// Other programs may add to such a file.
TEST(Hdf5Tree, CanBeAddedTo) {
  silence_hdf5();
  const TempDir dir;
  const fs::path path = dir.path() / "t.h5";
  {
    Hdf5Output output(path);
    const std::vector<double> numbers{1.5, -2.0};
    output.commit({.sets = {output.add({.name = "a", .kind = Hdf5Kind::kFloat64, .shape = {2}},
                                       std::as_bytes(std::span(numbers)))}});
  }
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), &H5Fclose);
  for (int i = 0; i < 30; ++i) {
    const Hdf5Handle group(H5Gcreate2(file.get(), ("new" + std::to_string(i)).c_str(), H5P_DEFAULT,
                                      H5P_DEFAULT, H5P_DEFAULT),
                           &H5Gclose);
    EXPECT_TRUE(group.valid());
  }
  EXPECT_EQ(read_set<double>(file.get(), "a", H5T_NATIVE_DOUBLE, 2),
            (std::vector<double>{1.5, -2.0}));
}

}  // namespace
}  // namespace mw::io
