// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Colours in CIELab against those that tables list for sRGB, and their 16 bits in DICOM files.
#include "io/names/label_names.h"
#include "tests/testing.h"

namespace mw::io {
namespace {

void expect_colour(const CieLab& lab, const Colour& expected) {
  const Colour found = srgb_of(lab);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(found[i], expected[i], 1) << i;
}

TEST(CieLab, IsWhatTablesSay) {
  expect_colour({100, 0, 0}, {255, 255, 255, 255});
  expect_colour({0, 0, 0}, {0, 0, 0, 255});
  expect_colour({53.39, 0, 0}, {127, 127, 127, 255});
  expect_colour({54.29, 80.81, 69.89}, {255, 0, 0, 255});
  expect_colour({87.82, -79.29, 80.99}, {0, 255, 0, 255});
  expect_colour({29.57, 68.30, -112.03}, {0, 0, 255, 255});
}

TEST(CieLab, WhatNoScreenShowsIsCut) {
  EXPECT_EQ(srgb_of({100, 127, 127})[0], 255);
  EXPECT_EQ(srgb_of({0, 127, -128})[1], 0);
  EXPECT_EQ(srgb_of({50, -128, 0})[0], 0);
}

TEST(CieLab, IsSpreadOver16Bits) {
  const CieLab least = cielab_of({0, 0, 0});
  EXPECT_EQ(least.lightness, 0);
  EXPECT_EQ(least.a, -128);
  EXPECT_EQ(least.b, -128);
  const CieLab most = cielab_of({65535, 65535, 65535});
  EXPECT_EQ(most.lightness, 100);
  EXPECT_EQ(most.a, 127);
  EXPECT_EQ(most.b, 127);
  EXPECT_NEAR(cielab_of({0, 0x8080, 0x8080}).a, 0, 1e-9);
}

}  // namespace
}  // namespace mw::io
