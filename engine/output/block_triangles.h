// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What is known of a block's triangles and their edges from the block alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/output/label_selection.h"
#include "engine/output/vertex_rows.h"
#include "kernels/core/label.h"
#include "kernels/core/lattice.h"
#include "kernels/mesh/block_mesh.h"

namespace mw::engine {

/// A triangle by rows of its block, ascending.
using TriangleRows = std::array<std::uint32_t, 3>;

/// A triangle that has one tet in its block and is not on the box.
struct LoneTriangle {
  TriangleRows rows{};
  Label label = 0;          ///< label of the tet
  bool points_out = false;  ///< true if (b - a) x (c - a) points out of the tet
};

/// What one of an edge's triangles says: that it begins to wait for its second tet, or ends to, or
/// that it is between two labels.
struct EdgeNews {
  std::array<std::uint32_t, 2> rows{};  ///< ascending
  std::uint32_t apex = 0;               ///< the triangle's third corner
  LabelPair labels{};                   ///< only of an interface triangle, as apex and turned
  std::int8_t opens = 0;                ///< 1: begins to wait, -1: ends to, 0: interface triangle
  bool turned = false;                  ///< see audit::Wing
};

/// Appends what a triangle between two labels says to its three edges.
/// points_out is true if (b - a) x (c - a) points out of the lower label.
void tell_interface(const TriangleRows& rows, LabelPair labels, bool points_out,
                    std::vector<EdgeNews>& news);

/// The triangles of a block that matter to the shape of interfaces.
/// Memory: 32 bytes a vertex, 188 a lone triangle, 96 an interface triangle.
struct BlockTriangles {
  struct Vertex {
    VertexId id = 0;
    Point position;
    std::size_t home = 0;  ///< the raster number of the block in whose box it lies
  };

  std::vector<Vertex> vertices;          ///< by row
  std::vector<LoneTriangle> lone;        ///< ascending by home of the first vertex, then by rows
  std::vector<TriangleRows> interfaces;  ///< between two tets of the block; ascending by rows
  /// What `interfaces` say, in the order of comes_before().  Room is reserved for six more entries
  /// for each lone triangle.
  std::vector<EdgeNews> news;

  [[nodiscard]] std::size_t home(std::uint32_t row) const { return vertices[row].home; }
  /// Orders by home and rows, then by opens and apex.
  [[nodiscard]] bool comes_before(const EdgeNews& a, const EdgeNews& b) const;
};

/// Where blocks are, and which triangles count.
struct TriangleScope {
  const VertexUses& homes;
  Index3 shape;  ///< shape of the lattice, in voxels
  const LabelSelection& selection;
};

/// Finds the triangles of a block, which must have the labels that are not written, too.
/// Memory: 64 bytes a tet while it works.
[[nodiscard]] BlockTriangles triangles_of(const BlockMesh& block, const TriangleScope& scope);

}  // namespace mw::engine
