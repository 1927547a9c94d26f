// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the ImageDescription of a stack, as OME-XML or as ImageJ's lines.
#include "io/volume/tiff/open_tiff.h"

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/volume/tiff/tiff_stack.h"

namespace mw::io {
namespace {

/// Returns "um" for the many names of a micrometre, also as ImageJ and Latin-1 write the letter.
std::string plain_unit(std::string_view unit) {
  for (const char* other :
       {"micron", "microns", "micrometer", "\xc2\xb5m", "\xce\xbcm", "\xb5m", "\\u00B5m"}) {
    if (unit == other) return "um";
  }
  return unit == "pixel" || unit == "pixels" ? "" : std::string(unit);
}

/// Returns how many metres a unit has; 0 where it is not known.
double metres(std::string_view unit) {
  constexpr std::pair<std::string_view, double> kUnits[]{
      {"m", 1},     {"cm", 1e-2},  {"mm", 1e-3},    {"um", 1e-6},
      {"nm", 1e-9}, {"pm", 1e-12}, {"inch", 0.0254}};
  for (const auto& [name, length] : kUnits) {
    if (unit == name) return length;
  }
  return 0;
}

/// Returns how many `wanted` a unit has; NaN, which is refused as a spacing, where it is not known.
double factor_between(std::string_view unit, std::string_view wanted) {
  if (unit == wanted) return 1;
  const double length = metres(unit), of_wanted = metres(wanted);
  return length > 0 && of_wanted > 0 ? length / of_wanted : std::nan("");
}

std::int64_t line_number(std::string_view description, std::string_view key,
                         std::int64_t otherwise) {
  const std::size_t at = description.find(text("\n", key, "="));
  if (at == std::string_view::npos) return otherwise;
  const std::string_view rest = description.substr(at + key.size() + 2);
  return parse_integer(trimmed(rest.substr(0, rest.find('\n')))).value_or(otherwise);
}

std::string_view line_text(std::string_view description, std::string_view key) {
  const std::size_t at = description.find(text("\n", key, "="));
  if (at == std::string_view::npos) return {};
  const std::string_view rest = description.substr(at + key.size() + 2);
  return trimmed(rest.substr(0, rest.find('\n')));
}

/// Reads "ImageJ=1.53t\nimages=12\nslices=12\nunit=micron\nspacing=2.5".
TiffDescription parse_imagej(std::string_view description, const TiffResolution& resolution,
                             const std::string& file) {
  for (const char* axis : {"channels", "frames"}) {
    const std::int64_t extent = line_number(description, axis, 1);
    if (extent == 1) continue;
    fail_input(file, text("ImageJ ", axis), text("the stack has ", extent),
               "save one of them as a stack of slices");
  }
  TiffDescription out{.unit = plain_unit(line_text(description, "unit")), .is_imagej = true};
  if (out.unit.empty() && resolution.per_centimetre) out.unit = "cm";
  if (const auto images = line_number(description, "images", 0); images > 0) out.slices = images;
  for (std::size_t i = 0; i < 2; ++i) {
    if (resolution.pixels[i] > 0) out.spacing[i] = 1 / resolution.pixels[i];
  }
  const std::string_view spacing = line_text(description, "spacing");
  if (!spacing.empty()) {
    // A negative spacing means a stack from top to bottom.
    out.spacing[2] = std::abs(parse_real(spacing).value_or(std::nan("")));
  }
  out.is_sized = !spacing.empty() || resolution.pixels[0] > 0;
  // These two lines are there where y and z have another unit than x.
  for (const auto& [i, key] : {std::pair{1U, "yunit"}, std::pair{2U, "zunit"}}) {
    const std::string unit = plain_unit(line_text(description, key));
    if (!unit.empty()) out.spacing[i] *= factor_between(unit, out.unit);
  }
  return out;
}

std::string note_of_resolution(const TiffResolution& resolution) {
  return text("its resolution of ", resolution.pixels[0], " x ", resolution.pixels[1],
              " pixels a centimetre is not read, as z has none: where it is that of voxels, give "
              "their edges with --spacing (",
              10 / resolution.pixels[0], " mm in x)");
}

void refuse_other_axes(pugi::xml_node pixels, const std::string& file) {
  for (const char* axis : {"SizeC", "SizeT"}) {
    const std::int64_t extent = pixels.attribute(axis).as_llong(1);
    if (extent == 1) continue;
    fail_input(file, text("OME-XML ", axis), text("the stack has ", extent),
               "save one channel and one time as a stack of slices");
  }
}

void refuse_other_order(pugi::xml_node pixels, const std::string& file) {
  for (const pugi::xml_node data : pixels.children("TiffData")) {
    const std::int64_t z = data.attribute("FirstZ").as_llong();
    const std::int64_t page = data.attribute("IFD").as_llong();
    if (z == page) continue;
    fail_input(file, "OME-XML TiffData", text("slice ", z, " is page ", page, " of a file"),
               "save the slices in order and in one file");
  }
}

/// Reads the edges of a voxel in the unit of the first axis that has one; it is um by default.
void read_sizes(pugi::xml_node pixels, TiffDescription& out) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string size = text("PhysicalSize", std::string_view("XYZ").substr(i, 1));
    const pugi::xml_attribute value = pixels.attribute(size.c_str());
    if (!value) {
      out.spacing[i] = std::nan("");
      continue;
    }
    const std::string unit =
        plain_unit(pixels.attribute((size + "Unit").c_str()).as_string("\xc2\xb5m"));
    if (out.unit.empty()) out.unit = unit;
    out.spacing[i] =
        parse_real(value.as_string()).value_or(std::nan("")) * factor_between(unit, out.unit);
  }
  const auto unknown = [](double x) { return std::isnan(x); };
  out.is_sized = !std::all_of(out.spacing.begin(), out.spacing.end(), unknown);
  if (!out.is_sized) out.spacing = {1, 1, 1};
  if (!unknown(out.spacing[0]) && unknown(out.spacing[1]) && unknown(out.spacing[2])) {
    out.spacing = {out.spacing[0], out.spacing[0], out.spacing[0]};
    out.note = "OME-XML has PhysicalSizeX alone: voxels are taken to be as wide in y and z";
  }
  // One slice is as thick as its pixels are wide.
  if (out.slices == 1 && unknown(out.spacing[2])) out.spacing[2] = out.spacing[0];
}

