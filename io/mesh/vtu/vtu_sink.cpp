// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Lays out a .vtu file, and streams a mesh into it.
#include <algorithm>
#include <string_view>

#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/labels/label_table.h"
#include "io/mesh/grouped/group_names.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/vtu/vtu.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

std::string open_tag(const char* element, const char* type, const char* name, int components,
                     std::size_t count) {
  return text("      <", element, " type=\"", type, "\" Name=\"", name, "\" NumberOfComponents=\"",
              components, "\" NumberOfTuples=\"", count, "\" format=\"ascii\">\n");
}

/// Returns the child `element` of FieldData with that name, or an empty node.
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

/// Returns the three arrays of names, which are bytes because meshio reads no file with strings.
std::string name_arrays(const LabelNames& names, bool labels_signed) {
  if (names.empty()) return {};
  const std::size_t count = names.rows().size();
  std::string ids, characters, colours;
  std::size_t bytes = 0;
  for (const LabelName& row : names.rows()) {
    ids += label_text(row.label, labels_signed) + " ";
    for (const char c : row.name) characters += text(static_cast<unsigned char>(c), " ");
    characters += "0\n";
    bytes += row.name.size() + 1;
    for (const std::uint8_t part : field_colour(row)) colours += text(part, " ");
    colours += "\n";
  }
  return text(open_tag("DataArray", labels_signed ? "Int64" : "UInt64", kLabelId, 1, count), ids,
              "\n      </DataArray>\n", open_tag("DataArray", "UInt8", kLabelName, 1, bytes),
              characters, "      </DataArray>\n",
              open_tag("DataArray", "UInt8", kLabelColour, 4, count), colours,
              "      </DataArray>\n");
}

/// Returns the array of the record, whose text is bytes as names are.
std::string record_array(const MeshRecord& record) {
  const std::string value = record_text(record);
  if (value.empty()) return {};
  std::string codes;
  for (const char c : value) codes += text(static_cast<unsigned char>(c), " ");
  return text(open_tag("DataArray", "UInt8", kRecordName, 1, value.size()), codes,
              "\n      </DataArray>\n");
}

std::string cohesive_labels(const MeshHeader& header) {
  if (header.wedges.count == 0) return {};
  std::string labels;
  for (const auto& [bottom, top] : header.wedges.interfaces) {
    labels += label_text(bottom, header.labels_signed) + " " +
              label_text(top, header.labels_signed) + "\n";
  }
  return text(open_tag("DataArray", header.labels_signed ? "Int64" : "UInt64", kCohesiveLabels, 2,
                       header.wedges.interfaces.size()),
              labels, "      </DataArray>\n");
}

/// Longer than any head without its fields, values and ids.
constexpr std::size_t kHeadBytes = 1536;
constexpr std::string_view kAppended = "  <AppendedData encoding=\"raw\">\n_";

/// Returns a tag without a number of components of 1, which meshio would make a matrix of.
std::string array_tag(const char* type, const char* name, int components, std::uint64_t offset) {
  const std::string told = components == 1 ? "" : text(" NumberOfComponents=\"", components, "\"");
  return text("        <DataArray type=\"", type, "\" Name=\"", name, "\"", told,
              " format=\"appended\" offset=\"", offset, "\"/>\n");
}

std::string ids_element(std::uint64_t offset) {
  return text("      <PointData GlobalIds=\"", kNodeIds, "\">\n",
              array_tag("Int64", kNodeIds, 1, offset), "      </PointData>\n");
}

std::uint64_t cells_of(const MeshHeader& header) {
  return header.tets + header.wedges.count;
}

/// Returns the tags of the arrays of values, which come first, then those of cohesive cells and of
/// masks.
std::string value_tags(const MeshHeader& header) {
  std::string out;
  const std::uint64_t bytes = 8 + 8 * cells_of(header);
  for (std::size_t i = 0; i < header.values.size(); ++i) {
    out += array_tag("Float64", header.values[i].c_str(), 1, i * bytes);
  }
  std::uint64_t next = header.values.size() * bytes;
  if (header.wedges.count > 0) {
    out += array_tag("UInt64", kCohesive, 1, next);
    next += bytes;
  }
  for (const std::string& name : mask_arrays(header)) {
    out += array_tag("UInt8", xml_escaped(name).c_str(), 1, next);
    next += 8 + cells_of(header);
  }
  return out;
}

/// Returns the head.  The offset of each array counts from behind the '_'.
std::string make_head(const MeshHeader& header, std::uint64_t vertices, const std::string& fields,
                      const std::string& ids,
                      const std::array<std::uint64_t, VtuLayout::kArrays>& offset) {
  const std::string values = value_tags(header);
  std::string head = text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <UnstructuredGrid>\n",
      fields, "    <Piece NumberOfPoints=\"", vertices, "\" NumberOfCells=\"", cells_of(header),
      "\">\n", ids, "      <Points>\n",
      array_tag("Float64", "Points", 3, offset[VtuLayout::kPoints]),
      "      </Points>\n      <Cells>\n",
      array_tag("Int64", "connectivity", 1, offset[VtuLayout::kConnectivity]),
      array_tag("Int64", "offsets", 1, offset[VtuLayout::kOffsets]),
      array_tag("UInt8", "types", 1, offset[VtuLayout::kTypes]),
      "      </Cells>\n      <CellData Scalars=\"label\">\n",
      array_tag(header.labels_signed ? "Int64" : "UInt64", "label", 1, offset[VtuLayout::kLabel]),
      values, "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n");
  const std::size_t bytes = kHeadBytes + fields.size() + ids.size() + values.size();
  MW_ASSERT(head.size() + kAppended.size() <= bytes);
  head.resize(bytes - kAppended.size(), ' ');
  head.back() = '\n';
  return head.append(kAppended);
}

}  // namespace

