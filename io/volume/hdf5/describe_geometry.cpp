// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the attributes and small data sets that tell spacing and origin.
#include "io/volume/hdf5/describe_apart.h"

#include <algorithm>
#include <string>
#include <vector>

#include "io/file/errors.h"
#include "io/hdf5/hdf5_file.h"

namespace mw::io {
namespace {

constexpr hssize_t kMaxNumbers = H5S_MAX_RANK;
constexpr std::size_t kMaxTextBytes = 1 << 14;

/// Looks things up by name.  Finding none is no error, but a look-up that fails is damage.
class AttributeReader {
 public:
  explicit AttributeReader(std::string_view file) : file_(file) {}

  [[nodiscard]] bool has_attribute(hid_t object, const char* name) const {
    return demand(H5Aexists(object, name), name) > 0;
  }

  [[nodiscard]] std::vector<double> attribute_numbers(hid_t object, const char* name) const {
    if (!has_attribute(object, name)) return {};
    const Hdf5Handle attribute = opened(H5Aopen(object, name, H5P_DEFAULT), &H5Aclose, name);
    std::vector<double> out(
        few_numbers(H5Aget_type(attribute.get()), H5Aget_space(attribute.get()), name));
    if (!out.empty()) demand(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, out.data()), name);
    return out;
  }

  [[nodiscard]] std::vector<double> data_set_numbers(hid_t group, const char* name) const {
    const Hdf5Handle set = object(group, name);
    if (!set.valid() || H5Iget_type(set.get()) != H5I_DATASET) return {};
    if (const auto found = stored_elsewhere(group, set.get())) {
      fail_input(file_, name, found->reason, found->way_out);
    }
    std::vector<double> out(few_numbers(H5Dget_type(set.get()), H5Dget_space(set.get()), name));
    if (!out.empty()) {
      demand(H5Dread(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()),
             name);
    }
    return out;
  }

  /// Returns a string of fixed or of variable length; empty: there is none.
  [[nodiscard]] std::string attribute_text(hid_t object, const char* name) const {
    if (!has_attribute(object, name)) return {};
    const Hdf5Handle attribute = opened(H5Aopen(object, name, H5P_DEFAULT), &H5Aclose, name);
    const Hdf5Handle type = opened(H5Aget_type(attribute.get()), &H5Tclose, name);
    const Hdf5Handle space = opened(H5Aget_space(attribute.get()), &H5Sclose, name);
    const bool is_text = H5Tget_class(type.get()) == H5T_STRING;
    if (!is_text || demand(H5Sget_simple_extent_npoints(space.get()), name) != 1) refuse(name);
    if (demand(H5Tis_variable_str(type.get()), name) > 0) {
      return variable_text(attribute.get(), type.get(), name);
    }
    const std::size_t size = H5Tget_size(type.get());
    if (size > kMaxTextBytes) refuse(name);
    std::string out(size, '\0');
    demand(H5Aread(attribute.get(), type.get(), out.data()), name);
    return out.substr(0, out.find('\0'));
  }

  /// Returns nothing when there is none, and for a link that leads nowhere or to another file.
  [[nodiscard]] Hdf5Handle object(hid_t group, const char* name) const {
    if (demand(H5Lexists(group, name, H5P_DEFAULT), name) <= 0) return {};
    H5L_info_t link{};
    demand(H5Lget_info(group, name, &link, H5P_DEFAULT), name);
    if (link.type != H5L_TYPE_HARD && link.type != H5L_TYPE_SOFT) return {};
    if (demand(H5Oexists_by_name(group, name, H5P_DEFAULT), name) <= 0) return {};
    return opened(H5Oopen(group, name, H5P_DEFAULT), &H5Oclose, name);
  }

  [[nodiscard]] Hdf5Handle group(hid_t hdf5, const std::string& path) const {
    return opened(H5Gopen2(hdf5, path.c_str(), H5P_DEFAULT), &H5Gclose, path.c_str());
  }

