// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What `mwmesh picture` is asked to draw.
#pragma once

#include <string_view>

#include "engine/cli/options/option_set.h"
#include "engine/cli/picture/draw.h"

namespace mw::cli {

struct PictureRequest {
  std::filesystem::path mesh;
  std::filesystem::path output;
  std::filesystem::path names;  ///< empty: those in the mesh
  std::optional<CutPosition> cut;
  std::optional<std::vector<RawLabel>> labels;  ///< empty: all but the surrounding one
  std::optional<picture::View> view;            ///< empty: as suits the cut
  std::array<int, 2> pixels{1200, 900};         ///< width and height
  Lines lines = Lines::kAuto;
  bool transparent = false;
};

/// Every option of the subcommand.  REQUIRES: request outlives options.
void add_picture_options(OptionSet& options, PictureRequest& request);

/// The view where none is asked for: the cut is seen, and some of the sides.
[[nodiscard]] picture::View default_view(const std::optional<CutPosition>& cut);

/// "x=0.5".  ERRORS (both): mw::Error(kUsage) saying what was expected.
[[nodiscard]] CutPosition parse_cut(std::string_view text);
/// "iso", "x", "y", "z" (from the far end of that axis), or "AZIMUTH,ELEVATION" in degrees.
[[nodiscard]] picture::View parse_view(std::string_view text);

}  // namespace mw::cli
