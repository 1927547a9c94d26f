// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The polynomial of the filter against what it is defined by, and filters on faces of planes.
#include "kernels/source/face_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/kernels/mesh/dense_mesh.h"

namespace mw::test {
namespace {

constexpr double kOne = 65536.0;

/// The filter's polynomial, by the definition of Chebyshev polynomials.
double response(double angle) {
  double sum = 0.0;
  for (std::size_t k = 0; k < FaceFilter::kShares.size(); ++k) {
    sum += static_cast<double>(FaceFilter::kShares[k]) / kOne *
           std::cos(static_cast<double>(k) * angle);
  }
  return sum;
}

TEST(FaceFilter, ChangesNoPolynomialOfLowDegree) {
  std::int64_t sum = 0;
  double first = 0.0, second = 0.0;  // derivatives at 1
  for (std::size_t k = 0; k < FaceFilter::kShares.size(); ++k) {
    const auto square = static_cast<double>(k * k);
    const double share = static_cast<double>(FaceFilter::kShares[k]) / kOne;
    sum += FaceFilter::kShares[k];
    first += square * share;
    second += square * (square - 1.0) / 3.0 * share;
  }
  EXPECT_EQ(sum, 65536);
  EXPECT_NEAR(first, 0.0, 2e-3);
  EXPECT_NEAR(second, 0.0, 0.1);
}

/// At the least value the change along each direction that keeps value and derivatives at 1, which
/// is (1 - x)^3 x^j, is zero to first order.
TEST(FaceFilter, HasTheLeastSquareOfWhatIsToFade) {
  constexpr int kParts = 20000;
  const double end = std::acos(-1.0), begin = std::acos(0.9);  // x from 0.9 to -1
  for (int power = 0; power + 3 <= FaceFilter::kSteps; ++power) {
    double change = 0.0, own = 0.0, other = 0.0;
    for (int i = 0; i < kParts; ++i) {
      const double angle = begin + (end - begin) * (i + 0.5) / kParts;
      const double x = std::cos(angle), way = std::pow(1.0 - x, 3) * std::pow(x, power);
      const double width = std::sin(angle);  // of the part in x
      change += width * response(angle) * way;
      own += width * response(angle) * response(angle);
      other += width * way * way;
    }
    EXPECT_LT(std::abs(change) / std::sqrt(own * other), 2e-3) << power;
  }
}

/// Values that rise evenly along a flat interface stay as they are far from its ends.
TEST(FaceFilter, LeavesEvenSlopesAlone) {
  const SmallVolume volume =
      volume_from({48, 48, 4}, 2, [](auto, auto, auto z) { return z < 2 ? Label{0} : Label{1}; });
  const LabelBox labels = labels_in(volume, {{0, 0, 0}, volume.shape});
  const FaceGraph graph(labels);
  const FaceFilter filter(graph, std::vector<FaceFilter::Value>(graph.size(), {0, 0, 1 << 18}));
  std::vector<FaceFilter::Value> values(graph.size());
  const auto value = [](const FaceGraph::Face& f) -> FaceFilter::Value {
    const auto x = static_cast<std::int32_t>(f.lower.x), y = static_cast<std::int32_t>(f.lower.y);
    return {4096 * x, 4096 * (x - 2 * y), 1000};
  };
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = value(graph.face(i));
  std::vector<FaceFilter::Value> diffused = values;
  filter.smooth(values);
  filter.diffuse(diffused);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const FaceGraph::Face f = graph.face(i);
    EXPECT_EQ(values[i][2], 1000);
    EXPECT_EQ(diffused[i][2], 1000);
    const std::int64_t in = std::min({f.lower.x, f.lower.y, 47 - f.lower.x, 47 - f.lower.y});
    if (in < FaceFilter::kSteps) continue;
    EXPECT_EQ(values[i], value(f));
    EXPECT_EQ(diffused[i], value(f));
  }
}

}  // namespace
}  // namespace mw::test
