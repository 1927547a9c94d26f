// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds x, y and z among the axes of an array.
#include "io/volume/zarr/axis_map.h"

#include <algorithm>

#include "io/file/errors.h"

namespace mw::io {
namespace {

std::optional<std::size_t> axis_named(const std::vector<std::string>& names,
                                      std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

/// The axes that stay when leading ones of one entry, and then any such, go until there are three.
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

std::string shape_text(const std::vector<std::int64_t>& shape) {
  std::string out;
  for (const std::int64_t extent : shape) out += text(out.empty() ? "" : " x ", extent);
  return out;
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

}  // namespace mw::io
