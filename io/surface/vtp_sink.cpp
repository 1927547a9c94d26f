// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes surfaces as .vtp files, the polygons of VTK and ParaView.
#include "io/surface/vtp_sink.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/mesh/field_names.h"

namespace mw::io {
namespace {

/// An array behind the head, in the order of the file.
struct VtpArray {
  const char* type;
  const char* name;
  int components;
  std::uint64_t bytes;  ///< of its numbers
};

struct VtpArrays {
  std::vector<VtpArray> points, polygons, cells;
};

using Rgb = std::array<std::uint8_t, 3>;

VtpArrays arrays_of(const SurfaceHeader& header) {
  const std::uint64_t triangles = header.triangles();
  const char* const type = header.labels->table.is_signed() ? "Int64" : "UInt64";
  VtpArrays out{.points = {{"Float64", "Points", 3, header.vertices() * sizeof(Position)}},
                .polygons = {{"Int64", "connectivity", 1, triangles * sizeof(Triangle)},
                             {"Int64", "offsets", 1, triangles * sizeof(std::int64_t)}},
                .cells = {{type, "label", 1, triangles * sizeof(RawLabel)},
                          {type, "label_out", 1, triangles * sizeof(RawLabel)},
                          {"UInt8", "side", 1, triangles}}};
  if (has_colours(header)) {
    out.cells.push_back({"UInt8", "colour", 3, triangles * sizeof(Rgb)});
  }
  return out;
}

/// Returns the tags of arrays that begin at `offset` behind the '_', and steps over them.
std::string tags_of(const std::vector<VtpArray>& arrays, std::uint64_t& offset) {
  std::string out;
  for (const VtpArray& array : arrays) {
    out += text("        <DataArray type=\"", array.type, "\" Name=\"", array.name,
                "\" NumberOfComponents=\"", array.components, "\" format=\"appended\" offset=\"",
                offset, "\"/>\n");
    offset += sizeof(std::uint64_t) + array.bytes;
  }
  return out;
}

std::string field_tag(const char* type, const char* name, int components, std::size_t tuples,
                      const std::string& numbers) {
  return text("      <DataArray type=\"", type, "\" Name=\"", name, "\" NumberOfComponents=\"",
              components, "\" NumberOfTuples=\"", tuples, "\" format=\"ascii\">", numbers,
              "</DataArray>\n");
}

/// Returns an array of strings, which are the codes of their bytes, each with a 0 behind it.
std::string string_field(const char* name, const std::vector<std::string>& strings) {
  std::string codes;
  for (const std::string& string : strings) {
    for (const char c : string) codes += text(static_cast<unsigned char>(c), " ");
    codes += "0 ";
  }
  return text("      <Array type=\"String\" Name=\"", name, "\" NumberOfTuples=\"", strings.size(),
              "\" format=\"ascii\">", codes, "</Array>\n");
}

std::string name_fields(const SurfaceHeader& header) {
  const LabelNames known = names_of(header);
  if (known.empty()) return {};
  const bool is_signed = header.labels->table.is_signed();
  std::string ids, colours;
  std::vector<std::string> names;
  for (const LabelName& row : known.rows()) {
    ids += label_text(row.label, is_signed) + " ";
    names.push_back(row.name);
    for (const std::uint8_t part : field_colour(row)) colours += text(part, " ");
  }
  return field_tag(is_signed ? "Int64" : "UInt64", kLabelId, 1, names.size(), ids) +
         string_field(kLabelName, names) +
         field_tag("UInt8", kLabelColour, 4, names.size(), colours);
}

std::string place_fields(const SurfaceHeader& header) {
  std::string out;
  if (header.frame != WorldFrame::kOwn) {
    out += string_field("SPACE", {header.frame == WorldFrame::kRas ? "RAS" : "LPS"});
  }
  const auto& [x, y, z] = header.shift;
  if (!shift_comment(header).empty()) {
    out += field_tag("Float64", "SHIFT", 3, 1, text(x, " ", y, " ", z));
  }
  return out;
}

std::string vtp_head(const SurfaceHeader& header) {
  const VtpArrays arrays = arrays_of(header);
  const std::string fields = name_fields(header) + place_fields(header);
  std::uint64_t offset = 0;
  std::string out = text(
      "<?xml version=\"1.0\"?>\n<!-- mwmesh -->\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <PolyData>\n",
      fields.empty() ? "" : text("    <FieldData>\n", fields, "    </FieldData>\n"),
      "    <Piece NumberOfPoints=\"", header.vertices(),
      "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"",
      header.triangles(), "\">\n");
  out += text("      <Points>\n", tags_of(arrays.points, offset), "      </Points>\n");
  out += text("      <Polys>\n", tags_of(arrays.polygons, offset), "      </Polys>\n");
  out += text("      <CellData Scalars=\"label\">\n", tags_of(arrays.cells, offset),
              "      </CellData>\n    </Piece>\n  </PolyData>\n");
  return out + "  <AppendedData encoding=\"raw\">\n_";
}

RawLabel inside_label(const SurfaceHeader& header, const SurfaceRun& run) {
  return header.labels->table.raw(run.inside);
}

RawLabel outside_label(const SurfaceHeader& header, const SurfaceRun& run) {
  return run.side == Side::kInterface ? header.labels->table.raw(run.outside) : 0;
}

std::uint8_t side_number(const SurfaceHeader& /*header*/, const SurfaceRun& run) {
  return static_cast<std::uint8_t>(run.side);
}

Rgb run_colour(const SurfaceHeader& header, const SurfaceRun& run) {
  const Colour colour = header.labels->colour(run.inside);
  return {colour[0], colour[1], colour[2]};
}

void append_number(AtomicFile& file, std::uint64_t number) {
  append_little(file, number);
}

void append_number(AtomicFile& file, std::uint8_t number) {
  append_little(file, number);
}

void append_number(AtomicFile& file, const Rgb& colour) {
  for (const std::uint8_t part : colour) append_little(file, part);
}

}  // namespace

void VtpSink::begin(const SurfaceHeader& header) {
  header_ = header;
  file_.append(vtp_head(header_));
  append_little(file_, header_.vertices() * sizeof(Position));
}

void VtpSink::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    for (const double x : position) append_little(file_, x);
  }
}

void VtpSink::begin_polygons() {
  if (!has_polygons_) append_little(file_, header_.triangles() * sizeof(Triangle));
  has_polygons_ = true;
}

void VtpSink::write_triangles(std::span<const Triangle> triangles) {
  begin_polygons();
  for (const Triangle& triangle : triangles) {
    for (const std::uint64_t vertex : triangle) append_little(file_, vertex);
  }
}

template <class Number>
void VtpSink::append_by_run(Number (*number)(const SurfaceHeader& header, const SurfaceRun& run)) {
  append_little(file_, header_.triangles() * sizeof(Number));
  for (const SurfaceShell& shell : header_.shells) {
    for (const SurfaceRun& run : shell.runs) {
      const Number same = number(header_, run);
      for (std::uint64_t t = 0; t < run.triangles; ++t) append_number(file_, same);
    }
  }
}

void VtpSink::finish() {
  begin_polygons();
  append_little(file_, header_.triangles() * sizeof(std::uint64_t));
  for (std::uint64_t t = 1; t <= header_.triangles(); ++t) append_little(file_, 3 * t);
  append_by_run(&inside_label);
  append_by_run(&outside_label);
  append_by_run(&side_number);
  if (has_colours(header_)) append_by_run(&run_colour);
  file_.append(std::string_view("\n  </AppendedData>\n</VTKFile>\n"));
  file_.commit();
}

}  // namespace mw::io
