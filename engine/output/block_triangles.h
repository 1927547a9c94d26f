// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a block alone tells of its triangles and their edges.
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
  Label label = 0;          ///< of the tet
  bool points_out = false;  ///< whether (b - a) x (c - a) points out of the tet
};

/// What a triangle tells of one of its edges: that it waits for its second tet or no longer does,
/// or that it is between two labels.
struct EdgeNews {
  std::array<std::uint32_t, 2> rows{};  ///< ascending
  std::uint32_t apex = 0;               ///< the triangle's third corner
  LabelPair labels{};                   ///< of an interface triangle, as the next two
  std::int8_t opens = 0;                ///< 1, -1; 0: an interface triangle
  bool turned = false;                  ///< see audit::Wing
};

/// Appends what a triangle between two labels tells of its three edges.
/// points_out: whether (b - a) x (c - a) points out of the lower label.
void tell_interface(const TriangleRows& rows, LabelPair labels, bool points_out,
                    std::vector<EdgeNews>& news);

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
  /// What `interfaces` tell, ascending as comes_before() says; room is reserved for six more of
  /// each lone triangle.
  std::vector<EdgeNews> news;

  [[nodiscard]] std::size_t home(std::uint32_t row) const { return vertices[row].home; }
  /// By home and rows, then by what is told.
  [[nodiscard]] bool comes_before(const EdgeNews& a, const EdgeNews& b) const;
};

/// Where blocks are, and which triangles count.
struct TriangleScope {
  const VertexUses& homes;
  Index3 shape;  ///< of the lattice, in voxels
  const LabelSelection& selection;
};

/// block: with the labels that are not written, too.
/// Memory: 64 bytes a tet while it works.
[[nodiscard]] BlockTriangles triangles_of(const BlockMesh& block, const TriangleScope& scope);

}  // namespace mw::engine
