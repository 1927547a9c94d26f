// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What of a volume makes another run of it; the settings are in setting_table_test.cpp.
#include "engine/store/journal/workdir.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

namespace mw::engine {
namespace {

io::VolumeInfo some_volume() {
  return {.shape = {30, 20, 10}, .type = io::VoxelType::kU64, .format = "npy", .names = {}};
}

std::string identity(const io::VolumeInfo& volume) {
  return identity_text(volume, {});
}

TEST(RunIdentity, NamesWhatTheMeshComesFrom) {
  const io::VolumeInfo plain = some_volume();
  std::vector<io::VolumeInfo> others(8, plain);
  others[0].shape = {20, 30, 10};
  others[1].type = io::VoxelType::kI64;
  others[2].scaled = true;  // labels above 2^63 are negative then, and come first
  others[3].space.spacing = {1.0, 1.0, 1.0000000000000002};
  others[4].space.origin = {0.0, 0.0, 1e-300};
  others[5].space.axes = {{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}};
  others[6].space.axes = {{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}};
  others[7].space.axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}};
  std::set<std::string> identities{identity(plain)};
  for (const io::VolumeInfo& other : others) {
    EXPECT_TRUE(identities.insert(identity(other)).second) << identity(other);
    EXPECT_NE(differences(identity(plain), identity(other)), "");
  }
}

TEST(RunIdentity, LeavesOutHowTheVolumeIsStored) {
  io::VolumeInfo copy = some_volume();
  copy.format = "zarr";
  copy.z_fastest = true;
  copy.chunk = {16, 16, 16};
  copy.space.unit = "mm";
  EXPECT_EQ(identity(copy), identity(some_volume()));
}

/// So that a run that is refused is told every difference.
TEST(RunIdentity, HasALineForEachValue) {
  std::istringstream lines(identity(some_volume()));
  std::set<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(" = ");
    ASSERT_NE(at, std::string::npos) << line;
    EXPECT_LT(at + 3, line.size()) << line;
    EXPECT_TRUE(names.insert(line.substr(0, at)).second) << line;
  }
  EXPECT_GE(names.size(), 20U);
}

}  // namespace
}  // namespace mw::engine
