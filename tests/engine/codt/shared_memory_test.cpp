// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Memory that workers share, and what is left of it where there is none.
#include "engine/codt/shared_memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "kernels/core/error.h"

namespace mw::engine::codt {
namespace {

/// Names of this process in /dev/shm.
std::size_t names_left() {
  std::size_t out = 0;
  const std::string ours = "mwmesh-" + std::to_string(::getpid()) + "-";
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm")) {
    if (entry.path().filename().string().starts_with(ours)) ++out;
  }
  return out;
}

// The pages are taken at once: a worker that writes where no page is would die of a signal.
TEST(SharedMemory, MoreThanThereIsIsAnErrorAndLeavesNoName) {
  constexpr std::size_t kTooMuch = std::size_t{1} << 60U;  // bytes
  try {
    const SharedMemory memory = SharedMemory::create(kTooMuch);
    FAIL() << "there was so much";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
    const std::string text = error.what();
    EXPECT_NE(text.find(std::to_string(kTooMuch) + " bytes"), std::string::npos) << text;
    EXPECT_NE(text.find("/dev/shm"), std::string::npos) << text;
  }
  EXPECT_EQ(names_left(), 0U);
}

TEST(SharedMemory, OfAnUnknownNameIsAnError) {
  EXPECT_THROW(static_cast<void>(SharedMemory::open("mwmesh-no-such-name")), Error);
}

}  // namespace
}  // namespace mw::engine::codt
