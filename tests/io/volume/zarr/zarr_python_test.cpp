// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Stores that zarr-python wrote, where it is installed: every compressor, type and order.
#include <sys/wait.h>

#include <cstdlib>

#include "tests/io/volume/volume_checks.h"

namespace mw::io {
namespace {

TEST(ZarrV2, WhatZarrPythonWrote) {
  const TempDir dir;
  const std::string script = MW_SOURCE_DIR "/tests/io/volume/zarr/write_with_zarr_python.py";
  const int status = std::system(
      ("/usr/bin/python3 '" + script + "' '" + dir.path().string() + "' > /dev/null").c_str());
  ASSERT_TRUE(WIFEXITED(status));
  const int code = WEXITSTATUS(status);
  if (code == 77 || code == 127) GTEST_SKIP() << "no zarr for Python 3";
  ASSERT_EQ(code, 0);
  Random random(1);
  int read = 0;
  for (; std::filesystem::exists(dir.path() / (std::to_string(read) + ".zarr")); ++read) {
    const auto expected = open_volume(dir.path() / (std::to_string(read) + ".npy"));
    const auto store = dir.path() / (std::to_string(read) + ".zarr");
    SCOPED_TRACE(content_of(store / ".zarray"));
    expect_regions(random, *open_volume(store), expected->info().shape, read_all(*expected));
  }
  EXPECT_EQ(read, 13 * 17);
}

}  // namespace
}  // namespace mw::io
