// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Crossings of random scores against those that are found face by face.
#include "engine/labels/score_crossings.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "kernels/source/crossing.h"
#include "kernels/start/cells/cell.h"

namespace mw::engine {
namespace {

/// Scores in memory, and the labels that they make.
class RandomScores : public io::LabelVolume, public io::LabelScores {
 public:
  RandomScores(std::mt19937& random, Index3 shape, std::size_t labels)
      : scores_(labels, std::vector<double>(static_cast<std::size_t>(shape.product()))) {
    info_.shape = shape;
    for (auto& of_label : scores_) {
      for (double& score : of_label) score = static_cast<double>(random() % 64) / 16.0;
    }
  }

  [[nodiscard]] const io::VolumeInfo& info() const override { return info_; }
  [[nodiscard]] const io::LabelScores* scores() const override { return this; }
  [[nodiscard]] Index3 shape() const override { return info_.shape; }
  [[nodiscard]] std::size_t labels() const override { return scores_.size(); }

  [[nodiscard]] double score(RawLabel label, Index3 v) const {
    const Box3 all{{0, 0, 0}, info_.shape};
    return scores_[static_cast<std::size_t>(label)][static_cast<std::size_t>(all.offset(v))];
  }
  [[nodiscard]] RawLabel label(Index3 v) const {
    RawLabel best = 0;
    for (RawLabel l = 1; l < scores_.size(); ++l) {
      if (score(l, v) > score(best, v)) best = l;
    }
    return best;
  }
  void read(const Box3& box, std::span<RawLabel> out) const override {
    std::size_t i = 0;
    for_each_index(box, [&](Index3 v) { out[i++] = label(v); });
  }
  void read_scores(RawLabel label, const Box3& box, std::span<double> out) const override {
    std::size_t i = 0;
    for_each_index(box, [&](Index3 v) { out[i++] = score(label, v); });
  }

 private:
  io::VolumeInfo info_;
  std::vector<std::vector<double>> scores_;
};

LabelBox labels_around(const RandomScores& volume, const io::LabelTable& table, const Box3& box) {
  LabelBox out{grown(box, 1), {}};
  const Box3 all{{0, 0, 0}, volume.shape()};
  for_each_index(out.box, [&](Index3 v) {
    out.labels.push_back(all.contains(v) ? table.dense(volume.label(v)) : kExterior);
  });
  return out;
}

ScoreDifference difference_at(const RandomScores& volume, Index3 below, unsigned axis) {
  const RawLabel low = volume.label(below), high = volume.label(below + axis_vector(axis));
  const auto value = [&](Index3 v) { return volume.score(low, v) - volume.score(high, v); };
  const Box3 all{{0, 0, 0}, volume.shape()};
  ScoreDifference out;
  for (std::size_t side = 0; side < 2; ++side) {
    const Index3 at = side == 0 ? below : below + axis_vector(axis);
    out.values[side] = value(at);
    for (unsigned k = 0; k < 3; ++k) {
      const Index3 up = all.contains(at + axis_vector(k)) ? at + axis_vector(k) : at;
      const Index3 down = all.contains(at - axis_vector(k)) ? at - axis_vector(k) : at;
      const auto steps = static_cast<double>((up - down).x + (up - down).y + (up - down).z);
      if (steps > 0) {
        out.slopes[side][static_cast<int>(k)] = (value(up) - value(down)) / steps;
      }
    }
  }
  return out;
}

Box3 random_box(std::mt19937& random, Index3 shape) {
  const auto pick = [&](std::int64_t from, std::int64_t to) {
    return from + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(to - from));
  };
  const Index3 lo{pick(0, shape.x), pick(0, shape.y), pick(0, shape.z)};
  return {lo, {pick(lo.x, shape.x) + 1, pick(lo.y, shape.y) + 1, pick(lo.z, shape.z) + 1}};
}

TEST(ScoreCrossings, AreThoseOfEachFace) {
  std::mt19937 random(31);
  int faces = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto edge = [&] { return 1 + static_cast<std::int64_t>(random() % 6); };
    const Index3 shape{edge(), edge(), edge()};
    const RandomScores volume(random, shape, 2 + random() % 4);
    const io::LabelTable table = io::collect_labels(volume);
    const io::DenseVolume dense(volume, table);
    const Box3 box = random_box(random, shape), all{{0, 0, 0}, shape};
    const SourceSurface found = score_crossings(dense, labels_around(volume, table, box), box);
    ASSERT_EQ(found.form(), crossing_form({1, 1, 1}));
    for_each_index(box, [&](Index3 v) {
      for (unsigned axis = 0; axis < 3; ++axis) {
        const Index3 above = v + axis_vector(axis);
        if (!all.contains(above) || volume.label(v) == volume.label(above)) continue;
        const SourcePlane wanted = find_crossing(difference_at(volume, v, axis), axis);
        EXPECT_EQ(found.at(v, axis), pack(wanted, found.form()));
        ++faces;
      }
    });
  }
  EXPECT_GT(faces, 1000);
}

TEST(ScoreCrossings, HaveAFingerprintOfAllScores) {
  std::mt19937 random(32), same(32);
  const RandomScores a(random, {5, 4, 3}, 3), b(same, {5, 4, 3}, 3), c(random, {5, 4, 3}, 3);
  EXPECT_EQ(fingerprint(a), fingerprint(b));
  EXPECT_NE(fingerprint(a), fingerprint(c));
}

}  // namespace
}  // namespace mw::engine
