// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Spacing and origin from the attributes of an HDF5 data set.
#include "io/volume/hdf5/geometry.h"

#include <optional>

#include "io/file/errors.h"

namespace mw::io {
namespace {

std::optional<Vector3> three(const Hdf5Description& description, const char* name) {
  const auto found = description.numbers.find(name);
  if (found == description.numbers.end() || found->second.size() != 3) return std::nullopt;
  return Vector3{found->second[0], found->second[1], found->second[2]};
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
  }
  return space;
}

}  // namespace mw::io
