// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What `mwmesh picture` is asked to draw.
#pragma once

#include <string_view>

#include "engine/cli/options/option_set.h"
#include "engine/picture/draw.h"

namespace mw::cli {

struct PictureRequest {
  std::filesystem::path mesh;
  std::filesystem::path output;
  std::filesystem::path names;  ///< empty: those in the mesh
  std::optional<picture::CutPosition> cut;
  std::optional<std::vector<RawLabel>> labels;  ///< empty: all except the surrounding one
  std::optional<picture::View> view;            ///< empty: the view that suits the cut
  std::array<int, 2> pixels{1200, 900};         ///< width and height
  picture::Lines lines = picture::Lines::kAuto;
  bool transparent = false;
};

/// Adds every option of the command.  REQUIRES: request outlives options.
void add_picture_options(OptionSet& options, PictureRequest& request);

/// Parses "x=0.5".  ERRORS (both): mw::Error(kUsage) saying what was expected.
[[nodiscard]] picture::CutPosition parse_cut(std::string_view text);
/// Parses "iso", "x", "y", "z" (from the far end of that axis) or "AZIMUTH,ELEVATION" in degrees.
[[nodiscard]] picture::View parse_view(std::string_view text);

}  // namespace mw::cli
