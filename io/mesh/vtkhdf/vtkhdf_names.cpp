// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels, and the record of the run, in a .vtkhdf file.
#include "io/mesh/vtkhdf/vtkhdf.h"

#include <algorithm>
#include <array>

#include "io/file/errors.h"
#include "io/hdf5/hdf5_file.h"
#include "io/mesh/vtkhdf/hdf5_array.h"

namespace mw::io {
namespace {

constexpr const char* kFields = "FieldData";
constexpr const char* kOurs = "mwmesh";
constexpr const char* kRecord = "record";
/// More than a table of names could need; a damaged file may announce anything.
constexpr std::uint64_t kMaxNumbers = 64 << 20;

Hdf5DataSet ids_of(Hdf5Output& output, const MeshHeader& header) {
  std::vector<RawLabel> ids;
  for (const LabelName& row : header.names.rows()) ids.push_back(row.label);
  return output.add({.name = kLabelId,
                     .kind = header.labels_signed ? Hdf5Kind::kInt64 : Hdf5Kind::kUint64,
                     .shape = {ids.size()}},
                    std::as_bytes(std::span(ids)));
}

Hdf5DataSet strings_of(Hdf5Output& output, const LabelNames& names) {
  std::vector<std::string> strings;
  for (const LabelName& row : names.rows()) strings.push_back(row.name);
  return output.add_texts(kLabelName, strings);
}

Hdf5DataSet colours_of(Hdf5Output& output, const LabelNames& names) {
  std::vector<Colour> colours;
  for (const LabelName& row : names.rows()) colours.push_back(field_colour(row));
  return output.add({.name = kLabelColour, .shape = {colours.size(), 4}},
                    std::as_bytes(std::span(colours)));
}

Hdf5DataSet cohesive_labels_of(Hdf5Output& output, const MeshHeader& header) {
  const auto& interfaces = header.wedges.interfaces;
  return output.add({.name = kCohesiveLabels,
                     .kind = header.labels_signed ? Hdf5Kind::kInt64 : Hdf5Kind::kUint64,
                     .shape = {interfaces.size(), 2}},
                    std::as_bytes(std::span(interfaces)));
}

Hdf5DataSet bytes_in(Hdf5Output& output, const char* name, const std::string& bytes) {
  return output.add({.name = name, .shape = {bytes.size()}}, std::as_bytes(std::span(bytes)));
}

std::string bytes_of(const LabelNames& names) {
  std::string bytes;
  for (const LabelName& row : names.rows()) bytes.append(row.name).push_back('\0');
  return bytes;
}

/// Returns whether there is such a link.  ERRORS: kInput when that cannot be known.
bool has_link(hid_t index, const std::string& path, const std::string& file) {
  const htri_t found = H5Lexists(index, path.c_str(), H5P_DEFAULT);
  if (found < 0) {
    fail_input(file, path, "cannot be looked up: " + hdf5_reason(), "the file or disk is damaged");
  }
  return found > 0;
}

/// The place of an array, which may be missing, as may its group.
struct ArrayLayout {
  hid_t index = H5I_INVALID_HID;
  const char* group = nullptr;
  const char* array = nullptr;
};

bool has_array(const ArrayLayout& at, const std::string& file) {
  return has_link(at.index, at.group, file) &&
         has_link(at.index, text(at.group, "/", at.array), file);
}

std::vector<std::uint64_t> read_numbers(const Hdf5Array& array, std::uint64_t components) {
  const bool fits = array.is_integer() && array.components() == components;
  if (!fits || array.rows() > kMaxNumbers / components) array.fail("holds no table of names");
  std::vector<std::uint64_t> numbers(array.rows() * components);
  read_labels(array, 0, numbers);
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

void add_vtkhdf_facts(Hdf5Output& output, const MeshHeader& header, Hdf5Group& file,
                      Hdf5Group& grid) {
  const LabelNames& names = header.names;
  const std::string record = record_text(header.record);
  if (names.empty() && record.empty()) return;
  Hdf5Group ours{.name = kOurs};
  if (!record.empty()) ours.sets.push_back(bytes_in(output, kRecord, record));
  Hdf5Group fields{.name = kFields};
  if (!names.empty()) {
    fields.sets = {ids_of(output, header), strings_of(output, names), colours_of(output, names)};
    ours.sets.push_back(bytes_in(output, kLabelName, bytes_of(names)));
  }
  if (header.wedges.count > 0) fields.sets.push_back(cohesive_labels_of(output, header));
  if (!fields.sets.empty()) grid.groups.push_back(std::move(fields));
  file.groups.push_back(std::move(ours));
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
