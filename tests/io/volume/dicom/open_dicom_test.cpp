// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the process that reads a DICOM file may say.
#include "io/volume/dicom/open_dicom.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>

namespace mw::io {
namespace {

DicomSegments sound_masks() {
  DicomSegments out;
  out.grid = {.rows = 4, .columns = 5, .column_spacing = 1, .row_spacing = 2};
  out.segments = {{.number = 2, .name = "b", .colour = {}},
                  {.number = 1, .name = "", .colour = {}}};
  out.frames = {{.segment = 1, .first = {0, 0, 0}}, {.segment = 2, .first = {0, 0, 3}}};
  return out;
}

DicomSegments sound_map() {
  DicomSegments out = sound_masks();
  out.grid.voxels = DicomVoxels::kLabels;
  out.grid.bits = 16;
  out.grid.background = 65535;
  out.frames = {{.segment = kAllSegments, .first = {}}};
  out.segments.clear();
  return out;
}

TEST(DicomSegments, AreSoundOrNot) {
  EXPECT_TRUE(is_sound(sound_masks()));
  EXPECT_TRUE(is_sound(sound_map()));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  using Change = std::function<void(DicomSegments&)>;
  const std::vector<Change> of_masks{
      [](DicomSegments& d) { d.frames[1].segment = 3; },
      [](DicomSegments& d) { d.frames[1].segment = kAllSegments; },
      [](DicomSegments& d) { d.frames[0].first[1] = kNan; },
      [](DicomSegments& d) { d.frames.clear(); },
      [](DicomSegments& d) { d.segments[0].number = 65536; },
      [](DicomSegments& d) { d.segments[0].number = 0; },
      [](DicomSegments& d) { d.grid.rows = 0; },
      [](DicomSegments& d) { d.grid.rows = -1; },
      [](DicomSegments& d) { d.grid.columns = 1 << 20; },
      [](DicomSegments& d) { d.grid.bits = 16; },
      [](DicomSegments& d) { d.grid.bits = 0; },
      [](DicomSegments& d) { d.grid.threshold = 0; },
      [](DicomSegments& d) { d.grid.voxels = static_cast<DicomVoxels>(7); },
      [](DicomSegments& d) { d.grid.column_spacing = 0; },
      [](DicomSegments& d) { d.grid.row_spacing = kNan; },
      [](DicomSegments& d) { d.grid.slice_thickness = kNan; },
      [](DicomSegments& d) { d.grid.along_row[0] = kNan; }};
  for (std::size_t i = 0; i < of_masks.size(); ++i) {
    DicomSegments changed = sound_masks();
    of_masks[i](changed);
    EXPECT_FALSE(is_sound(changed)) << i;
  }
  const std::vector<Change> of_maps{[](DicomSegments& d) { d.frames[0].segment = 1; },
                                    [](DicomSegments& d) { d.grid.bits = 1; },
                                    [](DicomSegments& d) { d.grid.background = 65536; }};
  for (std::size_t i = 0; i < of_maps.size(); ++i) {
    DicomSegments changed = sound_map();
    of_maps[i](changed);
    EXPECT_FALSE(is_sound(changed)) << i;
  }
}

}  // namespace
}  // namespace mw::io
