// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What windows cost: faces against brute force, and sums over windows.
#include "engine/forecast/run_forecast.h"
#include "kernels/core/index.h"
#include "tests/testing.h"

namespace mw::engine {
namespace {

LabelBox random_labels(std::mt19937& random, Index3 shape, Label labels) {
  LabelBox out{{{0, 0, 0}, shape}, {}};
  const auto run = 1 + random() % 40;
  for_each_index(shape, [&](Index3 v) {
    out.labels.push_back(static_cast<Label>(
        (static_cast<std::uint64_t>(v.x + v.y + v.z) / run + (random() % 8 == 0 ? 1U : 0U)) %
        labels));
  });
  return out;
}

bool in_one_brick(Index3 v, Index3 w) {
  return v.x / 16 == w.x / 16 && v.y / 16 == w.y / 16 && v.z / 16 == w.z / 16;
}

std::uint64_t counted(const LabelBox& labels, const Box3& box) {
  std::uint64_t faces = 0;
  for_each_index(box, [&](Index3 v) {
    for (const Index3 step : {Index3{1, 0, 0}, Index3{0, 1, 0}, Index3{0, 0, 1}}) {
      const Index3 other = v + step;
      if (!labels.box.contains(other) || !in_one_brick(v, other)) continue;
      faces += labels.at(v) != labels.at(other) ? 1U : 0U;
    }
  });
  return faces;
}

Index3 random_shape(std::mt19937& random) {
  const auto edge = [&] { return static_cast<std::int64_t>(1 + random() % 50); };
  return {edge(), edge(), edge()};
}

BoundaryFaces faces_of(const LabelBox& labels) {
  const Index3 shape = labels.box.shape();
  BoundaryFaces out(shape);
  const Index3 bricks{(shape.x + 15) / 16, (shape.y + 15) / 16, (shape.z + 15) / 16};
  for_each_index(bricks, [&](Index3 brick) {
    const Index3 lo{16 * brick.x, 16 * brick.y, 16 * brick.z};
    std::vector<Label> voxels;
    for_each_index(intersection({lo, lo + Index3{16, 16, 16}}, labels.box),
                   [&](Index3 v) { voxels.push_back(labels.at(v)); });
    out.count(brick, voxels);
  });
  return out;
}

TEST(BoundaryFaces, AreThoseOfEveryVoxel) {
  std::mt19937 random(374);
  for (int i = 0; i < 60; ++i) {
    const LabelBox labels = random_labels(random, random_shape(random), i % 3 == 0 ? 1 : 5);
    const BoundaryFaces faces = faces_of(labels);
    EXPECT_NEAR(faces.in(labels.box), static_cast<double>(counted(labels, labels.box)), 1e-6);
    const Box3 brick = intersection({{16, 16, 0}, {32, 32, 16}}, labels.box);
    if (brick.lo.x >= brick.hi.x || brick.lo.y >= brick.hi.y) continue;
    EXPECT_NEAR(faces.in(brick), static_cast<double>(counted(labels, brick)), 1e-6);
  }
}

TEST(BoundaryFaces, PartsOfABoxAddUp) {
  std::mt19937 random(375);
  const LabelBox labels = random_labels(random, {50, 40, 30}, 4);
  const BoundaryFaces faces = faces_of(labels);
  for (std::int64_t at = 0; at <= 50; at += 7) {
    const double parts = faces.in({{0, 0, 0}, {at, 40, 30}}) + faces.in({{at, 0, 0}, {50, 40, 30}});
    EXPECT_NEAR(parts, faces.in(labels.box), 1e-6);
  }
  EXPECT_EQ(faces.in({{60, 0, 0}, {70, 10, 10}}), 0);
}

/// Whichever order, every window costs something, and more where there is more.
TEST(MarchWork, FollowsTheInterfaces) {
  LabelBox labels{{{0, 0, 0}, {48, 48, 96}}, {}};
  std::mt19937 random(376);
  for_each_index(labels.box, [&](Index3 v) {
    labels.labels.push_back(v.z < 48 ? 0U : static_cast<Label>(random() % 3));
  });
  const BoundaryFaces faces = faces_of(labels);
  for (const Order order : {Order::kRaster, Order::kColour}) {
    const WindowOrder windows(WindowGrid(labels.box.shape(), 16), order);
    const MarchWork work(faces, windows, {}, {});
    double lower = 0, upper = 0;
    for_each_index(windows.grid().windows(), [&](Index3 w) {
      EXPECT_GT(work.of(w), 0);
      (windows.grid().window_box(w).hi.z <= 48 ? lower : upper) += work.of(w);
    });
    EXPECT_NEAR(lower + upper, work.of_all(), 1e-6 * work.of_all());
    EXPECT_GT(upper, 10 * lower);
  }
}

// The seconds left of work whose cost is known up to factors.

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
