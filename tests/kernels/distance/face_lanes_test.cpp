// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Faces four at a time against one sample after the other.
#include "kernels/distance/face_lanes.h"
#include "tests/kernels/distance/random_points.h"
#include "tests/testing.h"

namespace mw::test {
namespace {

using audit::test::below;

LabelBox random_labels(std::mt19937& random) {
  LabelBox out{{{1000, 30, 500000}, {1009, 37, 500006}}, {}};
  for (std::int64_t i = 0; i < out.box.voxels(); ++i) out.labels.push_back(below(random, 3));
  return out;
}

std::vector<FaceSamples> random_faces(const LabelBox& labels, std::mt19937& random) {
  std::vector<FaceSamples> out(1 + below(random, kLanes));
  const Index3 lo = labels.box.lo, shape = labels.box.shape();
  const auto along = [&](std::int64_t from, std::int64_t size) {
    return from + below(random, static_cast<std::uint32_t>(size));
  };
  for (FaceSamples& s : out) {
    const std::int64_t x = along(lo.x, shape.x), y = along(lo.y, shape.y);
    const Index3 voxel{x, y, along(lo.z, shape.z)};
    const unsigned axis = below(random, 3);
    s = face_samples(voxel, axis, below(random, 3) == 0 ? 1 + below(random, 15) : kAllQuarters);
  }
  return out;
}

double sign_of(FaceSamples s, const LabelBox& labels, Label low) {
  return labels.at(lower_voxel(s)) == low ? 1.0 : -1.0;
}

TEST(FaceLanes, PiecesAreMeansOfSamples) {
  std::mt19937 random(951);
  const LabelBox labels = random_labels(random);
  int parts = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::vector<FaceSamples> faces = random_faces(labels, random);
    const PieceGroup pieces = pieces_of(FaceGroup(faces), labels, 1);
    ASSERT_EQ(pieces.size, faces.size());
    for (std::size_t k = 0; k < kLanes; ++k) {
      const FaceSamples s = faces[std::min(k, faces.size() - 1)];
      Vec3 sum = Vec3::Zero();
      double quarters = 0.0;
      for (unsigned quarter = 0; quarter < kSamplesPerFace; ++quarter) {
        if ((quarters_of(s) >> quarter & 1U) == 0) continue;
        sum += in_voxels(sample_position(s, quarter));
        quarters += 1.0;
      }
      ASSERT_EQ(pieces.quarters[k], quarters);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(pieces.middles[axis][k], sum[static_cast<int>(axis)] / quarters);
      }
      ASSERT_EQ(pieces.signs[k], sign_of(s, labels, 1));
      ASSERT_EQ(static_cast<unsigned>(pieces.axes[k]), axis_of(s));
      parts += quarters < 4.0 ? 1 : 0;
    }
  }
  EXPECT_GT(parts, 1000);
}

TEST(FaceLanes, CentresLookAWay) {
  std::mt19937 random(952);
  const LabelBox labels = random_labels(random);
  int looking = 0, away = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::vector<FaceSamples> faces = random_faces(labels, random);
    const Vec3 normal = (random_point(random) - Vec3::Constant(2.0005)).normalized();
    const FaceCentres centres = centres_of(FaceGroup(faces), labels, 2, normal, -0.1);
    ASSERT_EQ(centres.looking >> faces.size(), 0U);
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const Vec3 centre = in_voxels(face_centre(faces[k]));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(centres.points[axis][k], centre[static_cast<int>(axis)]);
      }
      const double cosine =
          sign_of(faces[k], labels, 2) * normal[static_cast<int>(axis_of(faces[k]))];
      ASSERT_EQ((centres.looking >> k & 1U) != 0, cosine >= -0.1);
      (cosine >= -0.1 ? looking : away) += 1;
    }
  }
  EXPECT_GT(looking, 1000);
  EXPECT_GT(away, 1000);
}

}  // namespace
}  // namespace mw::test
