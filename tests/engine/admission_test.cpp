// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Windows wait for memory, and no wait is for ever.
#include "engine/admission.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace mw::engine {
namespace {

/// Lets a window in when there is room, as a budget of so many windows would.
class RoomFor : public BlockStore {
 public:
  explicit RoomFor(int windows) : room_(windows) {}
  void give_back() { ++room_; }

  [[nodiscard]] bool admit(Index3, std::uint64_t) override {
    if (room_ == 0) return false;
    --room_;
    return true;
  }
  [[nodiscard]] std::vector<std::optional<BlockMesh>> take(Index3) override { return {}; }
  void commit(Index3, std::vector<BlockMesh>) override {}
  [[nodiscard]] BlockMesh load(Index3) const override { return {}; }
  [[nodiscard]] bool is_done(Index3) const override { return false; }
  [[nodiscard]] std::uint64_t taken_bytes(Index3) const override { return 0; }
  [[nodiscard]] std::uint64_t loaded_bytes(Index3) const override { return 0; }

 private:
  std::atomic<int> room_;
};

constexpr Index3 kA{0, 0, 0}, kB{2, 0, 0}, kNext{1, 0, 0};

TEST(Admitter, RefusesWhatIsNotNextAndHoldsUpWhatIs) {
  for (int i = 0; i < 50; ++i) {
    RoomFor store(1);
    Admitter admitter(store, [](Index3) { return 1; });
    ASSERT_NE(admitter.admit(kA, true), nullptr);
    EXPECT_EQ(admitter.admit(kB, false), nullptr);
    std::atomic<bool> over = false;
    std::thread visitor([&] {
      admitter.visit(kA, [&](Index3) {
        std::this_thread::yield();
        over = true;
        store.give_back();
      });
    });
    EXPECT_NE(admitter.admit(kNext, true), nullptr);
    EXPECT_TRUE(over);
    visitor.join();
  }
}

/// A failed window keeps its memory, and so does one that was let in before and passes undone: the
/// next one may wait for them to end, but not for their memory.
TEST(Admitter, WaitsForNoMemoryOfWindowsThatFailedOrPassed) {
  for (int i = 0; i < 50; ++i) {
    RoomFor store(2);
    Admitter admitter(store, [](Index3) { return 1; });
    ASSERT_NE(admitter.admit(kA, true), nullptr);
    ASSERT_NE(admitter.admit(kB, false), nullptr);
    Admission next = std::make_shared<int>();
    std::thread keeper([&] { next = admitter.admit(kNext, true); });
    EXPECT_THROW(admitter.visit(kA, [](Index3) { throw 1; }), int);
    bool done = false;
    const VisitWindow work = [&](Index3) { done = true; };
    admitter.visit(kB, work);
    keeper.join();
    EXPECT_EQ(next, nullptr);
    admitter.visit(kNext, work);
    EXPECT_FALSE(done);
  }
}

}  // namespace
}  // namespace mw::engine
