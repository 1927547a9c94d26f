// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the metadata of a multiscale image, and maps axes.
#include "io/volume/zarr/multiscale.h"

#include <algorithm>
#include <utility>

#include "io/file/errors.h"
#include "io/json/json_fields.h"
#include "io/volume/checks.h"
#include "io/volume/zarr/zarr_array.h"

namespace mw::io {
namespace {

std::optional<std::size_t> axis_named(const std::vector<std::string>& names,
                                      std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

/// Returns the axes that stay when the first ones of one entry are left out until there are three.
std::vector<std::size_t> last_three(const std::vector<std::int64_t>& shape) {
  std::size_t surplus = shape.size() > 3 ? shape.size() - 3 : 0;
  std::vector<std::size_t> kept;
  for (std::size_t axis = 0; axis < shape.size(); ++axis) {
    if (surplus > 0 && shape[axis] == 1) {
      --surplus;
    } else {
      kept.push_back(axis);
    }
  }
  return kept;
}

void check_others(std::string_view file, const std::vector<std::int64_t>& shape,
                  const std::vector<std::string>& names, const AxisMap& map,
                  std::string_view way_out) {
  for (std::size_t axis = 0; axis < shape.size(); ++axis) {
    if (std::find(map.axes.begin(), map.axes.end(), axis) != map.axes.end()) continue;
    if (shape[axis] == 1) continue;
    fail_input(file, "shape",
               text("axis ", axis, " ('", names[axis].substr(0, 30), "') has ", shape[axis],
                    " entries, and a volume is one of them"),
               way_out);
  }
}

/// Returns the object that has the metadata: from version 0.5 on it is "ome".
const Json& ome_of(const Json& attributes) {
  const Json* found = attributes.find("ome");
  return found != nullptr && found->is_object() ? *found : attributes;
}

std::string where_of(const Json& attributes) {
  return &ome_of(attributes) == &attributes ? "" : "ome";
}

void check_version(const JsonFields& fields) {
  if (!fields.has("version")) return;
  const std::string version = fields.text("version").substr(0, 30);
  for (const char* known : {"0.1", "0.2", "0.3", "0.4", "0.5"}) {
    if (version.rfind(known, 0) == 0) return;
  }
  fields.fail("version", "OME-NGFF '" + version + "' is not known here",
              "write the image in version 0.4 or 0.5");
}

/// Returns a unit as the rest of the program calls it; others stay as they are.
std::string short_unit(const std::string& unit) {
  constexpr std::array kUnits{
      std::pair{"picometer", "pm"}, std::pair{"nanometer", "nm"},  std::pair{"micrometer", "um"},
      std::pair{"micron", "um"},    std::pair{"millimeter", "mm"}, std::pair{"centimeter", "cm"},
      std::pair{"decimeter", "dm"}, std::pair{"meter", "m"},       std::pair{"kilometer", "km"},
  };
  for (const auto& [known, as_short] : kUnits) {
    if (unit == known) return as_short;
  }
  return unit.substr(0, 30);
}

/// Adds an axis, which is a name only in versions below 0.4.
void add_axis(const Json& axis, const JsonFields& fields, std::size_t index,
              std::vector<bool>& spatial, Multiscale& out) {
  if (axis.is_string()) {
    out.axis_names.push_back(axis.text());
    out.axis_units.emplace_back();
    spatial.push_back(false);
    return;
  }
  const JsonFields one = fields.element("axes", index);
  out.axis_names.push_back(one.text("name"));
  out.axis_units.push_back(one.has("unit") ? short_unit(one.text("unit")) : "");
  spatial.push_back(one.has("type") && one.text("type") == "space");
}

/// Names axes of space that are not called x, y and z: they are z, y, x in this order.
void name_axes(const std::vector<bool>& spatial, std::vector<std::string>& names) {
  const bool has_names = std::find(names.begin(), names.end(), "x") != names.end() &&
                         std::find(names.begin(), names.end(), "y") != names.end();
  const auto count = static_cast<std::size_t>(std::count(spatial.begin(), spatial.end(), true));
  if (has_names || count < 2 || count > 3) return;
  std::size_t next = 3 - count;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (spatial[i]) names[i] = std::string("zyx").substr(next++, 1);
  }
}

void parse_axes(const Json& multiscale, const JsonFields& fields, Multiscale& out) {
  if (!fields.has("axes")) return;
  const std::size_t count = fields.count("axes");
  check_axes(fields.file(), fields.name_of("axes"), count);
  std::vector<bool> spatial;
  for (std::size_t i = 0; i < count; ++i) {
    add_axis(multiscale["axes"].elements()[i], fields, i, spatial, out);
  }
  name_axes(spatial, out.axis_names);
}

/// Gives an empty vector `count` entries of `start`, and checks that any other has as many.
void match_length(std::vector<double>& numbers, std::size_t count, double start,
                  const JsonFields& fields, const char* key) {
  if (numbers.empty()) numbers.assign(count, start);
  if (numbers.size() == count) return;
  fields.fail(key, text("has ", count, " numbers, and another transform ", numbers.size()),
              "the file is damaged");
}

/// Applies one transformation to what the ones before it make of an index.
void add_transform(const JsonFields& step, LevelTransform& all, bool& has_position) {
  const std::string type = step.text("type");
  if (type == "identity") return;
  if (type != "scale" && type != "translation") {
    step.fail("type", "'" + type.substr(0, 60) + "' is not known here",
              "give the place with --spacing and --origin");
  }
  if (step.has("path")) {
    step.fail("path", "transformations in files of their own are not read",
              "give the place with --spacing and --origin");
  }
  const std::vector<double> numbers = step.numbers(type);
  match_length(all.scale, numbers.size(), 1, step, type.c_str());
  match_length(all.translation, numbers.size(), 0, step, type.c_str());
  has_position = has_position || type == "translation";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (type == "scale") {
      all.scale[i] *= numbers[i];
      all.translation[i] *= numbers[i];
    } else {
      all.translation[i] += numbers[i];
    }
  }
}

void add_transforms(const JsonFields& holder, LevelTransform& all, bool& has_position) {
  constexpr const char* kKey = "coordinateTransformations";
  if (!holder.has(kKey)) return;
  for (std::size_t i = 0; i < holder.count(kKey); ++i) {
    add_transform(holder.element(kKey, i), all, has_position);
  }
}

std::string common_unit(const Multiscale& multiscale, const AxisMap& axes, std::string_view file) {
  if (multiscale.axis_units.empty()) return {};
  std::string unit = multiscale.axis_units[*axes.axes[0]];
  for (const auto& axis : axes.axes) {
    if (!axis || multiscale.axis_units[*axis] == unit) continue;
    fail_input(
        file, "axes",
        text("the units of x, y and z differ ('", unit, "', '", multiscale.axis_units[*axis], "')"),
        "give the size of a voxel in one unit with --spacing");
  }
  return unit;
}

}  // namespace

