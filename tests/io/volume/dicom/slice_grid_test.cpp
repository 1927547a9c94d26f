// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Frames along z, some of which are a little off their slices.
#include "io/volume/dicom/open_dicom.h"

#include <gmock/gmock.h>

#include "io/file/errors.h"
#include "tests/testing.h"

namespace mw::io {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

DicomSegments frames_at(const std::vector<double>& places, double spacing, double thickness = 0) {
  DicomSegments out;
  out.grid = {.rows = 4,
              .columns = 5,
              .column_spacing = 1,
              .row_spacing = 1,
              .slice_spacing = spacing,
              .slice_thickness = thickness};
  for (const double z : places) out.frames.push_back({.segment = 1, .first = {-3, 7, z}});
  return out;
}

/// Frames at multiples of a step, each of which is rounded to this many decimals.
DicomSegments rounded_frames(double step, int decimals, double spacing) {
  std::vector<double> places;
  const double ten = std::pow(10, decimals);
  for (int i = 0; i < 200; ++i) places.push_back(std::round(i * step * ten) / ten);
  return frames_at(places, spacing);
}

std::vector<std::int64_t> slices_of(const DicomSegments& dicom) {
  const SliceGrid grid(dicom, "f.dcm");
  std::vector<std::int64_t> out;
  for (std::size_t i = 0; i < dicom.frames.size(); ++i) out.push_back(grid.slice(i));
  return out;
}

std::string refusal(const DicomSegments& dicom) {
  try {
    static_cast<void>(SliceGrid(dicom, "f.dcm"));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(SliceGrid, AFrameMayBeALittleOffItsSlice) {
  for (const double spacing : {1.2, 0.0}) {
    for (const double off : {0.002, 0.02, 0.05, -0.05}) {
      for (const std::size_t which : {0U, 2U, 4U}) {
        std::vector<double> places{0, 1.2, 2.4, 3.6, 4.8, 0, 1.2, 2.4, 3.6, 4.8};
        places[which] += off;
        const DicomSegments dicom = frames_at(places, spacing);
        EXPECT_THAT(slices_of(dicom), ElementsAre(0, 1, 2, 3, 4, 0, 1, 2, 3, 4));
        const SliceGrid grid(dicom, "f.dcm");
        EXPECT_EQ(grid.count(), 5);
        EXPECT_EQ(grid.empty(), 0);
        EXPECT_NEAR(grid.step(), 1.2, 0.02);
        EXPECT_NEAR(grid.first()[2], 0, spacing > 0 ? 2e-3 : 0.05);
      }
    }
  }
}

TEST(SliceGrid, AFrameBetweenSlicesIsNamed) {
  for (const double spacing : {1.2, 0.0}) {
    for (const double off : {0.1, 0.3, 0.4, 0.6}) {
      std::vector<double> places;
      for (int i = 0; i < 20; ++i) places.push_back(1.2 * i);
      places[7] += off;
      EXPECT_THAT(refusal(frames_at(places, spacing)),
                  AllOf(HasSubstr("f.dcm"), HasSubstr("step"), HasSubstr("frame 8 is off")))
          << spacing << " " << off;
    }
  }
}

TEST(SliceGrid, CoordinatesMayBeRounded) {
  struct Case {
    double step;
    int decimals;
    double spacing;
  };
  const std::vector<Case> cases{{0.625, 2, 0.625},    {0.625, 2, 0},   {4.0 / 3, 1, 4.0 / 3},
                                {4.0 / 3, 3, 1.33},   {4.0 / 3, 2, 0}, {1.171875, 2, 1.171875},
                                {1.171875, 4, 1.17},  {0.7, 3, 0.7},   {4.0 / 3, 1, 1.33},
                                {1.171875, 2, 1.1719}};
  for (const Case& c : cases) {
    const DicomSegments dicom = rounded_frames(c.step, c.decimals, c.spacing);
    const SliceGrid grid(dicom, "f.dcm");
    EXPECT_EQ(grid.count(), 200) << c.step;
    EXPECT_EQ(grid.empty(), 0) << c.step;
    EXPECT_NEAR(grid.step(), c.step, 1e-3) << c.step;
  }
}

TEST(SliceGrid, TheStatedSpacingCountsWhereFramesAgree) {
  const SliceGrid grid(frames_at({0, 2.4, 7.2}, 1.2, 2.4), "f.dcm");
  EXPECT_EQ(grid.step(), 1.2);
  EXPECT_EQ(grid.count(), 7);
  EXPECT_EQ(grid.empty(), 4);
  EXPECT_THAT(slices_of(frames_at({5, 2, 3, 6}, 5)), ElementsAre(3, 0, 1, 4));
  EXPECT_EQ(SliceGrid(frames_at({4}, 3, 2), "f.dcm").step(), 3);
  EXPECT_EQ(SliceGrid(frames_at({4}, 0, 2), "f.dcm").step(), 2);
}

TEST(SliceGrid, WithoutASpacingMostNeighboursTellTheStep) {
  // The distances of slices are those of CT: 2.4 mm below, 1.2 mm above.
  const SliceGrid grid(frames_at({0, 2.4, 4.8, 6, 7.2, 8.4, 9.6}, 0, 2.4), "f.dcm");
  EXPECT_NEAR(grid.step(), 1.2, 1e-12);
  EXPECT_EQ(grid.empty(), 2);
  EXPECT_THAT(refusal(frames_at({0, 2.4, 4.8, 7.2, 9.6, 10.8}, 0, 5)),
              AllOf(HasSubstr("steps of "), HasSubstr("frame")));
  EXPECT_EQ(SliceGrid(frames_at({0, 2, 4, 5}, 0, 1), "f.dcm").step(), 1);
}

TEST(SliceGrid, FramesLieBehindEachOther) {
  DicomSegments dicom = frames_at({0, 1, 2}, 1);
  dicom.frames[1].first[0] += 0.04;
  EXPECT_EQ(refusal(dicom), "");
  dicom.frames[1].first[0] += 0.04;
  EXPECT_THAT(refusal(dicom), HasSubstr("frame 2 is 0.08 mm beside frame 1"));
  EXPECT_THAT(refusal(frames_at({0, 1e7, 2e300}, 1)), HasSubstr("too far"));
}

}  // namespace
}  // namespace mw::io