TiffDescription parse_ome(std::string_view description, const std::string& file) {
  pugi::xml_document xml;
  const auto result = xml.load_buffer(description.data(), description.size());
  if (!result) {
    fail_input(file, text("OME-XML at offset ", result.offset), result.description(),
               "the file is damaged");
  }
  const pugi::xml_node image = xml.child("OME").child("Image");
  const pugi::xml_node pixels = image.child("Pixels");
  if (!pixels) fail_input(file, "OME-XML", "it has no Image with Pixels", "the file is damaged");
  if (image.next_sibling("Image")) {
    fail_input(file, "OME-XML", "the file has several images", "save one of them");
  }
  refuse_other_axes(pixels, file);
  refuse_other_order(pixels, file);
  TiffDescription out;
  if (pixels.attribute("SizeZ")) out.slices = pixels.attribute("SizeZ").as_llong();
  read_sizes(pixels, out);
  return out;
}

}  // namespace

TiffDescription parse_tiff_description(std::string_view description,
                                       const TiffResolution& resolution, const std::string& file) {
  if (description.starts_with("ImageJ=")) return parse_imagej(description, resolution, file);
  if (description.find("<OME") != std::string_view::npos) return parse_ome(description, file);
  return {.note = resolution.per_centimetre ? note_of_resolution(resolution) : ""};
}

}  // namespace mw::io
