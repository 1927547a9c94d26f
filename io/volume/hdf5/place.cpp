// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds axes and place of an HDF5 data set.
#include "io/volume/hdf5/description.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/json/json_fields.h"
#include "io/volume/checks.h"

namespace mw::io {
namespace {

[[noreturn]] void fail(const Hdf5Description& description, std::string_view file,
                       std::string_view reason) {
  fail_input(file, text("data set ", description.path), reason,
             "write the one volume of it that is meant, as [z, y, x]");
}

/// Returns the keys of the axes, as "zyxc"; nothing without axistags.
std::string keys_of(const Hdf5Description& description, std::string_view file) {
  if (description.axistags.empty()) return {};
  try {
    std::string keys;
    const Json tags = parse_json(description.axistags, file);
    const JsonFields fields(tags, std::string(file));
    for (std::size_t i = 0; i < fields.count("axes"); ++i) {
      const std::string key = fields.element("axes", i).text("key");
      keys += key.size() == 1 ? key[0] : '?';
    }
    return keys;
  } catch (const Error&) {
    fail(description, file, "its axistags are no list of axes");
  }
}

Hdf5Axes tagged_axes(const Hdf5Description& description, const std::string& keys,
                     std::string_view file) {
  if (keys.size() != description.shape.size()) {
    fail(description, file,
         text("its axistags name ", keys.size(), " axes ('", keys, "'), it has ",
              description.shape.size()));
  }
  Hdf5Axes axes;
  for (std::size_t d = 0; d < keys.size(); ++d) {
    const std::size_t i = std::string_view("xyz").find(keys[d]);
    if (i != std::string_view::npos && !axes[i]) {
      axes[i] = d;
    } else if (description.shape[d] != 1) {
      fail(description, file,
           text("axis '", keys.substr(d, 1), "' of '", keys, "' has ", description.shape[d],
                " elements, a volume has one"));
    }
  }
  return axes;
}

/// Leaves out axes of one element, the first or the last ones first, until three are left.
std::vector<std::size_t> three_of(const Hdf5Description& description, bool last_first) {
  std::vector<std::size_t> left(description.shape.size());
  for (std::size_t d = 0; d < left.size(); ++d) left[d] = d;
  if (last_first) std::reverse(left.begin(), left.end());
  for (auto axis = left.begin(); axis != left.end() && left.size() > 3;) {
    axis = description.shape[*axis] == 1 ? left.erase(axis) : axis + 1;
  }
  std::sort(left.begin(), left.end());
  return left;
}

}  // namespace

Hdf5Axes find_axes(const Hdf5Description& description, std::string_view file) {
  const std::string keys = keys_of(description, file);
  if (!keys.empty()) return tagged_axes(description, keys, file);
  const bool of_dream3d = description.numbers.contains("SPACING");
  const std::vector<std::size_t> left = three_of(description, of_dream3d);
  if (left.size() == 2) return {left[1], left[0], std::nullopt};
  if (left.size() != 3) {
    fail(description, file,
         text("its shape is ", shape_text(description.shape), ", a volume has 3 axes"));
  }
  return {left[2], left[1], left[0]};
}

namespace {

std::optional<Vector3> three(const Hdf5Description& description, const char* name) {
  const auto found = description.numbers.find(name);
  if (found == description.numbers.end() || found->second.size() != 3) return std::nullopt;
  return Vector3{found->second[0], found->second[1], found->second[2]};
}

/// Some programs write an attribute `spacing` in the order of the array's axes and some as x, y, z,
/// so numbers that differ say nothing.
bool is_cube(const Vector3& edges) {
  return edges[0] == edges[1] && edges[1] == edges[2];
}

Vector3 reversed(const Vector3& v) {
  return {v[2], v[1], v[0]};
}

void check_dimensions(const Hdf5Description& description, const Index3& shape,
                      std::string_view file) {
  const auto dimensions = three(description, "DIMENSIONS");
  const Vector3 own{static_cast<double>(shape.x), static_cast<double>(shape.y),
                    static_cast<double>(shape.z)};
  if (!dimensions || *dimensions == own) return;
  fail_input(file, text("data set ", description.path),
             text("has ", shape.x, " x ", shape.y, " x ", shape.z,
                  " voxels, the DIMENSIONS of its geometry are ", (*dimensions)[0], " x ",
                  (*dimensions)[1], " x ", (*dimensions)[2]),
             "write both with DREAM.3D again, or the data set alone");
}

}  // namespace

FileSpace hdf5_space(const Hdf5Description& description, const Index3& shape,
                     std::string_view file) {
  FileSpace space;
  space.first_is_centre = false;
  if (const auto spacing = three(description, "SPACING")) {
    check_dimensions(description, shape, file);
    space.steps = steps_of(*spacing);
    space.first = three(description, "ORIGIN");
    space.steps_field = "SPACING";
    space.first_field = "ORIGIN";
  } else if (const auto resolution = three(description, "resolution")) {
    space.steps = steps_of(reversed(*resolution));
    if (const auto offset = three(description, "offset")) space.first = reversed(*offset);
    space.unit = "nm";
    space.steps_field = "attribute resolution";
    space.first_field = "attribute offset";
  } else if (const auto size = three(description, "element_size_um")) {
    space.steps = steps_of(reversed(*size));
    space.unit = "um";
    space.steps_field = "attribute element_size_um";
  } else if (const auto edges = three(description, "spacing"); edges && is_cube(*edges)) {
    space.steps = steps_of(*edges);
    space.steps_field = "attribute spacing";
  }
  return space;
}

}  // namespace mw::io
