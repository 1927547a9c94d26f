// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The budget when none is given.
#include "engine/system/memory.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <sstream>

#include "tests/temp_folder.h"

namespace mw::engine {
namespace {

constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

TEST(MachineMemory, TakesTheLeastLimitOfNestedGroups) {
  const test::TempFolder folder;
  const auto limit = [&](const std::string& group, const std::string& text) {
    std::filesystem::create_directories(folder.path() / group);
    std::ofstream(folder.path() / group / "memory.max") << text;
  };
  const auto found = [&](const std::string& groups) {
    std::istringstream in(groups);
    return cgroup_limit(folder.path(), in);
  };
  EXPECT_EQ(found("0::/user/job\n"), kNone);
  limit("user", "5000\n");
  limit("user/job", "max\n");
  EXPECT_EQ(found("0::/user/job\n"), 5000U);
  limit("user/job", "3000\n");
  EXPECT_EQ(found("1:name=systemd:/x\n0::/user/job\n"), 3000U);
  EXPECT_EQ(found("0::/user\n"), 5000U);
  EXPECT_EQ(found("0::/\n"), kNone);
  std::filesystem::create_directories(folder.path() / "memory" / "a");
  std::ofstream(folder.path() / "memory" / "a" / "memory.limit_in_bytes") << "2000\n";
  EXPECT_EQ(found("4:memory:/a/b\n0::/user\n"), 2000U);
}

TEST(MachineMemory, IsAtMostHalfOfTheMachine) {
  std::ifstream meminfo("/proc/meminfo");
  std::string name;
  std::uint64_t kib = 0;
  meminfo >> name >> kib;
  ASSERT_EQ(name, "MemTotal:");
  EXPECT_LE(default_memory_budget(), kib * 512);
  EXPECT_GT(default_memory_budget(), 0U);
}

}  // namespace
}  // namespace mw::engine
