// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A multiscale image of OME-NGFF, one volume at several resolutions, and which axes of its arrays
// are x, y and z.
// Format: https://ngff.openmicroscopy.org/0.5/
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/json/json.h"
#include "io/volume/checks.h"
#include "kernels/core/index.h"

namespace mw::io {

struct AxisMap {
  /// The axes of x, y and z; empty for the z of an array of two axes, which is one slice.
  std::array<std::optional<std::size_t>, 3> axes;

  /// Returns the entries for x, y and z of a vector by axis; `missing` for the z of a slice.
  [[nodiscard]] Index3 pick(const std::vector<std::int64_t>& of_axes, std::int64_t missing) const;
  /// Returns a vector by axis with the entries of index; 0 along all other axes.
  [[nodiscard]] std::vector<std::int64_t> spread(Index3 index, std::size_t axes) const;
};

/// Finds x, y and z by their names (z may be missing); without names of x and y the axes are z, y,
/// x in this order.  All others must have one entry, and without names they are the first that have
/// one.  There are as many names as axes, or none.  way_out says what to do about further axes.
/// ERRORS: mw::Error(kInput) naming file and axis.
[[nodiscard]] AxisMap map_axes(std::string_view file, const std::vector<std::int64_t>& shape,
                               const std::vector<std::string>& names, std::string_view way_out);

/// Takes an index along an axis to the world: scale * index + translation.
struct LevelTransform {
  std::vector<double> scale;  ///< one number for each axis
  std::vector<double> translation;
};

struct MultiscaleLevel {
  std::string path;  ///< path of its array, relative to the group
  LevelTransform transform;
};

struct Multiscale {
  std::vector<std::string> axis_names;  ///< as map_axes wants them; empty: unknown
  std::vector<std::string> axis_units;  ///< in short, "nm"; as many as names
  std::vector<MultiscaleLevel> levels;  ///< the finest first
  /// Whether any transform has a translation: only then they place the centres of voxels.
  bool has_position = false;
};

/// True if the attributes of a group have multiscales, of OME-NGFF 0.1 to 0.5.
[[nodiscard]] bool has_multiscale(const Json& attributes);

/// Returns the first multiscale.  REQUIRES: has_multiscale(attributes); they are an object.
/// ERRORS: mw::Error(kInput) naming file and field.
[[nodiscard]] Multiscale parse_multiscale(const Json& attributes, const std::string& file);

/// Returns the place of a level whose array has `axes`.  Unless the caller gives a spacing, x, y
/// and z must have the same unit.
/// ERRORS: mw::Error(kInput) naming file and field when the transform is not of as many axes.
[[nodiscard]] FileSpace space_of(const Multiscale& multiscale, const MultiscaleLevel& level,
                                 const AxisMap& axes, std::string_view file);

/// Returns the names of the label images that the attributes of an image's group `labels` list.
[[nodiscard]] std::vector<std::string> label_images(const Json& attributes);

}  // namespace mw::io
