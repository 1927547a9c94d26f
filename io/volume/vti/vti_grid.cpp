// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where an image of VTK lies, and its arrays.
#include <algorithm>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/volume/decode.h"
#include "io/volume/vti/open_vti.h"

namespace mw::io {
namespace {

/// Returns the numbers of an attribute; those of `otherwise` where it is missing.
std::vector<double> reals_of(const VtkDocument& document, pugi::xml_node node,
                             const char* attribute, const std::vector<double>& otherwise) {
  const pugi::xml_attribute found = node.attribute(attribute);
  if (!found) return otherwise;
  const auto numbers = parse_reals(found.as_string());
  if (numbers && numbers->size() == otherwise.size()) return *numbers;
  fail_input(document.file(), text("ImageData ", attribute),
             text("'", printable(found.as_string(), 60), "' is not ", otherwise.size(), " numbers"),
             "the file is damaged");
}

std::vector<std::int64_t> extent_of(const VtkDocument& document, pugi::xml_node node,
                                    const char* attribute) {
  const auto numbers = parse_integers(node.attribute(attribute).as_string());
  constexpr std::int64_t kMost = std::int64_t{1} << 40U;
  const auto is_sound = [](std::int64_t x) { return x >= -kMost && x <= kMost; };
  if (numbers && numbers->size() == 6 && std::ranges::all_of(*numbers, is_sound)) return *numbers;
  fail_input(document.file(), text(node.name(), " ", attribute), "not six whole numbers",
             "the file is damaged");
}

/// Returns the only piece of the image.
pugi::xml_node piece_of(const VtkDocument& document) {
  const pugi::xml_node piece = document.grid().child("Piece");
  if (!piece) {
    fail_input(document.file(), "Piece", "the image has none", "the file is truncated");
  }
  if (piece.next_sibling("Piece") ||
      extent_of(document, piece, "Extent") != extent_of(document, document.grid(), "WholeExtent")) {
    fail_input(document.file(), "Piece", "the image is in several pieces, or only a part is there",
               "save it as one piece");
  }
  return piece;
}

std::optional<VoxelType> voxel_type(pugi::xml_node array) {
  const auto type = parse_number_type(array.attribute("type").as_string());
  if (!type) return std::nullopt;
  return type->is_float ? float_type(type->bytes) : integer_type(type->bytes, type->is_signed);
}

bool has_one_component(pugi::xml_node array) {
  return std::string_view(array.attribute("NumberOfComponents").as_string("1")) == "1";
}

/// Returns all arrays with one number for each point or cell.
std::vector<VtiArray> arrays_of(pugi::xml_node piece) {
  std::vector<VtiArray> out;
  for (const char* where : {"PointData", "CellData"}) {
    for (const pugi::xml_node node : piece.child(where).children("DataArray")) {
      const std::string_view name = node.attribute("Name").as_string();
      const auto type = voxel_type(node);
      if (!type || !has_one_component(node) || name.starts_with("vtk")) continue;
      out.push_back({.node = node,
                     .path = text(where, "/", name),
                     .type = *type,
                     .is_cells = std::string_view(where) == "CellData"});
    }
  }
  return out;
}

std::string listed_paths(const std::vector<VtiArray>& arrays) {
  constexpr std::size_t kMost = 20;
  std::string out;
  for (std::size_t i = 0; i < arrays.size() && i < kMost; ++i) {
    out += (i == 0 ? "" : ", ") + printable(arrays[i].path, 100);
  }
  return arrays.size() > kMost ? out + ", ..." : out;
}

VtiArray named_array(const VtkDocument& document, const std::vector<VtiArray>& arrays,
                     const std::string& dataset) {
  std::vector<VtiArray> found;
  std::ranges::copy_if(arrays, std::back_inserter(found), [&](const VtiArray& array) {
    return array.path == dataset || array.path.ends_with("/" + dataset);
  });
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    fail_usage("--dataset ", dataset, ": ", document.file(),
               " has no array of one component of this name; it has ", listed_paths(arrays));
  }
  fail_usage("--dataset ", dataset, ": ", document.file(), " has several: ", listed_paths(found));
}

}  // namespace

VtiGrid parse_vti_grid(const VtkDocument& document) {
  const pugi::xml_node image = document.grid();
  const std::vector<std::int64_t> extent = extent_of(document, image, "WholeExtent");
  const auto spacing = reals_of(document, image, "Spacing", {1, 1, 1});
  const auto origin = reals_of(document, image, "Origin", {0, 0, 0});
  const auto turned = reals_of(document, image, "Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1});
  VtiGrid out{
      .space = {.steps_field = "ImageData Spacing, Direction", .first_field = "ImageData Origin"}};
  out.space.is_sized = !image.attribute("Spacing").empty();
  Vector3 first{origin[0], origin[1], origin[2]};
  for (std::size_t i = 0; i < 3; ++i) {
    out.points[i] = extent[2 * i + 1] - extent[2 * i] + 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double step = turned[3 * k + i] * spacing[i];
      out.space.steps[i][k] = step;
      first[k] += step * static_cast<double>(extent[2 * i]);
    }
  }
  out.space.first = first;
  return out;
}

VtiArray choose_vti_array(const VtkDocument& document, const std::string& dataset) {
  const std::vector<VtiArray> all = arrays_of(piece_of(document));
  if (!dataset.empty()) return named_array(document, all, dataset);
  std::vector<VtiArray> meant;
  std::ranges::copy_if(all, std::back_inserter(meant),
                       [](const VtiArray& array) { return !is_float(array.type); });
  if (meant.empty()) meant = all;
  if (meant.size() == 1) return meant.front();
  if (meant.empty()) {
    fail_input(document.file(), "PointData and CellData", "no array has one number a point or cell",
               "save the labels as an array of integers");
  }
  fail_input(document.file(), {}, "has several arrays: " + listed_paths(meant),
             "choose one with --dataset");
}

}  // namespace mw::io
