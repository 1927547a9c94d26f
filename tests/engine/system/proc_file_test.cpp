// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Amounts in files of /proc.
#include "engine/system/memory.h"

#include <gtest/gtest.h>

#include <sstream>

namespace mw::engine {
namespace {

TEST(ProcFile, TellsTheAmountOfALine) {
  const std::string text =
      "MemTotal: 9000 kB\nMemFree: 10 kB\nMemFreeMore: 5 kB\nLast:    700 kB\n";
  const auto bytes = [&](std::string_view name) {
    std::istringstream file(text);
    return proc_bytes(file, name);
  };
  EXPECT_EQ(bytes("MemTotal"), 9000U * 1024);
  EXPECT_EQ(bytes("MemFreeMore"), 5U * 1024);
  EXPECT_EQ(bytes("Last"), 700U * 1024);
  EXPECT_EQ(bytes("Mem"), std::nullopt);
  EXPECT_EQ(bytes("MemAvailable"), std::nullopt);
}

}  // namespace
}  // namespace mw::engine