 private:
  [[noreturn]] void refuse(const char* name) const {
    fail_input(file_, name, text("is not one text of up to ", kMaxTextBytes, " bytes"),
               kHdf5Damaged);
  }

  /// Returns the library's result, unless it is negative, which means that the library failed.
  template <class Result>
  Result demand(Result result, const char* name) const {
    if (result < 0) {
      fail_input(file_, name, text("cannot be read: ", hdf5_reason()), kHdf5Damaged);
    }
    return result;
  }

  [[nodiscard]] Hdf5Handle opened(hid_t id, Hdf5Handle::Close close, const char* name) const {
    return {demand(id, name), close};
  }

  /// Returns how many numbers type and space describe; 0 when these are no numbers.
  [[nodiscard]] std::size_t few_numbers(hid_t type_id, hid_t space_id, const char* name) const {
    const Hdf5Handle type(type_id, &H5Tclose);
    const Hdf5Handle space(space_id, &H5Sclose);
    demand(std::min(type_id, space_id), name);
    const H5T_class_t kind = H5Tget_class(type.get());
    const hssize_t count = demand(H5Sget_simple_extent_npoints(space.get()), name);
    const bool numbers = kind == H5T_INTEGER || kind == H5T_FLOAT;
    if (!numbers) return 0;
    if (count > kMaxNumbers) {
      fail_input(file_, name, text("holds ", count, " numbers, more than a place has"),
                 kHdf5Damaged);
    }
    return static_cast<std::size_t>(count);
  }

  [[nodiscard]] std::string variable_text(hid_t attribute, hid_t type, const char* name) const {
    char* bytes = nullptr;
    demand(H5Aread(attribute, type, static_cast<void*>(&bytes)), name);
    // A heap that has lost the text gives none.
    std::string out(bytes == nullptr ? "" : bytes);
    H5free_memory(bytes);
    if (out.empty() || out.size() > kMaxTextBytes) refuse(name);
    return out;
  }

  std::string_view file_;
};

void keep(Hdf5Description& description, const char* name, std::vector<double> numbers) {
  if (!numbers.empty()) description.numbers[name] = std::move(numbers);
}

/// Finds the geometry of DREAM.3D: a group `_SIMPL_GEOMETRY` of data sets up to version 7,
/// attributes of the image's group from version 8 on.  Returns whether there is one.
bool find_geometry(const AttributeReader& reader, hid_t group, Hdf5Description& out) {
  if (reader.has_attribute(group, "_SPACING")) {
    keep(out, "DIMENSIONS", reader.attribute_numbers(group, "_DIMENSIONS"));
    keep(out, "SPACING", reader.attribute_numbers(group, "_SPACING"));
    keep(out, "ORIGIN", reader.attribute_numbers(group, "_ORIGIN"));
    return true;
  }
  const Hdf5Handle geometry = reader.object(group, "_SIMPL_GEOMETRY");
  if (!geometry.valid() || H5Iget_type(geometry.get()) != H5I_GROUP) return false;
  keep(out, "DIMENSIONS", reader.data_set_numbers(geometry.get(), "DIMENSIONS"));
  keep(out, "SPACING", reader.data_set_numbers(geometry.get(), "SPACING"));
  keep(out, "ORIGIN", reader.data_set_numbers(geometry.get(), "ORIGIN"));
  return true;
}

}  // namespace

void find_geometry(hid_t hdf5, hid_t set, std::string_view file, Hdf5Description& description) {
  const AttributeReader reader(file);
  for (const char* name : {"resolution", "offset", "element_size_um", "spacing"}) {
    keep(description, name, reader.attribute_numbers(set, name));
  }
  description.axistags = reader.attribute_text(set, "axistags");
  std::string path = description.path;
  while (path.rfind('/') != std::string::npos && path.size() > 1) {
    path.resize(path.rfind('/'));
    const Hdf5Handle group = reader.group(hdf5, path.empty() ? "/" : path);
    if (find_geometry(reader, group.get(), description)) return;
  }
}

}  // namespace mw::io
