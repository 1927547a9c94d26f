// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the attributes and small data sets that tell spacing and origin.
#include "io/volume/hdf5/describe_place.h"

#include <string>
#include <vector>

#include "io/hdf5/hdf5_handle.h"

namespace mw::io {
namespace {

constexpr hssize_t kMostNumbers = H5S_MAX_RANK;
constexpr std::size_t kMostTextBytes = 1 << 14;

/// Whether the type and space are those of a few numbers; how many.
std::size_t few_numbers(hid_t type_id, hid_t space_id) {
  const Hdf5Handle type(type_id, &H5Tclose);
  const Hdf5Handle space(space_id, &H5Sclose);
  if (!type.valid() || !space.valid()) return 0;
  const H5T_class_t kind = H5Tget_class(type.get());
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  const bool numbers = kind == H5T_INTEGER || kind == H5T_FLOAT;
  return numbers && count > 0 && count <= kMostNumbers ? static_cast<std::size_t>(count) : 0;
}

std::vector<double> attribute_numbers(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), &H5Aclose);
  if (!attribute.valid()) return {};
  std::vector<double> out(few_numbers(H5Aget_type(attribute.get()), H5Aget_space(attribute.get())));
  if (out.empty() || H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, out.data()) < 0) return {};
  return out;
}

std::vector<double> data_set_numbers(hid_t group, const char* name) {
  if (H5Lexists(group, name, H5P_DEFAULT) <= 0) return {};
  const Hdf5Handle set(H5Dopen2(group, name, H5P_DEFAULT), &H5Dclose);
  if (!set.valid()) return {};
  std::vector<double> out(few_numbers(H5Dget_type(set.get()), H5Dget_space(set.get())));
  if (out.empty() ||
      H5Dread(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()) < 0) {
    return {};
  }
  return out;
}

/// A string of fixed or of variable length.
std::string attribute_text(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), &H5Aclose);
  const Hdf5Handle type(H5Aget_type(attribute.get()), &H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), &H5Sclose);
  if (!type.valid() || H5Tget_class(type.get()) != H5T_STRING) return {};
  if (H5Sget_simple_extent_npoints(space.get()) != 1) return {};
  if (H5Tis_variable_str(type.get()) > 0) {
    char* text = nullptr;
    if (H5Aread(attribute.get(), type.get(), static_cast<void*>(&text)) < 0 || text == nullptr)
      return {};
    std::string out(text);
    H5free_memory(text);
    return out.size() <= kMostTextBytes ? out : std::string();
  }
  const std::size_t size = H5Tget_size(type.get());
  if (size == 0 || size > kMostTextBytes) return {};
  std::string out(size, '\0');
  if (H5Aread(attribute.get(), type.get(), out.data()) < 0) return {};
  return out.substr(0, out.find('\0'));
}

void keep(Hdf5Description& description, const char* name, std::vector<double> numbers) {
  if (!numbers.empty()) description.numbers[name] = std::move(numbers);
}

/// The geometry of DREAM.3D: a group `_SIMPL_GEOMETRY` of data sets up to version 7, attributes of
/// the image's group from version 8 on.  Whether there is one.
bool find_geometry(hid_t group, Hdf5Description& out) {
  if (H5Aexists(group, "_SPACING") > 0) {
    keep(out, "DIMENSIONS", attribute_numbers(group, "_DIMENSIONS"));
    keep(out, "SPACING", attribute_numbers(group, "_SPACING"));
    keep(out, "ORIGIN", attribute_numbers(group, "_ORIGIN"));
    return true;
  }
  if (H5Lexists(group, "_SIMPL_GEOMETRY", H5P_DEFAULT) <= 0) return false;
  const Hdf5Handle geometry(H5Gopen2(group, "_SIMPL_GEOMETRY", H5P_DEFAULT), &H5Gclose);
  if (!geometry.valid()) return false;
  keep(out, "DIMENSIONS", data_set_numbers(geometry.get(), "DIMENSIONS"));
  keep(out, "SPACING", data_set_numbers(geometry.get(), "SPACING"));
  keep(out, "ORIGIN", data_set_numbers(geometry.get(), "ORIGIN"));
  return true;
}

}  // namespace

void find_place(hid_t hdf5, hid_t set, Hdf5Description& description) {
  for (const char* name : {"resolution", "offset", "element_size_um"}) {
    keep(description, name, attribute_numbers(set, name));
  }
  description.axistags = attribute_text(set, "axistags");
  std::string path = description.path;
  while (path.rfind('/') != std::string::npos && path.size() > 1) {
    path.resize(path.rfind('/'));
    const Hdf5Handle group(H5Gopen2(hdf5, path.empty() ? "/" : path.c_str(), H5P_DEFAULT),
                           &H5Gclose);
    if (group.valid() && find_geometry(group.get(), description)) return;
  }
}

}  // namespace mw::io
