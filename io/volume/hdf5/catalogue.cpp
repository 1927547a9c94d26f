// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lists the data sets of an HDF5 file, and finds the one that holds the labels.
#include "io/volume/hdf5/catalogue.h"

#include <algorithm>
#include <functional>

#include "io/file/errors.h"
#include "io/hdf5/hdf5_handle.h"
#include "io/hdf5/library_errors.h"
#include "io/volume/hdf5/number_type.h"

namespace mw::io {
namespace {

/// Data sets that an error names.
constexpr std::size_t kMaxNamed = 12;

Hdf5Entry entry_of(hid_t group, const char* name, std::string path) {
  Hdf5Entry entry{.path = std::move(path), .shape = {}, .type = "unreadable"};
  const Hdf5Handle set(H5Dopen2(group, name, H5P_DEFAULT), &H5Dclose);
  const Hdf5Handle type(set.valid() ? H5Dget_type(set.get()) : H5I_INVALID_HID, &H5Tclose);
  const Hdf5Handle space(set.valid() ? H5Dget_space(set.get()) : H5I_INVALID_HID, &H5Sclose);
  if (!type.valid() || !space.valid()) return entry;
  std::vector<hsize_t> shape(H5S_MAX_RANK);
  const int rank = H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
  entry.shape.assign(shape.begin(), shape.begin() + std::max(rank, 0));
  entry.type = type_text(type.get());
  const auto number = number_type(type.get());
  entry.is_integer = number && !is_float(number->type);
  return entry;
}

struct Visit {
  std::string below;  ///< the group with a slash behind it
  std::vector<Hdf5Entry> entries;
};

herr_t visit(hid_t group, const char* name, const H5O_info_t* info, void* data) {
  auto& found = *static_cast<Visit*>(data);
  if (info->type != H5O_TYPE_DATASET) return 0;
  found.entries.push_back(entry_of(group, name, found.below + name));
  return found.entries.size() < kMaxHdf5Entries ? 0 : 1;
}

using Fits = std::function<bool(const Hdf5Entry&)>;

std::vector<const Hdf5Entry*> all_that(const std::vector<Hdf5Entry>& entries, const Fits& fits) {
  std::vector<const Hdf5Entry*> found;
  for (const Hdf5Entry& entry : entries) {
    if (fits(entry)) found.push_back(&entry);
  }
  return found;
}

Fits is_named(const char* path) {
  return [path](const Hdf5Entry& entry) { return entry.path == path; };
}

bool is_feature_ids(const Hdf5Entry& entry) {
  return entry.path.ends_with("/FeatureIds") &&
         (entry.path.starts_with("/DataContainers/") || entry.path.starts_with("/DataStructure/"));
}

/// Integers with so many axes that are longer than 1.
Fits has_axes(int count) {
  return [count](const Hdf5Entry& entry) {
    const auto longer = std::count_if(entry.shape.begin(), entry.shape.end(),
                                      [](std::uint64_t extent) { return extent > 1; });
    return entry.is_integer && longer == count;
  };
}

bool is_labels_of_cremi(const Hdf5Entry& entry) {
  return entry.path.starts_with("/volumes/labels/") && has_axes(3)(entry);
}

[[noreturn]] void fail_choice(std::string_view file, const char* reason,
                              const std::vector<const Hdf5Entry*>& among) {
  std::vector<Hdf5Entry> entries;
  for (const Hdf5Entry* entry : among) entries.push_back(*entry);
  fail_input(file, "HDF5 data sets", text(reason, ": ", list_text(entries)),
             "name one with --dataset");
}

}  // namespace

std::vector<Hdf5Entry> list_data_sets(hid_t hdf5, const std::string& group, std::string_view file) {
  Visit found{.below = group.ends_with('/') ? group : group + "/", .entries = {}};
  if (H5Ovisit_by_name2(hdf5, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, &visit, &found,
                        H5O_INFO_BASIC, H5P_DEFAULT) < 0) {
    fail_input(file, "HDF5 structure", text("cannot list the groups: ", hdf5_reason()),
               "the file is damaged: check it with h5dump -H");
  }
  return std::move(found.entries);
}

const std::string& choose_data_set(const std::vector<Hdf5Entry>& entries, std::string_view file) {
  const std::vector<Fits> conventions{is_named("/volumes/labels/neuron_ids"),
                                      is_labels_of_cremi,
                                      is_named("/exported_data"),
                                      is_feature_ids,
                                      has_axes(3),
                                      has_axes(2)};
  for (const Fits& fits : conventions) {
    const auto found = all_that(entries, fits);
    if (found.size() == 1) return found[0]->path;
    if (found.size() > 1) fail_choice(file, "several may hold the labels", found);
  }
  fail_choice(file, "none is an array of integers with 3 axes",
              all_that(entries, [](const Hdf5Entry&) { return true; }));
}

std::string list_text(const std::vector<Hdf5Entry>& entries) {
  if (entries.empty()) return "there is none";
  std::string out;
  for (std::size_t i = 0; i < std::min(entries.size(), kMaxNamed); ++i) {
    const Hdf5Entry& entry = entries[i];
    out += text(i == 0 ? "" : ", ", entry.path, " ", shape_text(entry.shape),
                entry.shape.empty() ? "" : " ", entry.type);
  }
  if (entries.size() > kMaxNamed) out += text(" and ", entries.size() - kMaxNamed, " more");
  return out;
}

std::string shape_text(const std::vector<std::uint64_t>& shape) {
  std::string out;
  for (const std::uint64_t extent : shape) out += text(out.empty() ? "" : " x ", extent);
  return out;
}

}  // namespace mw::io
