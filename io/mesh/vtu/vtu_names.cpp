// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels, and the record of the run, as field data of a .vtu file.
#include "io/mesh/vtu/vtu_names.h"

#include <algorithm>

#include "io/file/errors.h"

namespace mw::io {
namespace {

std::string open_tag(const char* element, const char* type, const char* name, int components,
                     std::size_t count) {
  return text("      <", element, " type=\"", type, "\" Name=\"", name, "\" NumberOfComponents=\"",
              components, "\" NumberOfTuples=\"", count, "\" format=\"ascii\">\n");
}

std::string id_text(RawLabel label, bool labels_signed) {
  return labels_signed ? text(static_cast<std::int64_t>(label)) : text(label);
}

/// The array of that name among the children of FieldData, if it is of that kind.
pugi::xml_node find_array(pugi::xml_node fields, const char* element, const char* name) {
  for (const pugi::xml_node array : fields.children(element)) {
    if (std::string_view(array.attribute("Name").as_string()) == name) return array;
  }
  return {};
}

std::uint64_t tuples_of(pugi::xml_node array, const VtkDocument& document) {
  return document.number(array, "NumberOfTuples");
}

bool is_integer(pugi::xml_node array) {
  const auto type = parse_number_type(array.attribute("type").as_string());
  return type && !type->is_float;
}

/// The three arrays.
std::string name_arrays(const LabelNames& names, bool labels_signed) {
  if (names.empty()) return {};
  const std::size_t count = names.rows().size();
  std::string ids, strings, colours;
  for (const LabelName& row : names.rows()) {
    ids += id_text(row.label, labels_signed) + " ";
    for (const char c : row.name) strings += text(static_cast<unsigned char>(c), " ");
    strings += "0\n";
    for (const std::uint8_t part : field_colour(row)) colours += text(part, " ");
    colours += "\n";
  }
  return text(open_tag("DataArray", labels_signed ? "Int64" : "UInt64", kLabelId, 1, count), ids,
              "\n      </DataArray>\n", open_tag("Array", "String", kLabelName, 1, count), strings,
              "      </Array>\n", open_tag("DataArray", "UInt8", kLabelColour, 4, count), colours,
              "      </DataArray>\n");
}

/// Bytes, no string: meshio reads no file with strings.
std::string record_array(const MeshRecord& record) {
  const std::string value = record_text(record);
  if (value.empty()) return {};
  std::string codes;
  for (const char c : value) codes += text(static_cast<unsigned char>(c), " ");
  return text(open_tag("DataArray", "UInt8", kRecordName, 1, value.size()), codes,
              "\n      </DataArray>\n");
}

}  // namespace

std::string vtu_fields(const MeshHeader& header) {
  const std::string arrays =
      name_arrays(header.names, header.labels_signed) + record_array(header.record);
  return arrays.empty() ? arrays : text("    <FieldData>\n", arrays, "    </FieldData>\n");
}

LabelNames read_vtu_names(VtkDocument& document) {
  const pugi::xml_node fields = document.grid().child("FieldData");
  const pugi::xml_node ids = find_array(fields, "DataArray", kLabelId);
  const pugi::xml_node names = find_array(fields, "Array", kLabelName);
  const pugi::xml_node colours = find_array(fields, "DataArray", kLabelColour);
  if (!ids || !names || !is_integer(ids)) return {};
  FieldNames read{.ids = document.integers(ids, tuples_of(ids, document)),
                  .names = document.strings(names),
                  .colours = {}};
  if (is_integer(colours) && document.number(colours, "NumberOfComponents", 1) == 4) {
    read.colours = document.integers(colours, 4 * tuples_of(colours, document));
  }
  return names_of(read, document.file());
}

MeshRecord read_vtu_record(VtkDocument& document) {
  const pugi::xml_node array =
      find_array(document.grid().child("FieldData"), "DataArray", kRecordName);
  if (!is_integer(array)) return {};
  const std::vector<std::uint64_t> codes = document.integers(array, tuples_of(array, document));
  std::string value(codes.size(), '\0');
  std::transform(codes.begin(), codes.end(), value.begin(),
                 [](std::uint64_t code) { return static_cast<char>(code); });
  return parse_record(value, document.file());
}

}  // namespace mw::io
