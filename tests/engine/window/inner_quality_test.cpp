// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/window/inner_quality.h"

#include <gtest/gtest.h>

namespace mw::engine {
namespace {

constexpr std::int64_t kBrick = 16;

/// Bricks in a row, with faces in the first.
BoundaryFaces row_of(std::int64_t bricks, std::uint16_t faces) {
  BoundaryFaces out({bricks * kBrick, kBrick, kBrick});
  out.add(0, {&faces, 1});
  return out;
}

TEST(InnerQuality, OneLabelIsSparse) {
  EXPECT_EQ(inner_quality_for(row_of(1, 0)), kSparseInnerQuality);
}

TEST(InnerQuality, FacesEverywhereAreDense) {
  EXPECT_EQ(inner_quality_for(row_of(1, 1)), kInnerQuality);
}

TEST(InnerQuality, EmptyBricksDecide) {
  EXPECT_EQ(inner_quality_for(row_of(11, 159)), kSparseInnerQuality);
  EXPECT_EQ(inner_quality_for(row_of(11, 160)), kInnerQuality);
}

/// Bricks that the volume cuts short count as well.
TEST(InnerQuality, PartsOfBricksAreBricks) {
  BoundaryFaces faces({2 * kBrick + 1, 1, 1});
  const std::uint16_t few = 31, many = 32;
  faces.add(2, {&few, 1});
  EXPECT_EQ(inner_quality_for(faces), kSparseInnerQuality);
  faces.add(2, {&many, 1});
  EXPECT_EQ(inner_quality_for(faces), kInnerQuality);
}

}  // namespace
}  // namespace mw::engine
