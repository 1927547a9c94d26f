// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Area and bends of the interfaces of a mesh that comes block by block and is never held whole.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "engine/output/block_triangles.h"
#include "engine/output/label_selection.h"
#include "engine/output/remembered.h"
#include "engine/output/vertex_rows.h"
#include "io/volume/label_volume.h"
#include "kernels/audit/shape/shape.h"

namespace mw::engine {

// The two tets of a triangle may come with two blocks, and the triangles at an edge with several.
// A triangle that is not on the box has two tets; it is open until its second tet comes.  An edge
// waits as long as an open triangle is at it: the tets around an edge are a ring, or a fan between
// two triangles on the box, so while some of them are still to come, those that came end in a
// triangle that is open.  So only the front between the blocks that came and the others waits, and
// each part of it is forgotten when it is complete.

/// Measures the audit::ShapeReport of the triangles between two labels that are written.
/// Memory: 32 bytes for each open triangle, of which a front has about as many as a plane and a row
/// of blocks have on one side, and 56 for each of their edges, some 1.5 a triangle; both sorted by
/// the block in which their first vertex lies.
/// Cost: about 1 us a tet, 1 % of a run.  The figures are a function of the blocks.
class InterfaceShape {
 public:
  /// The selection outlives it.
  InterfaceShape(const WindowGrid& grid, io::VolumeInfo info, const LabelSelection& selection,
                 HoldMemory hold);

  /// Looks at a block alone.  Thread safety: may be called while add() runs.
  [[nodiscard]] BlockTriangles look_at(const BlockMesh& block) const {
    return triangles_of(block, {homes_, info_.shape, selection_});
  }
  /// REQUIRES: each block comes once, in a fixed order, with the labels that are not written, too.
  void add(BlockTriangles&& block);

  /// Returns the shape of the interfaces of the blocks so far.
  [[nodiscard]] audit::ShapeReport report() const { return meter_.report(); }
  /// Return how many bytes are remembered now, and the most so far.
  [[nodiscard]] std::uint64_t remembered() const {
    return list_bytes_ + kBytesPerFront * fronts_.size();
  }
  [[nodiscard]] std::uint64_t max_remembered() const { return max_remembered_; }

 private:
  /// A triangle that has shown one of its tets.
  struct OpenFace {
    std::array<VertexId, 3> ids{};  ///< ascending
    Label label = 0;                ///< label of that tet
  };
  /// An edge at which a triangle is open, and the interface triangles at it so far.
  struct OpenEdge {
    std::array<VertexId, 2> ids{};  ///< ascending
    LabelPair labels{};             ///< labels of the first triangle
    std::array<Point, 2> apexes{};  ///< apexes of the first two triangles
    std::array<bool, 2> turned{};   ///< see audit::Wing
    std::uint16_t open = 0;         ///< triangles that are open
    std::uint8_t triangles = 0;     ///< their number; kMany if the edge has no bend
  };
  static constexpr std::uint8_t kMany = 3;

  /// Open triangles and edges whose first vertex lies in one block.
  struct Front {
    std::vector<OpenFace> faces;  ///< ascending by ids
    std::vector<OpenEdge> edges;
  };
  /// A node of the map, and the allocator's slack for two lists.
  static constexpr std::uint64_t kBytesPerFront = 160;

  void settle_faces(std::size_t home, std::span<const LoneTriangle> faces);
  void settle_edges(std::size_t home, std::span<const EdgeNews> news);
  void meet(const LoneTriangle& face, Label other);
  void tell_open(const TriangleRows& face, std::int8_t opens);
  void sort_news(std::ptrdiff_t sorted);
  void take(OpenEdge& edge, const EdgeNews& news) const;
  void finish(const OpenEdge& edge, const std::array<std::uint32_t, 2>& rows);

  [[nodiscard]] VertexId id(std::uint32_t row) const { return block_->vertices[row].id; }
  [[nodiscard]] Point point(std::uint32_t row) const { return block_->vertices[row].position; }
  /// Returns the position along the axes of the array: turned and mirrored shapes measure the same.
  [[nodiscard]] io::Vector3 position(Point p) const;
  void hold_lone();

  io::VolumeInfo info_;
  const LabelSelection& selection_;
  HoldMemory hold_;
  VertexUses homes_;
  audit::ShapeMeter meter_;
  std::unordered_map<std::size_t, Front> fronts_;  ///< by raster number of the block
  std::uint64_t list_bytes_ = 0;
  std::uint64_t max_remembered_ = 0;

  // These belong to the block that is being added.
  const BlockTriangles* block_ = nullptr;
  std::vector<EdgeNews> news_;
};

}  // namespace mw::engine
