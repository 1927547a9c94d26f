// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Nearest points on balls and between three labels, across tiles, in voxels of any shape.
#include "engine/output/score_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "io/volume/volume_space.h"

namespace mw::engine {
namespace {

/// Scores by a function of the label and the place in the world; the highest makes the label.
class FunctionScores : public io::LabelVolume, public io::LabelScores {
 public:
  using Score = std::function<double(RawLabel, const io::Vector3&)>;

  FunctionScores(const io::VolumeInfo& info, std::size_t labels, Score score)
      : info_(info), labels_(labels), score_(std::move(score)) {}

  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }
  [[nodiscard]] const io::LabelScores* scores() const override { return this; }
  [[nodiscard]] Index3 shape() const override { return info_.shape; }
  [[nodiscard]] std::size_t labels() const override { return labels_; }
  void read_scores(RawLabel label, const Box3& box, std::span<double> out) const override {
    std::size_t i = 0;
    for_each_index(box, [&](Index3 v) {
      out[i++] = score_(label, io::to_world(info_.space, {static_cast<double>(v.x) + 0.5,
                                                          static_cast<double>(v.y) + 0.5,
                                                          static_cast<double>(v.z) + 0.5}));
    });
  }
  void read(const Box3& box, std::span<RawLabel> out) const override {
    std::vector<double> best(out.size(), -1e9), scores(out.size());
    for (RawLabel label = 0; label < labels_; ++label) {
      read_scores(label, box, scores);
      for (std::size_t i = 0; i < out.size(); ++i) {
        if (scores[i] <= best[i]) continue;
        best[i] = scores[i];
        out[i] = label;
      }
    }
  }

 private:
  io::VolumeInfo info_;
  std::size_t labels_;
  Score score_;
};

double distance_of(const io::Vector3& a, const io::Vector3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// A volume of 70 x 45 x 40 voxels of three edges, turned and moved.
io::VolumeInfo turned_volume() {
  io::VolumeInfo info;
  info.shape = {70, 45, 40};
  info.space.spacing = {1.0, 1.5, 1.25};
  info.space.origin = {100, -50, 7};
  info.space.axes = {{{0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, -1}}};
  return info;
}

TEST(ScoreSurface, IsABallAcrossTiles) {
  const io::VolumeInfo info = turned_volume();
  const io::Vector3 centre = io::to_world(info.space, {33, 22, 20});
  const double radius = 20;
  const FunctionScores volume(info, 2, [&](RawLabel label, const io::Vector3& at) {
    return label == 0 ? 0.0 : radius - distance_of(at, centre);
  });
  const io::LabelTable table(std::vector<RawLabel>{0, 1}, false);
  const io::DenseVolume dense(volume, table);
  ScoreSurface surface(dense);
  std::mt19937 random(374);
  std::normal_distribution<double> draw;
  std::uniform_real_distribution<double> off(-0.9, 0.9);
  for (int round = 0; round < 300; ++round) {
    io::Vector3 direction{draw(random), draw(random), draw(random)};
    const double length = distance_of(direction, {0, 0, 0}), far = radius + off(random);
    io::Vector3 near{};
    for (std::size_t k = 0; k < 3; ++k) near[k] = centre[k] + direction[k] * (far / length);
    const auto found = surface.nearest(near, round % 2 == 0 ? 0 : 1, round % 2 == 0 ? 1 : 0);
    ASSERT_TRUE(found);
    EXPECT_NEAR(distance_of(*found, centre), radius, 2e-3);
    EXPECT_LT(distance_of(*found, near), std::abs(far - radius) + 0.01);
  }
  EXPECT_FALSE(surface.nearest(centre, 0, 1));
  EXPECT_FALSE(surface.nearest(centre, 0, 7));  // no such scores
}

TEST(ScoreSurface, OfTwoLabelsEndsWhereAThirdIsHigher) {
  io::VolumeInfo info;
  info.shape = {20, 20, 20};
  const FunctionScores volume(info, 3, [](RawLabel label, const io::Vector3& at) {
    return label == 2 ? at[1] - 10.0 : label == 1 ? 0.5 * (at[0] - 9.3) : -0.5 * (at[0] - 9.3);
  });
  const io::LabelTable table(std::vector<RawLabel>{0, 1, 2}, false);
  const io::DenseVolume dense(volume, table);
  ScoreSurface surface(dense);
  const auto found = surface.nearest({9.9, 4, 7}, 0, 1);
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found)[0], 9.3, 1e-9);
  EXPECT_FALSE(surface.nearest({9.9, 14, 7}, 0, 1));
  EXPECT_TRUE(surface.nearest({14, 12.2, 7}, 1, 2));
}

}  // namespace
}  // namespace mw::engine
