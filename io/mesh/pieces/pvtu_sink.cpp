// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>

#include "io/file/byte_order.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/mesh/grouped/group_names.h"
#include "io/mesh/mesh_sink.h"
#include "io/mesh/pieces/pvtu.h"
#include "io/mesh/vtu/vtu.h"
#include "kernels/core/sort_distinct.h"

namespace mw::io {
namespace {

std::string piece_name(const std::string& stem, std::uint64_t number) {
  char digits[24];
  std::snprintf(digits, sizeof digits, "_%04llu", static_cast<unsigned long long>(number));
  return stem + digits + ".vtu";
}

std::string index_text(const std::string& stem, std::uint64_t pieces, const MeshHeader& header) {
  std::string values;
  for (const std::string& name : header.values) {
    values += text("      <PDataArray type=\"Float64\" Name=\"", name, "\"/>\n");
  }
  for (const std::string& name : mask_arrays(header)) {
    values += text("      <PDataArray type=\"UInt8\" Name=\"", xml_escaped(name), "\"/>\n");
  }
  std::string out = text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <PUnstructuredGrid "
      "GhostLevel=\"0\">\n    <PPointData GlobalIds=\"",
      kNodeIds,
      "\">\n      <PDataArray "
      "type=\"Int64\" Name=\"",
      kNodeIds,
      "\"/>\n    </PPointData>\n    <PCellData "
      "Scalars=\"label\">\n      <PDataArray type=\"",
      header.labels_signed ? "Int64" : "UInt64", "\" Name=\"label\"/>\n", values,
      "    </PCellData>\n    <PPoints>\n      <PDataArray type=\"Float64\" "
      "Name=\"Points\" NumberOfComponents=\"3\"/>\n    </PPoints>\n");
  for (std::uint64_t i = 0; i < pieces; ++i) {
    out += text("    <Piece Source=\"", xml_escaped(stem + "/" + piece_name(stem, i)), "\"/>\n");
  }
  return out + "  </PUnstructuredGrid>\n</VTKFile>\n";
}

/// Returns the rows of the vertices of these tets, ascending.
std::vector<std::uint64_t> rows_of(const MeshData& mesh, std::span<const std::uint64_t> tets) {
  std::vector<std::uint64_t> rows;
  rows.reserve(4 * tets.size());
  for (const std::uint64_t t : tets) {
    rows.insert(rows.end(), mesh.tets[t].begin(), mesh.tets[t].end());
  }
  sort_distinct(rows);
  rows.shrink_to_fit();
  return rows;
}

}  // namespace

PvtuSink::PvtuSink(const std::filesystem::path& path, std::uint64_t pieces)
    : name_(path.string()),
      pieces_(pieces),
      index_(path),
      folder_(std::filesystem::path(path).replace_extension()),
      stem_(path.stem().string()) {}

void PvtuSink::begin(const MeshHeader& header) {
  if (pieces_ > header.tets) {
    fail_usage(name_, ": ", pieces_, " pieces of ", header.tets, " tets; ask for fewer");
  }
  header_ = header;
  MeshDataSink::begin(header);
}

void PvtuSink::write_piece(std::uint64_t number, std::span<const std::uint64_t> tets) {
  const MeshData& whole = mesh();
  const std::vector<std::uint64_t> rows = rows_of(whole, tets);
  MeshHeader header = header_;
  header.tets = tets.size();
  header.names = whole.names;
  header.record = {.masks = header_.record.masks};
  const VtuLayout layout = make_vtu_layout(header, rows.size(), Element::kTet4, VtuIds::kOfNodes);
  AtomicFile file(folder_.path() / piece_name(stem_, number));
  const auto begin = [&](VtuLayout::Array array) { append_little(file, layout.length[array]); };
  file.append(layout.head);
  for (const TetValues& column : whole.values) {
    append_little(file, layout.value_length);
    for (const std::uint64_t t : tets) append_little(file, column.numbers[t]);
  }
  for (const MaskLabels& mask : header.record.masks) {
    append_little(file, layout.mask_length);
    for (const std::uint64_t t : tets) {
      const bool is_in = mask.has(whole.labels[t]);
      append_little(file, static_cast<std::uint8_t>(is_in ? 1 : 0));
    }
  }
  begin(VtuLayout::kConnectivity);
  for (const std::uint64_t t : tets) {
    for (const std::uint64_t v : whole.tets[t]) {
      const auto at = std::lower_bound(rows.begin(), rows.end(), v);
      append_little(file, static_cast<std::uint64_t>(at - rows.begin()));
    }
  }
  begin(VtuLayout::kOffsets);
  for (std::uint64_t i = 1; i <= tets.size(); ++i) append_little(file, 4 * i);
  begin(VtuLayout::kTypes);
  for (std::size_t i = 0; i < tets.size(); ++i) append_little(file, vtk_type(Element::kTet4));
  begin(VtuLayout::kLabel);
  for (const std::uint64_t t : tets) append_little(file, whole.labels[t]);
  begin(VtuLayout::kPoints);
  for (const std::uint64_t v : rows) {
    for (const double x : whole.vertices[v]) append_little(file, x);
  }
  begin(VtuLayout::kIds);
  for (const std::uint64_t v : rows) append_little(file, v);
  file.append(layout.tail);
  file.commit();
}

void PvtuSink::finish() {
  check_sink_counts(name_, header_, mesh().tets.size());
  const auto parts = mesh_parts(mesh(), pieces_);
  for (std::uint64_t i = 0; i < parts.size(); ++i) write_piece(i, parts[i]);
  index_.append(index_text(stem_, pieces_, header_));
  index_.sync();
  folder_.commit();
  try {
    index_.give_name();
  } catch (...) {
    folder_.withdraw();
    throw;
  }
}

}  // namespace mw::io
