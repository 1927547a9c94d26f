// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The grid of a VTK image: its extent, its place, and which of its arrays holds labels.
#pragma once

#include <array>
#include <pugixml.hpp>
#include <string>

#include "io/volume/file_space.h"

namespace mw::io {

struct VtiGrid {
  std::array<std::int64_t, 6> extent{};  ///< of points: first and last along x, y, z
  /// Steps, and where the first point is.
  Vector3 origin{};
  std::array<Vector3, 3> steps{};
};

/// ERRORS of all: mw::Error(kInput) naming file and attribute.
[[nodiscard]] VtiGrid parse_vti_grid(pugi::xml_node image, const std::string& file);

/// A DataArray, of the points or of the cells.
struct VtiArray {
  pugi::xml_node node;
  bool of_points = false;
};
[[nodiscard]] VtiArray choose_vti_array(pugi::xml_node piece, const std::string& dataset,
                                        const std::string& file);

/// Voxels along x, y and z: as many as points, or as cells (one along an axis of a single point).
[[nodiscard]] Index3 vti_shape(const VtiGrid& grid, bool of_points, const std::string& file);

[[nodiscard]] FileSpace vti_space(const VtiGrid& grid, bool of_points);

}  // namespace mw::io
