// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The seconds left of work whose cost is known up to factors.
#include "engine/forecast/time_left.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace mw::engine {
namespace {

std::vector<double> random_work(std::mt19937& random) {
  std::vector<double> work(50 + random() % 50);
  for (double& w : work) w = 1 + static_cast<double>(random() % 100);
  return work;
}

double sum(const std::vector<double>& work) {
  return std::accumulate(work.begin(), work.end(), 0.0);
}

TEST(TimeLeft, IsExactWhereEveryPartHasTheSameSpeed) {
  std::mt19937 random(373);
  for (int i = 0; i < 20; ++i) {
    const std::vector<std::vector<double>> parts{random_work(random), random_work(random)};
    const double speed = 0.01 * static_cast<double>(1 + random() % 100);
    TimeLeft left({sum(parts[0]), sum(parts[1])}, speed);
    double now = 5, total = speed * (sum(parts[0]) + sum(parts[1]));
    EXPECT_NEAR(left.seconds(), total, 1e-9 * total);
    for (const std::vector<double>& part : parts) {
      left.begin(now, 0);
      for (const double work : part) {
        now += speed * work;
        total -= speed * work;
        left.done(now, work);
        EXPECT_NEAR(left.seconds(), total, 1e-9 * now);
      }
    }
    EXPECT_NEAR(left.seconds(), 0, 1e-9);
  }
}

/// Its speed replaces that of the first part: after half of it, within a tenth.
TEST(TimeLeft, LearnsTheSpeedOfAPart) {
  TimeLeft left({100, 100}, 1);
  left.begin(0, 0);
  left.done(100, 100);
  left.begin(100, 0);
  EXPECT_NEAR(left.seconds(), 100, 1e-9);
  left.done(100 + 500, 50);  // ten times slower
  EXPECT_GT(left.seconds(), 450);
  EXPECT_LT(left.seconds(), 500);
}

TEST(TimeLeft, CountsNoTimeForWhatWasDoneBefore) {
  TimeLeft left({100, 100}, 3);
  left.begin(0, 100);
  EXPECT_NEAR(left.seconds(), 300, 1e-9);
  left.begin(0, 60);
  EXPECT_NEAR(left.seconds(), 120, 1e-9);
  left.done(30, 10);
  EXPECT_NEAR(left.seconds(), 90, 1e-9);
}

/// The guess stands against a first window that took fifty times too long, and soon gives way.
TEST(TimeLeft, BeginsWithAGuess) {
  TimeLeft left({1000}, 1);
  left.begin(0, 0);
  left.done(50, 1);
  EXPECT_LT(left.seconds(), 4000);
  TimeLeft wrong({1000}, 10);
  wrong.begin(0, 0);
  wrong.done(200, 200);
  EXPECT_GT(wrong.seconds(), 800);
  EXPECT_LT(wrong.seconds(), 1600);
}

/// A march whose windows were all told too small ends at nothing, not below.
TEST(TimeLeft, IsNeverNegative) {
  TimeLeft left({1, 1}, 1);
  left.begin(0, 0);
  left.done(1, 5);
  EXPECT_GE(left.seconds(), 0);
  left.begin(1, 3);
  left.done(2, 5);
  EXPECT_EQ(left.seconds(), 0);
}

}  // namespace
}  // namespace mw::engine