std::string vtu_fields(const MeshHeader& header) {
  const std::string arrays = name_arrays(header.names, header.labels_signed) +
                             record_array(header.record) + cohesive_labels(header);
  return arrays.empty() ? arrays : text("    <FieldData>\n", arrays, "    </FieldData>\n");
}

LabelNames read_vtu_names(VtkDocument& document) {
  const pugi::xml_node fields = document.grid().child("FieldData");
  const pugi::xml_node ids = find_array(fields, "DataArray", kLabelId);
  pugi::xml_node names = find_array(fields, "DataArray", kLabelName);
  if (!names) names = find_array(fields, "Array", kLabelName);  // strings
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

VtuLayout make_vtu_layout(const MeshHeader& header, std::uint64_t vertices, Element element,
                          VtuIds with_ids) {
  const std::string fields = vtu_fields(header);
  VtuLayout layout;
  const std::uint64_t cells = cells_of(header);
  layout.length = {
      8 * (header.tets * node_count(element) + header.wedges.count * wedge_node_count(element)),
      cells * 8,
      cells,
      cells * 8,
      vertices * 24,
      vertices * 8};
  if (with_ids == VtuIds::kOfNodes) layout.arrays = VtuLayout::kArrays;
  std::array<std::uint64_t, VtuLayout::kArrays> offset{};
  layout.value_length = cells * 8;
  const std::size_t first_arrays = header.values.size() + (header.wedges.count > 0 ? 1 : 0);
  const std::uint64_t masks = first_arrays * (8 + layout.value_length);
  const std::size_t mask_count = header.record.masks.size();
  std::uint64_t next = masks + mask_count * (8 + cells);
  for (std::size_t i = 0; i < layout.arrays; ++i) {
    offset[i] = next;
    next += 8 + layout.length[i];
  }
  const std::string ids = with_ids == VtuIds::kNone ? "" : ids_element(offset[VtuLayout::kIds]);
  layout.head = make_head(header, vertices, fields, ids, offset);
  for (std::size_t i = 0; i < layout.arrays; ++i) layout.start[i] = layout.head.size() + offset[i];
  for (std::size_t i = 0; i < first_arrays; ++i) {
    layout.values.push_back(layout.head.size() + i * (8 + layout.value_length));
  }
  layout.mask_length = cells;
  for (std::size_t i = 0; i < mask_count; ++i) {
    layout.masks.push_back(layout.head.size() + masks + i * (8 + cells));
  }
  if (header.wedges.count > 0) {
    layout.cohesive = layout.values.back();
    layout.values.pop_back();
  }
  layout.tail = "\n  </AppendedData>\n</VTKFile>\n";
  layout.tail_start = layout.head.size() + next;
  return layout;
}

void VtuSink::begin(const MeshHeader& header) {
  // Where the numbers of an array start does not depend on how many vertices there will be.
  const VtuLayout layout = make_vtu_layout(header, 0, element());
  const auto numbers = [&](VtuLayout::Array array) {
    return layout.start[array] + sizeof(std::uint64_t);
  };
  std::vector<std::uint64_t> values = layout.values;
  for (std::uint64_t& start : values) start += sizeof(std::uint64_t);
  std::vector<std::uint64_t> masks = layout.masks;
  for (std::uint64_t& start : masks) start += sizeof(std::uint64_t);
  // The first offset, which this format does not have, goes where the count of bytes will be.
  place_columns(header, file_,
                {.connectivity = numbers(VtuLayout::kConnectivity),
                 .offsets = layout.start[VtuLayout::kOffsets],
                 .types = numbers(VtuLayout::kTypes),
                 .labels = numbers(VtuLayout::kLabel),
                 .points = numbers(VtuLayout::kPoints),
                 .values = std::move(values),
                 .cohesive = layout.cohesive.value_or(0) + sizeof(std::uint64_t),
                 .masks = std::move(masks)});
}

void VtuSink::finish() {
  const std::uint64_t vertices = finish_columns(name_).vertex;
  const VtuLayout layout = make_vtu_layout(header(), vertices, element());
  file_.write_at(0, std::as_bytes(std::span(layout.head)));
  const auto put_length = [&](std::uint64_t start, std::uint64_t bytes) {
    std::array<std::byte, sizeof(std::uint64_t)> length;
    store_little(bytes, length.data());
    file_.write_at(start, length);
  };
  for (std::size_t i = 0; i < layout.arrays; ++i) put_length(layout.start[i], layout.length[i]);
  for (const std::uint64_t start : layout.values) put_length(start, layout.value_length);
  for (const std::uint64_t start : layout.masks) put_length(start, layout.mask_length);
  if (layout.cohesive) put_length(*layout.cohesive, layout.value_length);
  file_.write_at(layout.tail_start, std::as_bytes(std::span(layout.tail)));
  file_.commit();
}

}  // namespace mw::io
