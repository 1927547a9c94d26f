// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels as field data of a .vtkhdf file.
#include "io/mesh/vtkhdf/vtkhdf_names.h"

#include <array>

#include "io/file/errors.h"
#include "io/mesh/vtkhdf/hdf5_array.h"
#include "io/names/clean_name.h"

namespace mw::io {
namespace {

constexpr const char* kGroup = "FieldData";
/// More names than a file of one to be read could need; a damaged one may announce any number.
constexpr std::uint64_t kMaxNames = 1 << 20;

Hdf5Handle string_type() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  return type;
}

/// A whole array at once; memory: the same numbers as they are in memory.
bool write_array(hid_t group, const char* name, std::array<hsize_t, 2> shape, int rank,
                 std::array<hid_t, 2> file_and_memory_type, const void* data) {
  const Hdf5Handle space(H5Screate_simple(rank, shape.data(), nullptr), &H5Sclose);
  const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  const Hdf5Handle set(H5Dcreate2(group, name, file_and_memory_type[0], space.get(), H5P_DEFAULT,
                                  properties.get(), H5P_DEFAULT),
                       &H5Dclose);
  return set.valid() &&
         H5Dwrite(set.get(), file_and_memory_type[1], H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0;
}

std::string path_of(const char* array) {
  return text(kGroup, "/", array);
}

bool has_array(hid_t grid, const char* array) {
  return H5Lexists(grid, kGroup, H5P_DEFAULT) > 0 &&
         H5Lexists(grid, path_of(array).c_str(), H5P_DEFAULT) > 0;
}

/// Of an array of variable strings; other strings are none of ours.
Hdf5Handle open_strings(hid_t grid) {
  Hdf5Handle set(H5Dopen2(grid, path_of(kLabelName).c_str(), H5P_DEFAULT), &H5Dclose);
  const Hdf5Handle type(H5Dget_type(set.get()), &H5Tclose);
  if (!type.valid() || H5Tis_variable_str(type.get()) <= 0) return {};
  return set;
}

/// One name, cut at kMaxNameBytes.
std::string read_string(hid_t set, hid_t type, hid_t memory, hid_t place, hsize_t row,
                        const std::string& file) {
  constexpr hsize_t kOne = 1;
  char* bytes = nullptr;
  if (H5Sselect_hyperslab(place, H5S_SELECT_SET, &row, nullptr, &kOne, nullptr) < 0 ||
      H5Dread(set, type, memory, place, H5P_DEFAULT, static_cast<void*>(&bytes)) < 0) {
    fail_input(file, text("data set '", path_of(kLabelName), "'"), text("cannot read row ", row),
               "the file is truncated or damaged");
  }
  std::string out = bytes == nullptr ? std::string() : clean_name(bytes);
  H5Dvlen_reclaim(type, memory, H5P_DEFAULT, static_cast<void*>(&bytes));
  return out;
}

std::vector<std::string> read_strings(const Hdf5Handle& set, const std::string& file) {
  const Hdf5Handle place(H5Dget_space(set.get()), &H5Sclose);
  const hssize_t count =
      H5Sget_simple_extent_ndims(place.get()) == 1 ? H5Sget_simple_extent_npoints(place.get()) : 0;
  if (count < 0 || static_cast<std::uint64_t>(count) > kMaxNames) {
    fail_input(file, text("data set '", path_of(kLabelName), "'"),
               text(count, " names are not credible"), "the file is damaged");
  }
  constexpr hsize_t kOne = 1;
  const Hdf5Handle memory(H5Screate_simple(1, &kOne, nullptr), &H5Sclose);
  const Hdf5Handle stored(H5Dget_type(set.get()), &H5Tclose);
  const Hdf5Handle type(H5Tcopy(stored.get()), &H5Tclose);
  std::vector<std::string> out;
  for (hsize_t row = 0; row < static_cast<hsize_t>(count); ++row) {
    out.push_back(read_string(set.get(), type.get(), memory.get(), place.get(), row, file));
  }
  return out;
}

std::vector<std::uint64_t> read_integers(const Hdf5Array& array) {
  if (array.rows() > kMaxNames) array.fail("more names than are credible");
  if (!array.is_signed()) {
    std::vector<std::uint64_t> numbers(array.rows() * array.components());
    array.read(0, array.rows(), numbers.data());
    return numbers;
  }
  std::vector<std::int64_t> numbers(array.rows() * array.components());
  array.read(0, array.rows(), numbers.data());
  return {numbers.begin(), numbers.end()};
}

}  // namespace

bool write_vtkhdf_names(hid_t grid, const LabelNames& names, bool labels_signed) {
  if (names.empty()) return true;
  std::vector<RawLabel> ids;
  std::vector<const char*> strings;
  std::vector<std::uint8_t> colours;
  for (const LabelName& row : names.rows()) {
    ids.push_back(row.label);
    strings.push_back(row.name.c_str());
    const Colour colour = field_colour(row);
    colours.insert(colours.end(), colour.begin(), colour.end());
  }
  const Hdf5Handle properties(H5Pcreate(H5P_GROUP_CREATE), &H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  const Hdf5Handle group(H5Gcreate2(grid, kGroup, H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                         &H5Gclose);
  const Hdf5Handle string = string_type();
  const std::array<hid_t, 2> id = labels_signed ? std::array{H5T_STD_I64LE, H5T_NATIVE_INT64}
                                                : std::array{H5T_STD_U64LE, H5T_NATIVE_UINT64};
  const std::array<hsize_t, 2> shape{ids.size(), 4};
  return group.valid() && write_array(group.get(), kLabelId, shape, 1, id, ids.data()) &&
         write_array(group.get(), kLabelName, shape, 1, {string.get(), string.get()},
                     strings.data()) &&
         write_array(group.get(), kLabelColour, shape, 2, {H5T_STD_U8LE, H5T_NATIVE_UINT8},
                     colours.data());
}

LabelNames read_vtkhdf_names(hid_t grid, const std::string& file) {
  if (!has_array(grid, kLabelId) || !has_array(grid, kLabelName)) return {};
  const Hdf5Array ids(grid, path_of(kLabelId), file);
  const Hdf5Handle strings = open_strings(grid);
  if (!ids.is_integer() || ids.components() != 1 || !strings.valid()) return {};
  FieldNames read{.ids = read_integers(ids), .names = read_strings(strings, file), .colours = {}};
  if (has_array(grid, kLabelColour)) {
    const Hdf5Array colours(grid, path_of(kLabelColour), file);
    if (colours.is_integer() && colours.components() == 4) read.colours = read_integers(colours);
  }
  return names_of(read, file);
}

}  // namespace mw::io
