// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The options of `mwmesh picture`.
#include "engine/cli/picture/picture_request.h"

#include "engine/cli/options/shared_options.h"
#include "engine/cli/options/values.h"
#include "io/file/errors.h"

namespace mw::cli {
namespace {

constexpr const char* kShownGroup = "What to show";

[[noreturn]] void fail_expected(const std::string& what) {
  io::fail_usage("expected " + what);
}

std::array<int, 2> parse_pixels(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) fail_expected("pixels, as 1200x900");
  const std::int64_t width = parse_integer(text.substr(0, cross));
  const std::int64_t height = parse_integer(text.substr(cross + 1));
  picture::check_sides(width, height);
  return {static_cast<int>(width), static_cast<int>(height)};
}

picture::Lines parse_lines(const std::string& text) {
  using picture::Lines;
  if (text == "auto") return Lines::kAuto;
  return text == "on" ? Lines::kAll : Lines::kNone;
}

void add_subject(OptionSet& options, PictureRequest& request) {
  options.add({.name = "labels",
               .value = "LIST",
               .help = "labels to draw, as 1,2 [all but the one around them]",
               .group = kShownGroup,
               .kind = ValueKind::kLabels,
               .flags = "--labels,--label",
               .assign = into(request.labels, parse_labels)});
  options.add({.name = "cut",
               .value = "x=SHARE",
               .help = "what is before a plane across x, y or z is taken away, as x=0.5",
               .group = kShownGroup,
               .assign = into(request.cut, parse_cut)});
  options.add({.name = "view",
               .value = "VIEW",
               .help = "iso, x, y, z, or AZIMUTH,ELEVATION in degrees [what suits the cut]",
               .group = kShownGroup,
               .assign = into(request.view, parse_view)});
}

void add_style(OptionSet& options, PictureRequest& request) {
  options.add({.name = "output",
               .value = "P.png",
               .help = "picture to write",
               .group = kOutputGroup,
               .flags = "-o,--output",
               .required = true,
               .assign = into(request.output)});
  options.add({.name = "pixels",
               .value = "WxH",
               .help = "width and height",
               .group = kOutputGroup,
               .fallback = "1200x900",
               .flags = "--pixels,--size",
               .assign = into(request.pixels, parse_pixels)});
  options.add({.name = "edges",
               .help = "edges of triangles; auto: fainter where they are small",
               .group = kOutputGroup,
               .fallback = "auto",
               .choices = {"auto", "on", "off"},
               .assign = into(request.lines, parse_lines)});
  options.add({.name = "transparent",
               .help = "a transparent instead of a white background",
               .group = kOutputGroup,
               .kind = ValueKind::kSwitch,
               .fallback = "false",
               .assign = into(request.transparent)});
}

}  // namespace

void add_picture_options(OptionSet& options, PictureRequest& request) {
  add_mesh_option(options, request.mesh, "mesh to draw");
  options.add({.name = "names",
               .value = "FILE",
               .help = "names and colours of labels [those in the mesh]",
               .group = kInputGroup,
               .assign = into(request.names)});
  add_subject(options, request);
  add_style(options, request);
}

picture::CutPosition parse_cut(std::string_view text) {
  constexpr const char* kExpected = "x=SHARE, y=SHARE or z=SHARE with a share from 0 to 1";
  if (text.size() < 3 || text[0] < 'x' || text[0] > 'z' || text[1] != '=') fail_expected(kExpected);
  const picture::CutPosition position{.axis = static_cast<std::size_t>(text[0] - 'x'),
                                      .share = parse_number(text.substr(2))};
  if (position.share < 0 || position.share > 1) fail_expected(kExpected);
  return position;
}

picture::View parse_view(std::string_view text) {
  if (text == "iso") return picture::default_view({});
  if (text == "x") return picture::view_from(0, 0);
  if (text == "y") return picture::view_from(90, 0);
  if (text == "z") return picture::view_from(-90, 90);
  constexpr const char* kExpected =
      "iso, x, y, z, or AZIMUTH,ELEVATION with an elevation from -90 to 90 degrees";
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) fail_expected(kExpected);
  const double azimuth = parse_number(text.substr(0, comma));
  const double elevation = parse_number(text.substr(comma + 1));
  if (elevation < -90 || elevation > 90) fail_expected(kExpected);
  return picture::view_from(azimuth, elevation);
}

}  // namespace mw::cli
