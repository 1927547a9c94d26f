// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes a surface as a .vtp file.
#include "io/surface/vtp/vtp_sink.h"

#include "io/file/errors.h"
#include "io/mesh/vtu/vtu_names.h"
#include "io/surface/binary_numbers.h"

namespace mw::io {
namespace {

/// Tags of arrays whose numbers stand one behind the other, each with their length in front.
class ArrayTags {
 public:
  std::string next(const char* type, const char* name, int components, std::uint64_t bytes) {
    const std::uint64_t offset = offset_;
    offset_ += sizeof(std::uint64_t) + bytes;
    return text("        <DataArray type=\"", type, "\" Name=\"", name, "\" NumberOfComponents=\"",
                components, "\" format=\"appended\" offset=\"", offset, "\"/>\n");
  }

 private:
  std::uint64_t offset_ = 0;
};

std::string head_of(const SurfaceHeader& header) {
  const std::uint64_t vertices = header.vertices();
  const std::uint64_t triangles = header.triangles();
  const bool is_signed = header.labels->table.is_signed();
  const char* const label_type = is_signed ? "Int64" : "UInt64";
  ArrayTags tags;
  std::string out = text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <PolyData>\n",
      vtu_fields({.labels_signed = is_signed, .names = names_of(header)}),
      "    <Piece NumberOfPoints=\"", vertices,
      "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"", triangles,
      "\">\n      <Points>\n");
  out += tags.next("Float64", "Points", 3, vertices * 24);
  out += "      </Points>\n      <Polys>\n";
  out += tags.next("Int64", "connectivity", 1, triangles * 24);
  out += tags.next("Int64", "offsets", 1, triangles * 8);
  out += "      </Polys>\n      <CellData Scalars=\"label_in\">\n";
  out += tags.next(label_type, "label_in", 1, triangles * 8);
  out += tags.next(label_type, "label_out", 1, triangles * 8);
  out += tags.next("UInt8", "side", 1, triangles);
  return out +
         "      </CellData>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_";
}

}  // namespace

void VtpSink::begin(const SurfaceHeader& header) {
  header_ = header;
  file_.append(head_of(header));
  append_little(file_, header.vertices() * 24);
}

void VtpSink::write_vertices(std::span<const Position> positions) {
  for (const Position& position : positions) {
    for (const double x : position) append_little(file_, x);
  }
}

void VtpSink::write_triangles(std::span<const Triangle> triangles) {
  if (!triangles_begun_) append_little(file_, header_.triangles() * 24);
  triangles_begun_ = true;
  for (const Triangle& triangle : triangles) {
    for (const std::uint64_t vertex : triangle) append_little(file_, vertex);
  }
}

/// An array with a number of type T for each triangle, that of its run.
template <class T, class Value>
void VtpSink::append_of_runs(Value value) {
  append_little(file_, header_.triangles() * sizeof(T));
  for (const SurfaceShell& shell : header_.shells) {
    for (const SurfaceRun& run : shell.runs) {
      const auto number = static_cast<T>(value(run));
      for (std::uint64_t i = 0; i < run.triangles; ++i) append_little(file_, number);
    }
  }
}

void VtpSink::finish() {
  const std::uint64_t triangles = header_.triangles();
  append_little(file_, triangles * 8);
  for (std::uint64_t i = 1; i <= triangles; ++i) append_little(file_, 3 * i);
  const LabelTable& table = header_.labels->table;
  append_of_runs<std::uint64_t>([&](const SurfaceRun& run) { return table.raw(run.inside); });
  append_of_runs<std::uint64_t>([&](const SurfaceRun& run) {
    return run.side == Side::kInterface ? table.raw(run.outside) : 0;
  });
  append_of_runs<std::uint8_t>([](const SurfaceRun& run) { return run.side; });
  file_.append(std::string_view("\n  </AppendedData>\n</VTKFile>\n"));
  file_.commit();
}

}  // namespace mw::io
