// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Collects resolution, unit and offset from where programs put them.
#include "io/volume/n5/open_n5.h"

#include <algorithm>
#include <optional>

#include "io/file/errors.h"
#include "io/volume/checks.h"

namespace mw::io {
namespace {

/// Returns a unit as the rest of the program calls it; empty: it is no length.
std::string short_unit(const std::string& unit) {
  struct Unit {
    const char* symbol;
    std::vector<std::string> names;
  };
  const std::array<Unit, 5> known_units{{
      {"nm", {"nanometer", "nanometers"}},
      {"um", {"micrometer", "micrometers", "micron", "microns", "\u00b5m", "\u03bcm"}},
      {"mm", {"millimeter", "millimeters"}},
      {"cm", {"centimeter", "centimeters"}},
      {"m", {"meter", "meters"}},
  }};
  for (const auto& [symbol, names] : known_units) {
    if (unit == symbol || std::find(names.begin(), names.end(), unit) != names.end()) return symbol;
  }
  return {};
}

/// Returns the unit, which must be the same for all axes.
std::string common_unit(const JsonFields& fields, std::string_view key,
                        const std::vector<std::string>& units) {
  for (const std::string& unit : units) {
    if (unit == units[0]) continue;
    fields.fail(key, "the axes have different units", "give the sizes of voxels with --spacing");
  }
  return units.empty() ? std::string() : short_unit(units[0]);
}

/// Returns the numbers of the array's axes along x, y and z.
Vector3 along_xyz(const JsonFields& fields, std::string_view key, const N5Array& array,
                  double otherwise) {
  const std::vector<double> numbers = fields.numbers(key);
  if (numbers.size() == array.dimensions.size()) {
    const auto at = [&](std::size_t i) {
      return array.axes[i] < 0 ? otherwise : numbers[static_cast<std::size_t>(array.axes[i])];
    };
    return {at(0), at(1), at(2)};
  }
  if (numbers.size() == 3) return {numbers[0], numbers[1], numbers[2]};
  fields.fail(
      key,
      text("has ", numbers.size(), " numbers, and the array ", array.dimensions.size(), " axes"),
      "the file is damaged");
}

struct Resolution {
  Vector3 spacing{1, 1, 1};
  std::string unit;
  std::string field;
};

std::string unit_beside(const JsonFields& fields) {
  for (const char* key : {"units", "unit"}) {
    if (!fields.has(key)) continue;
    if (fields.is_array(key)) return common_unit(fields, key, fields.texts(key));
    return short_unit(fields.text(key));
  }
  return {};
}

/// Reads {"dimensions": [...], "unit": "um"}, or the numbers alone.
std::optional<Resolution> resolution_of(const JsonFields& fields, const N5Array& array) {
  for (const char* key : {"pixelResolution", "resolution"}) {
    if (!fields.has(key)) continue;
    Resolution out{.field = fields.name_of(key)};
    if (fields.is_array(key)) {
      out.spacing = along_xyz(fields, key, array, 1);
      out.unit = unit_beside(fields);
    } else {
      const JsonFields object = fields.object(key);
      out.spacing = along_xyz(object, "dimensions", array, 1);
      out.unit = unit_beside(object);
    }
    for (const double x : out.spacing) check_spacing(fields.file(), out.field, x);
    return out;
  }
  return std::nullopt;
}

/// Returns the factors that a level's own array has, else the level's row of those of the group.
std::optional<Vector3> factors_of(const N5Attributes& attributes, const N5Array& array) {
  constexpr const char* kKey = "downsamplingFactors";
  const JsonFields own = attributes.own.fields();
  if (own.has(kKey)) return along_xyz(own, kKey, array, 1);
  if (attributes.group == nullptr) return std::nullopt;
  const JsonFields group = attributes.group->fields();
  for (const char* key : {kKey, "scales"}) {
    if (!group.has(key) || attributes.level >= group.count(key)) continue;
    const Json row{{key, attributes.group->json[key].elements()[attributes.level]}};
    return along_xyz(JsonFields(row, attributes.group->file), key, array, 1);
  }
  return std::nullopt;
}

/// Returns the resolution of the finest level, else that of the group for all.
std::optional<Resolution> base_resolution(const N5Attributes& attributes, const N5Array& array) {
  for (const N5Document* document : {attributes.finest, attributes.group}) {
    if (document == nullptr) continue;
    if (auto found = resolution_of(document->fields(), array)) return found;
  }
  return std::nullopt;
}

Resolution wanted_resolution(const N5Attributes& attributes, const N5Array& array) {
  const JsonFields fields = attributes.own.fields();
  const auto own = resolution_of(fields, array);
  const auto base = base_resolution(attributes, array);
  if (attributes.level == 0) return own ? *own : base.value_or(Resolution{});
  if (own && !(base && base->spacing == own->spacing)) return *own;
  const auto factors = factors_of(attributes, array);
  if (!factors && own) return *own;
  if (!factors) {
    fields.fail("downsamplingFactors",
                text("the level s", attributes.level, " does not say how much coarser it is"),
                "give the size of its voxels with --spacing");
  }
  Resolution out = base.value_or(Resolution{.field = "downsamplingFactors"});
  for (std::size_t i = 0; i < 3; ++i) out.spacing[i] *= (*factors)[i];
  for (const double x : out.spacing) check_spacing(fields.file(), out.field, x);
  return out;
}

std::optional<Vector3> wanted_offset(const N5Attributes& attributes, const N5Array& array) {
  for (const N5Document* document : {&attributes.own, attributes.finest, attributes.group}) {
    if (document == nullptr || !document->fields().has("offset")) continue;
    return along_xyz(document->fields(), "offset", array, 0);
  }
  return std::nullopt;
}

/// Returns COSEM's numbers along x, y and z, found by the names of axes.  An axis that the array
/// does not have (a slice's z) has `otherwise`.
Vector3 by_name(const JsonFields& transform, std::string_view key, const N5Array& array,
                double otherwise) {
  const std::vector<std::string> names = transform.texts("axes");
  const std::vector<double> numbers = transform.numbers(key);
  if (numbers.size() != names.size()) {
    transform.fail(key, text("has ", numbers.size(), " numbers for ", names.size(), " axes"),
                   "the file is damaged");
  }
  Vector3 out{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = std::find(names.begin(), names.end(), std::string(1, "xyz"[i]));
    if (found == names.end() && array.axes[i] >= 0) {
      transform.fail("axes", "the names are not x, y and z",
                     "give the place with --spacing and --origin");
    }
    out[i] =
        found == names.end() ? otherwise : numbers[static_cast<std::size_t>(found - names.begin())];
  }
  return out;
}

VolumeSpace space_of_transform(const JsonFields& transform, const N5Array& array,
                               const OpenOptions& options) {
  const std::string scale_field = transform.name_of("scale");
  const std::string translate_field = transform.name_of("translate");
  FileSpace space{.steps_field = scale_field.c_str(), .first_field = translate_field.c_str()};
  if (!options.spacing) {
    const Vector3 spacing = by_name(transform, "scale", array, 1);
    for (const double x : spacing) check_spacing(transform.file(), scale_field, x);
    space.steps = steps_of(spacing);
    if (transform.has("units")) {
      space.unit = common_unit(transform, "units", transform.texts("units"));
    }
  }
  if (!options.origin && transform.has("translate")) {
    constexpr double kCentreOfSlice = 0.5;
    space.first = by_name(transform, "translate", array, kCentreOfSlice);
  }
  return placed(transform.file(), space, options);
}

/// Returns the transform of the level in the `multiscales` of its group, where COSEM has it.
std::optional<JsonFields> transform_of_group(const N5Attributes& attributes) {
  if (attributes.group == nullptr) return std::nullopt;
  const JsonFields group = attributes.group->fields();
  if (!group.has("multiscales") || group.count("multiscales") == 0) return std::nullopt;
  const JsonFields multiscale = group.element("multiscales", 0);
  if (!multiscale.has("datasets")) return std::nullopt;
  for (std::size_t i = 0; i < multiscale.count("datasets"); ++i) {
    const JsonFields level = multiscale.element("datasets", i);
    if (level.text("path") != text("s", attributes.level)) continue;
    if (level.has("transform")) return level.object("transform");
  }
  return std::nullopt;
}

}  // namespace

Index3 n5_offset(const N5Attributes& attributes, const N5Array& array) {
  return number_of_first_voxel([&] {
    const bool has_transform =
        attributes.own.fields().has("transform") || transform_of_group(attributes);
    return OwnPlace{n5_space(attributes, array, {}), has_transform};
  });
}

VolumeSpace n5_space(const N5Attributes& attributes, const N5Array& array,
                     const OpenOptions& options) {
  const JsonFields own = attributes.own.fields();
  if (own.has("transform")) return space_of_transform(own.object("transform"), array, options);
  if (!options.spacing || !options.origin) {
    const auto transform = transform_of_group(attributes);
    if (transform) return space_of_transform(*transform, array, options);
  }
  Resolution resolution;
  if (!options.spacing) resolution = wanted_resolution(attributes, array);
  FileSpace space{.steps = steps_of(resolution.spacing),
                  .first_is_centre = false,
                  .unit = resolution.unit,
                  .steps_field = resolution.field.c_str(),
                  .first_field = "offset",
                  .is_sized = !resolution.field.empty()};
  if (!options.origin) space.first = wanted_offset(attributes, array);
  return placed(own.file(), space, options);
}

}  // namespace mw::io
