// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/pieces/pvtu.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/file/errors.h"
#include "io/file/source/file_source.h"
#include "io/file/source/inflated_source.h"
#include "io/mesh/field_names.h"
#include "io/mesh/vtu/vtu.h"
#include "io/vtk_xml/vtk_document.h"

namespace mw::io {
namespace {

/// Appends the values of a piece, to be called before its tets are appended.
void append_values(const MeshData& piece, MeshData& mesh) {
  for (const TetValues& column : piece.values) {
    const auto has_name = [&](const TetValues& other) { return other.name == column.name; };
    auto to = std::find_if(mesh.values.begin(), mesh.values.end(), has_name);
    if (to == mesh.values.end()) {
      if (mesh.values.size() == kMostValues) continue;
      to = mesh.values.insert(to, {column.name, {}});
    }
    to->numbers.resize(mesh.tets.size(), std::nan(""));
    to->numbers.insert(to->numbers.end(), column.numbers.begin(), column.numbers.end());
  }
}

void append(const MeshData& piece, MeshData& mesh) {
  append_values(piece, mesh);
  const std::uint64_t first = mesh.vertices.size();
  mesh.vertices.insert(mesh.vertices.end(), piece.vertices.begin(), piece.vertices.end());
  for (TetRows tet : piece.tets) {
    for (std::uint64_t& row : tet) row += first;
    mesh.tets.push_back(tet);
  }
  mesh.labels.insert(mesh.labels.end(), piece.labels.begin(), piece.labels.end());
  mesh.labels_signed = mesh.labels_signed || piece.labels_signed;
}

/// Returns the rows of vertices, by ascending id.
std::vector<std::uint64_t> rows_by_id(const std::vector<std::uint64_t>& ids) {
  std::vector<std::uint64_t> rows(ids.size());
  std::iota(rows.begin(), rows.end(), std::uint64_t{0});
  std::sort(rows.begin(), rows.end(), [&ids](std::uint64_t a, std::uint64_t b) {
    return ids[a] != ids[b] ? ids[a] < ids[b] : a < b;
  });
  return rows;
}

/// Makes one vertex of all vertices with one id.
void join_vertices(MeshData& mesh, const std::vector<std::uint64_t>& ids, const std::string& file) {
  std::vector<Position> joined;
  std::vector<std::uint64_t> new_row(ids.size());
  const std::vector<std::uint64_t> rows = rows_by_id(ids);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Position& at = mesh.vertices[rows[i]];
    if (i == 0 || ids[rows[i]] != ids[rows[i - 1]]) joined.push_back(at);
    if (joined.back() != at) {
      fail_input(file, text(kNodeIds, " ", ids[rows[i]]), "is at two places",
                 "the pieces are not of one mesh");
    }
    new_row[rows[i]] = joined.size() - 1;
  }
  for (TetRows& tet : mesh.tets) {
    for (std::uint64_t& row : tet) row = new_row[row];
  }
  mesh.vertices = std::move(joined);
}

}  // namespace

std::vector<std::filesystem::path> piece_files(const std::filesystem::path& path) {
  const auto source = open_bytes(path);
  const VtkDocument document(*source,
                             {"PUnstructuredGrid", "give a .pvtu whose pieces are .vtu files"});
  const pugi::xml_node grid = document.grid();
  if (document.number(grid, "GhostLevel", 0) != 0) {
    fail_input(document.file(), "GhostLevel", "pieces overlap", "write them without ghost cells");
  }
  std::vector<std::filesystem::path> out;
  for (const pugi::xml_node piece : grid.children("Piece")) {
    out.push_back(named_beside(path, "Source", piece.attribute("Source").as_string()));
  }
  if (out.empty()) fail_input(document.file(), "Piece", "missing: the file names no mesh");
  return out;
}

MeshData read_pvtu(const std::filesystem::path& path) {
  const std::vector<std::filesystem::path> files = piece_files(path);
  if (files.size() == 1) return read_vtu(*open_bytes(files[0]));
  MeshData mesh;
  std::vector<std::uint64_t> ids;
  for (const std::filesystem::path& file : files) {
    const VtuPiece piece = read_vtu_piece(*open_bytes(file));
    append(piece.mesh, mesh);
    ids.insert(ids.end(), piece.ids.begin(), piece.ids.end());
    mesh.names = mesh.names.merged_with(piece.mesh.names);
    mesh.record.masks = piece.mesh.record.masks;  // all pieces tell the same
  }
  for (TetValues& column : mesh.values) column.numbers.resize(mesh.tets.size(), std::nan(""));
  join_vertices(mesh, ids, path.string());
  return mesh;
}

}  // namespace mw::io
