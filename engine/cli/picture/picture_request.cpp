// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The options of `mwmesh picture`.
#include "engine/cli/picture/picture_request.h"

#include "engine/cli/values.h"
#include "kernels/core/error.h"

namespace mw::cli {
namespace {

constexpr int kMaxSide = 8192;  // pixels

[[noreturn]] void fail_expected(const std::string& what) {
  throw Error(ErrorKind::kUsage, "expected " + what);
}

void parse_size(std::string_view text, PictureRequest& request) {
  const std::string expected = "pixels from 16x16 to 8192x8192, e.g. 1200x900";
  const std::size_t cross = text.find('x');
  if (cross == std::string_view::npos) fail_expected(expected);
  const auto side = [&](std::string_view digits) {
    const std::int64_t pixels = parse_integer(digits);
    if (pixels < 16 || pixels > kMaxSide) fail_expected(expected);
    return static_cast<int>(pixels);
  };
  request.width = side(text.substr(0, cross));
  request.height = side(text.substr(cross + 1));
}

Lines parse_lines(const std::string& text) {
  if (text == "auto") return Lines::kAuto;
  return text == "on" ? Lines::kAll : Lines::kNone;
}

void add_paths(OptionSet& options, PictureRequest& request) {
  options.add({.name = "mesh",
               .value = "MESH",
               .help = "mesh to draw",
               .flags = "MESH,--mesh",
               .assign = [&](const std::string& text) { request.mesh = text; }});
  options.add({.name = "output",
               .value = "P.png",
               .help = "picture to write",
               .flags = "-o,--output",
               .assign = [&](const std::string& text) { request.output = text; }});
  options.add({.name = "names",
               .value = "FILE",
               .help = "colours of labels [those in the mesh]",
               .assign = [&](const std::string& text) { request.names = text; }});
}

void add_subject(OptionSet& options, PictureRequest& request) {
  options.add({.name = "label",
               .value = "LIST",
               .help = "labels to draw, e.g. 1,2 [all but the one around them]",
               .kind = ValueKind::kLabels,
               .assign = [&](const std::string& text) {
                 if (!text.empty()) request.labels = parse_labels(text);
               }});
  options.add({.name = "cut",
               .value = "x=SHARE",
               .help = "takes away what is on the viewer's side of a plane across x, y or z of the "
                       "array, at that share of the box, e.g. x=0.5; tets that it goes through are "
                       "drawn as they are cut",
               .assign = [&](const std::string& text) {
                 if (!text.empty()) request.cut = parse_cut(text);
               }});
  options.add({.name = "view",
               .value = "VIEW",
               .help = "iso, or x, y or z (from the far end of that axis of the world), or "
                       "AZIMUTH,ELEVATION in degrees [iso, or what suits the cut]",
               .assign = [&](const std::string& text) {
                 if (!text.empty()) request.view = parse_view(text);
               }});
}

void add_style(OptionSet& options, PictureRequest& request) {
  options.add({.name = "size",
               .value = "WxH",
               .help = "pixels",
               .fallback = "1200x900",
               .assign = [&](const std::string& text) { parse_size(text, request); }});
  options.add({.name = "edges",
               .value = "WHICH",
               .help = "edges of triangles: on, off, or auto, fainter where triangles are small",
               .fallback = "auto",
               .choices = {"auto", "on", "off"},
               .assign = [&](const std::string& text) { request.lines = parse_lines(text); }});
  options.add(
      {.name = "transparent",
       .help = "a transparent instead of a white background",
       .kind = ValueKind::kSwitch,
       .fallback = "false",
       .assign = [&](const std::string& text) { request.transparent = parse_switch(text); }});
}

}  // namespace

void add_picture_options(OptionSet& options, PictureRequest& request) {
  add_paths(options, request);
  add_subject(options, request);
  add_style(options, request);
}

picture::View default_view(const std::optional<CutPosition>& cut) {
  if (!cut) return picture::view_from(-55, 24);
  if (cut->axis == 0) return picture::view_from(-28, 20);
  return cut->axis == 1 ? picture::view_from(-62, 20) : picture::view_from(-60, 52);
}

CutPosition parse_cut(std::string_view text) {
  constexpr const char* kExpected = "x=SHARE, y=SHARE or z=SHARE with a share from 0 to 1";
  if (text.size() < 3 || text[0] < 'x' || text[0] > 'z' || text[1] != '=') fail_expected(kExpected);
  const CutPosition position{.axis = static_cast<std::size_t>(text[0] - 'x'),
                             .share = parse_number(text.substr(2))};
  if (position.share < 0 || position.share > 1) fail_expected(kExpected);
  return position;
}

picture::View parse_view(std::string_view text) {
  if (text == "iso") return default_view({});
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
