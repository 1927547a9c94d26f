// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The canonical content of a block: what is stored between the visits of windows (Sec 4.2).
#pragma once

#include <array>
#include <vector>

#include "kernels/core/face_sample.h"
#include "kernels/core/label.h"
#include "kernels/core/lattice.h"
#include "kernels/quadric/quadric.h"

namespace mw {

/// A vertex as blocks hold it.  All copies of a vertex in different blocks are equal.
struct BlockVertex {
  VertexId id = 0;
  Point position;
  Quadric quadric;

  friend bool operator==(const BlockVertex&, const BlockVertex&) = default;
};

/// A tetrahedron by rows of the block's vertex list, ascending.  Orientation is not stored: it
/// follows from the positions, exactly.
struct BlockTet {
  std::array<std::uint32_t, 4> vertices{};
  Label label = 0;

  friend auto operator<=>(const BlockTet&, const BlockTet&) = default;
};

/// Samples of one face of the input's interface, carried by a triangle of the mesh's (distance
/// bound).  They are stored with the tet on that side of the triangle whose label is the smaller.
struct BlockSample {
  std::array<std::uint32_t, 3> triangle{};  ///< rows of the block's vertex list, ascending
  Label side = 0;                           ///< label of that tet
  FaceSamples samples = 0;

  friend auto operator<=>(const BlockSample&, const BlockSample&) = default;
};

/// Content of one block in canonical form: vertices ascend by id, tets and samples ascend, every
/// vertex is referenced, and a triangle names a face once.  Equal content is equal bytes, whichever
/// window wrote it.
struct BlockMesh {
  std::vector<BlockVertex> vertices;
  std::vector<BlockTet> tets;
  std::vector<BlockSample> samples;

  friend bool operator==(const BlockMesh&, const BlockMesh&) = default;
};

/// Merges blocks into one, canonically.
/// REQUIRES: canonical blocks; copies of a vertex are equal.
/// ENSURES: a function of the content alone, not of the order of the blocks.
/// Memory: the result, and once more its longest list.
[[nodiscard]] BlockMesh merge_blocks(std::vector<BlockMesh> blocks);

/// Brings a block's samples into canonical order and joins those of one face on one triangle.
/// vertices is the number of the block's vertices, which the samples' triangles are rows of.
void make_canonical(std::vector<BlockSample>& samples, std::size_t vertices);

}  // namespace mw
