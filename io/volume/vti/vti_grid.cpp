// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The grid of a VTK image, and which of its arrays holds labels.
#include "io/volume/vti/vti_grid.h"

#include <algorithm>
#include <vector>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/volume/checks.h"
#include "io/vtk_xml/data_array.h"

namespace mw::io {
namespace {

/// The numbers of an attribute, or those that VTK takes when it is missing.
std::vector<double> reals(pugi::xml_node node, const char* attribute,
                          const std::vector<double>& otherwise, const std::string& file) {
  const pugi::xml_attribute value = node.attribute(attribute);
  if (!value) return otherwise;
  auto numbers = parse_reals(value.as_string());
  if (!numbers || numbers->size() != otherwise.size()) {
    fail_input(file, attribute,
               text("'", value.as_string(), "' is not ", otherwise.size(), " numbers"));
  }
  return *numbers;
}

std::array<std::int64_t, 6> extent_of(pugi::xml_node node, const char* attribute,
                                      const std::string& file) {
  const auto numbers = parse_integers(node.attribute(attribute).as_string());
  if (!numbers || numbers->size() != 6) {
    fail_input(file, attribute, "missing, or not six whole numbers", "the file is damaged");
  }
  std::array<std::int64_t, 6> extent{};
  std::copy_n(numbers->begin(), 6, extent.begin());
  for (const std::int64_t x : extent) {
    constexpr std::int64_t kMax = std::int64_t{1} << 40;
    if (x < -kMax || x > kMax) fail_input(file, attribute, text(x, " is not credible"));
  }
  return extent;
}

bool is_label_array(pugi::xml_node array) {
  const auto type = parse_number_type(array.attribute("type").as_string());
  return type && array.attribute("NumberOfComponents").as_int(1) == 1;
}

bool is_integer(pugi::xml_node array) {
  const auto type = parse_number_type(array.attribute("type").as_string());
  return type && !type->is_float;
}

std::string name_of(const VtiArray& array) {
  return array.node.attribute("Name").as_string();
}

/// Arrays of one number a voxel, those of cells first.
std::vector<VtiArray> label_arrays(pugi::xml_node piece) {
  std::vector<VtiArray> arrays;
  for (const bool of_points : {false, true}) {
    for (const pugi::xml_node array :
         piece.child(of_points ? "PointData" : "CellData").children("DataArray")) {
      if (is_label_array(array)) arrays.push_back({array, of_points});
    }
  }
  return arrays;
}

std::string listed(const std::vector<VtiArray>& arrays) {
  std::string names;
  for (const VtiArray& array : arrays) names += (names.empty() ? "" : ", ") + name_of(array);
  return names;
}

/// Whether the cells or points call it their Scalars.
bool is_scalars(const VtiArray& array) {
  const std::string scalars = array.node.parent().attribute("Scalars").as_string();
  return !scalars.empty() && scalars == name_of(array);
}

}  // namespace

VtiGrid parse_vti_grid(pugi::xml_node image, const std::string& file) {
  VtiGrid grid{.extent = extent_of(image, "WholeExtent", file)};
  const pugi::xml_node piece = image.child("Piece");
  if (!piece || piece.next_sibling("Piece") || extent_of(piece, "Extent", file) != grid.extent) {
    fail_input(file, "Piece", "not one piece of the WholeExtent", "save the image as one piece");
  }
  const auto origin = reals(image, "Origin", {0, 0, 0}, file);
  const auto spacing = reals(image, "Spacing", {1, 1, 1}, file);
  const auto m = reals(image, "Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1}, file);
  for (std::size_t k = 0; k < 3; ++k) {
    grid.origin[k] = origin[k];
    // Columns of Direction are the array's axes.
    for (std::size_t i = 0; i < 3; ++i) grid.steps[i][k] = m[3 * k + i] * spacing[i];
  }
  return grid;
}

VtiArray choose_vti_array(pugi::xml_node piece, const std::string& dataset,
                          const std::string& file) {
  std::vector<VtiArray> arrays = label_arrays(piece);
  const std::string all = listed(arrays);
  if (!dataset.empty()) {
    const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const VtiArray& array) {
      return name_of(array) == dataset;
    });
    if (found != arrays.end()) return *found;
    fail_input(file, text("array '", dataset, "'"), "there is none of one number a voxel",
               text("the file has: ", all));
  }
  const auto scalars = std::find_if(arrays.begin(), arrays.end(), is_scalars);
  if (scalars != arrays.end()) return *scalars;
  std::erase_if(arrays, [](const VtiArray& array) { return !is_integer(array.node); });
  if (arrays.size() == 1) return arrays.front();
  fail_input(file, "DataArray", text("none is marked as Scalars, ", arrays.size(), " are integers"),
             text("choose one of these with --dataset: ", all));
}

Index3 vti_shape(const VtiGrid& grid, bool of_points, const std::string& file) {
  std::array<std::int64_t, 3> shape{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t cells = grid.extent[2 * i + 1] - grid.extent[2 * i];
    shape[i] = of_points ? cells + 1 : cells == 0 ? 1 : cells;
  }
  return checked_shape(file, "WholeExtent", shape);
}

FileSpace vti_space(const VtiGrid& grid, bool of_points) {
  FileSpace space{.steps = grid.steps,
                  .first = grid.origin,
                  .first_is_centre = of_points,
                  .steps_field = "Spacing or Direction",
                  .first_field = "Origin"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto first = static_cast<double>(grid.extent[2 * i]);
    for (std::size_t k = 0; k < 3; ++k) {
      if (first != 0) (*space.first)[k] += first * grid.steps[i][k];
    }
  }
  return space;
}

}  // namespace mw::io