Index3 AxisMap::pick(const std::vector<std::int64_t>& of_axes, std::int64_t missing) const {
  const auto along = [&](std::size_t i) { return axes[i] ? of_axes[*axes[i]] : missing; };
  return {along(0), along(1), along(2)};
}

std::vector<std::int64_t> AxisMap::spread(Index3 index, std::size_t count) const {
  std::vector<std::int64_t> out(count, 0);
  if (axes[0]) out[*axes[0]] = index.x;
  if (axes[1]) out[*axes[1]] = index.y;
  if (axes[2]) out[*axes[2]] = index.z;
  return out;
}

AxisMap map_axes(std::string_view file, const std::vector<std::int64_t>& shape,
                 const std::vector<std::string>& names, std::string_view way_out) {
  const AxisMap named{{axis_named(names, "x"), axis_named(names, "y"), axis_named(names, "z")}};
  if (named.axes[0] && named.axes[1]) {
    check_others(file, shape, names, named, way_out);
    return named;
  }
  if (shape.size() < 2) {
    fail_input(file, "shape", text(shape.size(), " axes, and a volume has three (a slice two)"),
               "is it the array that was meant?");
  }
  const std::vector<std::size_t> kept = last_three(shape);
  if (kept.size() > 3) {
    fail_input(file, "shape",
               text(shape_text(shape), " has ", kept.size(), " axes of more than one entry"),
               way_out);
  }
  AxisMap map{{kept[kept.size() - 1], kept[kept.size() - 2], std::nullopt}};
  if (kept.size() == 3) map.axes[2] = kept[0];
  return map;
}

bool has_multiscale(const Json& attributes) {
  const Json* found = ome_of(attributes).find("multiscales");
  return found != nullptr && found->is_array() && !found->empty();
}

Multiscale parse_multiscale(const Json& attributes, const std::string& file) {
  const Json& ome = ome_of(attributes);
  const JsonFields fields(ome, file, where_of(attributes));
  check_version(fields);
  const JsonFields multiscale = fields.element("multiscales", 0);
  check_version(multiscale);
  Multiscale out;
  parse_axes(ome["multiscales"].elements()[0], multiscale, out);
  for (std::size_t i = 0; i < multiscale.count("datasets"); ++i) {
    const JsonFields dataset = multiscale.element("datasets", i);
    MultiscaleLevel level{.path = dataset.text("path")};
    add_transforms(dataset, level.transform, out.has_position);
    add_transforms(multiscale, level.transform, out.has_position);
    out.levels.push_back(std::move(level));
  }
  if (out.levels.empty()) multiscale.fail("datasets", "there is none", "the file is damaged");
  return out;
}

FileSpace space_of(const Multiscale& multiscale, const MultiscaleLevel& level, const AxisMap& axes,
                   std::string_view file) {
  FileSpace space{.first_is_centre = true,
                  .steps_field = "coordinateTransformations: scale",
                  .first_field = "coordinateTransformations: translation"};
  const auto along = [&](const std::vector<double>& numbers, double missing) {
    Vector3 out{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& axis = axes.axes[i];
      if (axis && !numbers.empty() && *axis >= numbers.size()) {
        fail_input(file, "coordinateTransformations",
                   text(numbers.size(), " numbers for an array of more axes"),
                   "the file is damaged");
      }
      out[i] = axis && !numbers.empty() ? numbers[*axis] : missing;
    }
    return out;
  };
  space.steps = steps_of(along(level.transform.scale, 1));
  space.is_sized = !level.transform.scale.empty();
  if (multiscale.has_position) space.first = along(level.transform.translation, 0);
  space.unit = common_unit(multiscale, axes, file);
  return space;
}

std::vector<std::string> label_images(const Json& attributes) {
  std::vector<std::string> out;
  const Json* found = ome_of(attributes).find("labels");
  if (found == nullptr || !found->is_array()) return out;
  for (const Json& name : found->elements()) {
    if (name.is_string()) out.push_back(name.text());
  }
  return out;
}

}  // namespace mw::io
