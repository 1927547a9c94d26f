// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels, and the record of the run, in a .vtkhdf file.
#include "io/mesh/vtkhdf/vtkhdf_names.h"

#include <algorithm>
#include <array>

#include "io/file/errors.h"
#include "io/hdf5/library_errors.h"
#include "io/mesh/vtkhdf/hdf5_array.h"

namespace mw::io {
namespace {

constexpr const char* kFields = "FieldData";
constexpr const char* kOurs = "mwmesh";
constexpr const char* kRecord = "record";
/// More than a table of names could need; a damaged file may announce anything.
constexpr std::uint64_t kMaxNumbers = 64 << 20;

/// A whole array: its numbers in memory, and the types there and in the file.
struct Numbers {
  std::array<hsize_t, 2> shape{0, 1};
  int rank = 1;
  hid_t file_type = H5I_INVALID_HID;
  hid_t memory_type = H5I_INVALID_HID;
  const void* data = nullptr;
};

Hdf5Handle creation(hid_t of_what) {
  Hdf5Handle properties(H5Pcreate(of_what), &H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  return properties;
}

Hdf5Handle make_group(hid_t place, const char* name) {
  return {H5Gcreate2(place, name, H5P_DEFAULT, creation(H5P_GROUP_CREATE).get(), H5P_DEFAULT),
          &H5Gclose};
}

bool write_array(hid_t group, const char* name, const Numbers& numbers) {
  constexpr hsize_t kMaxChunkRows = 1 << 16;
  const std::array<hsize_t, 2> chunk{std::min(numbers.shape[0], kMaxChunkRows), numbers.shape[1]};
  const Hdf5Handle space(H5Screate_simple(numbers.rank, numbers.shape.data(), nullptr), &H5Sclose);
  const Hdf5Handle properties = creation(H5P_DATASET_CREATE);
  H5Pset_chunk(properties.get(), numbers.rank, chunk.data());
  H5Pset_fill_time(properties.get(), H5D_FILL_TIME_ALLOC);
  const Hdf5Handle set(H5Dcreate2(group, name, numbers.file_type, space.get(), H5P_DEFAULT,
                                  properties.get(), H5P_DEFAULT),
                       &H5Dclose);
  return set.valid() &&
         H5Dwrite(set.get(), numbers.memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data) >= 0;
}

bool write_ids(hid_t group, const LabelNames& names, bool labels_signed) {
  std::vector<RawLabel> ids;
  for (const LabelName& row : names.rows()) ids.push_back(row.label);
  return write_array(group, kLabelId,
                     {.shape = {ids.size(), 1},
                      .file_type = labels_signed ? H5T_STD_I64LE : H5T_STD_U64LE,
                      .memory_type = labels_signed ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT64,
                      .data = ids.data()});
}

bool write_strings(hid_t group, const LabelNames& names) {
  std::vector<const char*> strings;
  for (const LabelName& row : names.rows()) strings.push_back(row.name.c_str());
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  return write_array(group, kLabelName,
                     {.shape = {strings.size(), 1},
                      .file_type = type.get(),
                      .memory_type = type.get(),
                      .data = strings.data()});
}

bool write_colours(hid_t group, const LabelNames& names) {
  std::vector<Colour> colours;
  for (const LabelName& row : names.rows()) colours.push_back(field_colour(row));
  return write_array(group, kLabelColour,
                     {.shape = {colours.size(), 4},
                      .rank = 2,
                      .file_type = H5T_STD_U8LE,
                      .memory_type = H5T_NATIVE_UINT8,
                      .data = colours.data()});
}

bool write_bytes(hid_t group, const char* array, const std::string& bytes) {
  return write_array(group, array,
                     {.shape = {bytes.size(), 1},
                      .file_type = H5T_STD_U8LE,
                      .memory_type = H5T_NATIVE_UINT8,
                      .data = bytes.data()});
}

std::string bytes_of(const LabelNames& names) {
  std::string bytes;
  for (const LabelName& row : names.rows()) bytes.append(row.name).push_back('\0');
  return bytes;
}

/// Not there is an answer, not known is none.
bool has_link(hid_t place, const std::string& path, const std::string& file) {
  const htri_t found = H5Lexists(place, path.c_str(), H5P_DEFAULT);
  if (found < 0) {
    fail_input(file, path, "cannot be looked up: " + hdf5_reason(), "the file or disk is damaged");
  }
  return found > 0;
}

/// An array of a group that may not be there either.
struct ArrayPlace {
  hid_t place = H5I_INVALID_HID;
  const char* group = nullptr;
  const char* array = nullptr;
};

bool has_array(const ArrayPlace& at, const std::string& file) {
  return has_link(at.place, at.group, file) &&
         has_link(at.place, text(at.group, "/", at.array), file);
}

std::vector<std::uint64_t> read_numbers(const Hdf5Array& array, std::uint64_t components) {
  const bool fits = array.is_integer() && array.components() == components;
  if (!fits || array.rows() > kMaxNumbers / components) array.fail("holds no table of names");
  std::vector<std::uint64_t> numbers(array.rows() * components);
  if (!array.is_signed()) {
    array.read(0, array.rows(), numbers.data());
    return numbers;
  }
  std::vector<std::int64_t> below(numbers.size());
  array.read(0, array.rows(), below.data());
  std::copy(below.begin(), below.end(), numbers.begin());
  return numbers;
}

std::vector<std::string> read_names(const Hdf5Array& array) {
  constexpr std::uint64_t kBatch = 1 << 16;
  if (!array.is_integer() || array.components() != 1 || array.rows() > kMaxNumbers) {
    array.fail("holds no names");
  }
  std::vector<std::string> names;
  std::string next;
  std::vector<std::uint64_t> batch;
  for (std::uint64_t at = 0; at < array.rows(); at += batch.size()) {
    batch.resize(std::min(kBatch, array.rows() - at));
    array.read(at, batch.size(), batch.data());
    for (const std::uint64_t byte : batch) {
      if (byte != 0) {
        next.push_back(static_cast<char>(byte));
        continue;
      }
      names.push_back(std::move(next));
      next.clear();
    }
  }
  return names;
}

}  // namespace

bool write_vtkhdf_facts(hid_t file, hid_t grid, const MeshHeader& header) {
  const LabelNames& names = header.names;
  const std::string record = record_text(header.record);
  if (names.empty() && record.empty()) return true;
  const Hdf5Handle ours = make_group(file, kOurs);
  if (!ours.valid()) return false;
  if (!record.empty() && !write_bytes(ours.get(), kRecord, record)) return false;
  if (names.empty()) return true;
  const Hdf5Handle fields = make_group(grid, kFields);
  return fields.valid() && write_ids(fields.get(), names, header.labels_signed) &&
         write_strings(fields.get(), names) && write_colours(fields.get(), names) &&
         write_bytes(ours.get(), kLabelName, bytes_of(names));
}

MeshRecord read_vtkhdf_record(hid_t file, const std::string& name) {
  if (!has_array({file, kOurs, kRecord}, name)) return {};
  const std::vector<std::uint64_t> bytes =
      read_numbers(Hdf5Array(file, text(kOurs, "/", kRecord), name), 1);
  return parse_record(std::string(bytes.begin(), bytes.end()), name);
}

LabelNames read_vtkhdf_names(hid_t file, hid_t grid, const std::string& name) {
  const bool has_all = has_array({grid, kFields, kLabelId}, name) &&
                       has_array({grid, kFields, kLabelColour}, name) &&
                       has_array({file, kOurs, kLabelName}, name);
  if (!has_all) return {};
  const Hdf5Array ids(grid, text(kFields, "/", kLabelId), name);
  const Hdf5Array colours(grid, text(kFields, "/", kLabelColour), name);
  const Hdf5Array names(file, text(kOurs, "/", kLabelName), name);
  return names_of({.ids = read_numbers(ids, 1),
                   .names = read_names(names),
                   .colours = read_numbers(colours, 4)},
                  name);
}

}  // namespace mw::io
