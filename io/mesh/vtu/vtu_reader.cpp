// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads a tetrahedral .vtu file.
#include "io/mesh/vtu/vtu.h"

#include <algorithm>
#include <cmath>

#include "io/file/errors.h"
#include "io/mesh/element.h"
#include "io/mesh/field_names.h"
#include "io/mesh/kept_rows.h"
#include "io/vtk_xml/vtk_document.h"

namespace mw::io {
namespace {

/// Keeps products of counts and sizes within 64 bits.
constexpr std::uint64_t kMaxRows = std::uint64_t{1} << 56;

std::uint64_t count_of(pugi::xml_node piece, const char* attribute, const VtkDocument& document) {
  const std::uint64_t count = document.number(piece, attribute);
  if (count >= kMaxRows) {
    fail_input(document.file(), attribute, text(count, " is not credible"), "the file is damaged");
  }
  return count;
}

pugi::xml_node named_array(pugi::xml_node parent, const char* name, const VtkDocument& document) {
  const pugi::xml_node array = parent.find_child_by_attribute("DataArray", "Name", name);
  if (!array) fail_input(document.file(), text("array '", name, "'"), "missing");
  return array;
}

bool is_integer_scalar(pugi::xml_node array, const VtkDocument& document) {
  const auto type = parse_number_type(array.attribute("type").as_string());
  return type && !type->is_float && document.number(array, "NumberOfComponents", 1) == 1;
}

pugi::xml_node label_array(pugi::xml_node cell_data, const VtkDocument& document) {
  std::vector<std::string> integers;
  for (const pugi::xml_node array : cell_data.children("DataArray")) {
    if (is_integer_scalar(array, document))
      integers.emplace_back(array.attribute("Name").as_string());
  }
  const std::string* name = choose_label(integers);
  if (name == nullptr) {
    fail_input(document.file(), "cell data",
               text("none of ", integers.size(), " integer arrays is called 'label'"),
               "store the labels as an integer cell array 'label'");
  }
  return named_array(cell_data, name->c_str(), document);
}

void read_points(pugi::xml_node piece, VtkDocument& document, MeshData& mesh) {
  const std::uint64_t count = count_of(piece, "NumberOfPoints", document);
  const pugi::xml_node array = piece.child("Points").child("DataArray");
  if (!array && count == 0) return;
  if (!array || document.number(array, "NumberOfComponents", 3) != 3) {
    fail_input(document.file(), "Points", "missing or not of 3 components");
  }
  const std::vector<double> x = document.reals(array, count * 3);
  mesh.vertices.reserve(mesh.vertices.size() + count);
  for (std::size_t i = 0; i < count; ++i) {
    mesh.vertices.push_back({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
    for (const double c : mesh.vertices.back()) {
      if (!std::isfinite(c)) fail_input(document.file(), text("point ", i), "is not finite");
    }
  }
}

/// The cells of a piece.  Each tet becomes `parts` tets of the mesh.
struct VtuCells {
  std::vector<std::uint64_t> types;
  std::vector<std::uint64_t> ends;  ///< where the nodes of each cell end
  std::size_t parts = 1;

  /// Calls visit(cell) for each tet, as often as it has parts.
  template <class Visit>
  void each_part(Visit visit) const {
    for (std::size_t cell = 0; cell < types.size(); ++cell) {
      if (is_vtk_wedge(types[cell])) continue;
      for (std::size_t part = 0; part < parts; ++part) visit(cell);
    }
  }
};

/// Reads the types and offsets of cells; wedges are allowed only where the record tells of them.
VtuCells read_kinds(pugi::xml_node cells, std::uint64_t count, VtkDocument& document,
                    const MeshRecord& record) {
  VtuCells out{.types = document.integers(named_array(cells, "types", document), count),
               .ends = document.integers(named_array(cells, "offsets", document), count),
               .parts = record.curved ? kTetParts.size() : 1};
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t nodes = vtk_nodes_of(out.types[i], record.cohesive.any());
    if (nodes == 0) {
      fail_input(document.file(), text("cell ", i),
                 text("type ", out.types[i], " is no tetrahedron (10 or 24)"),
                 "keep only the tetrahedra");
    }
    if (record.curved && out.types[i] != kVtkQuadraticTetra) {
      fail_input(document.file(), text("cell ", i), "the curved mesh has a tet without ten nodes");
    }
    last += nodes;
    if (out.ends[i] == last) continue;
    fail_input(document.file(), text("offset of cell ", i), text(out.ends[i], " is not ", last));
  }
  return out;
}

/// Adds the corners of tets and marks the nodes that are middles; of curved tets it adds the parts.
void read_corners(pugi::xml_node cells, const VtuCells& kinds, VtkDocument& document,
                  MeshData& mesh, KeptRows& middles) {
  const std::vector<std::uint64_t>& ends = kinds.ends;
  const pugi::xml_node array = named_array(cells, "connectivity", document);
  const auto nodes = document.integers(array, ends.back());
  const std::uint64_t rows = count_of(cells.parent(), "NumberOfPoints", document);
  const std::uint64_t first_row = mesh.vertices.size() - rows;
  std::size_t at = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (is_vtk_wedge(kinds.types[i])) {
      at = ends[i];
      continue;
    }
    std::array<std::uint64_t, 10> rows_of_tet{};
    for (std::size_t n = 0; at < ends[i]; ++n, ++at) {
      if (nodes[at] >= rows) {
        fail_input(document.file(), text("cell ", i),
                   text("names point ", nodes[at], ", there are ", rows));
      }
      rows_of_tet[n] = first_row + nodes[at];
      if (n >= 4 && !mesh.record.curved) middles.middle(rows_of_tet[n]);
    }
    if (mesh.record.curved) {
      add_parts(rows_of_tet, mesh.tets);
    } else {
      mesh.tets.push_back({rows_of_tet[0], rows_of_tet[1], rows_of_tet[2], rows_of_tet[3]});
    }
  }
}

/// Reads values, which are floats of one component.  Pieces without an array have NaN in its place.
/// `before` is the number of tets in the pieces before.
void read_values(pugi::xml_node cell_data, const VtuCells& kinds, std::size_t before,
                 VtkDocument& document, MeshData& mesh) {
  for (const pugi::xml_node array : cell_data.children("DataArray")) {
    const auto type = parse_number_type(array.attribute("type").as_string());
    if (!type || !type->is_float || document.number(array, "NumberOfComponents", 1) != 1) continue;
    const std::string name = array.attribute("Name").as_string();
    auto column = std::find_if(mesh.values.begin(), mesh.values.end(),
                               [&](const TetValues& values) { return values.name == name; });
    if (column == mesh.values.end()) {
      if (mesh.values.size() == kMostValues) continue;
      column = mesh.values.insert(column, {name, {}});
    }
    if (column->numbers.size() > before) continue;  // the name was there before in this piece
    column->numbers.resize(before, std::nan(""));
    const std::vector<double> numbers = document.reals(array, kinds.types.size());
    kinds.each_part([&](std::size_t cell) { column->numbers.push_back(numbers[cell]); });
  }
  for (TetValues& column : mesh.values) column.numbers.resize(mesh.tets.size(), std::nan(""));
}

void read_cells(pugi::xml_node piece, VtkDocument& document, MeshData& mesh, KeptRows& middles) {
  const std::uint64_t count = count_of(piece, "NumberOfCells", document);
  if (count == 0) return;
  middles.grow(mesh.vertices.size());
  const std::size_t tets_before = mesh.tets.size();
  const VtuCells kinds = read_kinds(piece.child("Cells"), count, document, mesh.record);
  read_corners(piece.child("Cells"), kinds, document, mesh, middles);
  const pugi::xml_node array = label_array(piece.child("CellData"), document);
  const auto labels = document.integers(array, count);
  kinds.each_part([&](std::size_t cell) { mesh.labels.push_back(labels[cell]); });
  const auto type = parse_number_type(array.attribute("type").as_string());
  mesh.labels_signed = mesh.labels_signed || type->is_signed;
  read_values(piece.child("CellData"), kinds, tets_before, document, mesh);
}

/// Reads the pieces one after the other, and marks in `middles` the vertices that are middles.
void read_grid(VtkDocument& document, MeshData& mesh, KeptRows& middles) {
  bool found = false;
  for (const pugi::xml_node piece : document.grid().children("Piece")) {
    read_points(piece, document, mesh);
    read_cells(piece, document, mesh, middles);
    found = true;
  }
  if (!found) fail_input(document.file(), "Piece", "missing: the file holds no mesh");
  name_values(mesh.values);
}

std::vector<std::uint64_t> read_ids(VtkDocument& document) {
  std::vector<std::uint64_t> out;
  for (const pugi::xml_node piece : document.grid().children("Piece")) {
    const std::uint64_t count = count_of(piece, "NumberOfPoints", document);
    if (count == 0) continue;
    const pugi::xml_node array = named_array(piece.child("PointData"), kNodeIds, document);
    const std::vector<std::uint64_t> ids = document.integers(array, count);
    out.insert(out.end(), ids.begin(), ids.end());
  }
  return out;
}

constexpr VtkKind kVtu{"UnstructuredGrid", "give a .vtu file of tetrahedra"};

}  // namespace

MeshData read_vtu(const ByteSource& source) {
  VtkDocument document(source, kVtu);
  MeshData mesh;
  KeptRows middles;
  mesh.record = read_vtu_record(document);
  read_grid(document, mesh, middles);
  drop_middles(mesh, middles);
  mesh.ten_nodes = middles.any();
  mesh.in_parts = mesh.record.curved;
  mesh.record.curved = false;
  mesh.names = read_vtu_names(document);
  return mesh;
}

VtuPiece read_vtu_piece(const ByteSource& source) {
  VtkDocument document(source, kVtu);
  VtuPiece out;
  KeptRows middles;
  read_grid(document, out.mesh, middles);
  if (middles.any()) {
    fail_input(document.file(), "cells", "tets of ten nodes in a mesh of several pieces",
               "write its pieces with tets of four");
  }
  out.ids = read_ids(document);
  out.mesh.names = read_vtu_names(document);
  out.mesh.record.masks = read_vtu_record(document).masks;  // the rest is not about a piece
  return out;
}

}  // namespace mw::io
