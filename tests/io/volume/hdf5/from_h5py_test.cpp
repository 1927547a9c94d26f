// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads what h5py_test.py wrote.
#include <cstdlib>

#include "io/volume/open_volume.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

using Vector = std::array<double, 3>;

TEST(Hdf5FromH5py, EveryFileIsReadAsItsArray) {
  const char* const folder = std::getenv("MW_H5PY_FILES");
  if (folder == nullptr) GTEST_SKIP() << "run by h5py_test.py";
  std::ifstream expected(std::filesystem::path(folder) / "expected.txt");
  std::string file, data_set, unit;
  Vector spacing{}, origin{};
  int files = 0;
  while (expected >> file >> data_set >> spacing[0] >> spacing[1] >> spacing[2] >> origin[0] >>
         origin[1] >> origin[2] >> unit) {
    SCOPED_TRACE(file);
    ++files;
    OpenOptions options;
    if (data_set != "-") options.dataset = data_set;
    const auto path = std::filesystem::path(folder) / file;
    const auto volume = open_volume(path, options);
    const auto array = open_volume(path.string() + ".npy");
    EXPECT_EQ(volume->info().shape, array->info().shape);
    EXPECT_EQ(read_all(*volume), read_all(*array));
    EXPECT_EQ(volume->info().space.spacing, spacing);
    EXPECT_EQ(volume->info().space.origin, origin);
    EXPECT_EQ(volume->info().space.unit, unit == "-" ? "" : unit);
  }
  EXPECT_GT(files, 100);
}

}  // namespace
}  // namespace mw::io
