// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What an audit looks at: a volume, a finished mesh of any tool, and where the box lies.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "kernels/core/index.h"
#include "kernels/core/label.h"
#include "kernels/core/vector3.h"

namespace mw::audit {

/// A vertex in physical units, x first.
using Position = Vector3;

/// The four vertices of a tet, as rows of the vertex table.
using TetRow = std::array<std::uint64_t, 4>;

/// Dense label of a tet whose raw label does not occur in the volume.
inline constexpr Label kUnknown = 0xfffffffeU;

/// Dense label of the space without tets where labels were left out.
inline constexpr Label kLeftOut = 0xfffffffdU;

/// What people call a dense label of the volume.
using LabelText = std::function<std::string(Label)>;
/// What the details of checks call a label; without names it is "dense 3".
[[nodiscard]] std::string label_text(Label label, const LabelText& names);

/// Which labels of the volume a mesh is to hold, by dense label; empty for all.
using KeptLabels = std::vector<bool>;

[[nodiscard]] inline bool keeps(const KeptLabels& kept, Label label) {
  return kept.empty() || (label < kept.size() && kept[label]);
}

/// Returns whether parts of the label were left out.
[[nodiscard]] inline bool is_partial(const KeptLabels& partial, Label label) {
  return label < partial.size() && partial[label];
}

/// The input.  labels holds shape.product() dense labels, x fastest.
struct VoxelLabels {
  Index3 shape;
  std::span<const Label> labels;
};

/// A mesh in memory.  tets and labels are parallel; labels are dense in the volume's table, and
/// every value that is no label of the volume counts as kUnknown.
struct AuditMesh {
  std::span<const Position> vertices;
  std::span<const TetRow> tets;
  std::span<const Label> labels;
};

/// A part of a mesh, as large as one step of an audit can hold: every tet with a vertex that the
/// tile owns.  Each vertex of the whole mesh is owned by one tile, where its star is complete.
/// What is counted once (an edge, a triangle, a tet) is counted where its first vertex is owned.
struct MeshTile {
  AuditMesh mesh;                             ///< rows of its own, in the order of the whole
  std::span<const std::uint64_t> vertex_ids;  ///< by row, ascending; empty if they are the rows
  std::span<const std::uint64_t> tet_ids;     ///< by row, ascending; empty if they are the rows
  std::span<const std::uint8_t> owned;        ///< by row of vertex; empty if all are owned

  [[nodiscard]] bool owns(std::uint64_t vertex) const {
    return owned.empty() || owned[vertex] != 0;
  }
  /// REQUIRES: rows in range.
  [[nodiscard]] bool owns_tet(std::size_t tet) const {
    return owned.empty() || owns(*std::min_element(mesh.tets[tet].begin(), mesh.tets[tet].end()));
  }
  /// Returns whether other tiles have the tet too, as they own a vertex of it.
  [[nodiscard]] bool is_shared(std::size_t tet) const {
    const TetRow& t = mesh.tets[tet];
    return !std::all_of(t.begin(), t.end(), [this](std::uint64_t v) { return owns(v); });
  }
  [[nodiscard]] std::uint64_t vertex_id(std::uint64_t vertex) const {
    return vertex_ids.empty() ? vertex : vertex_ids[vertex];
  }
  [[nodiscard]] std::uint64_t tet_id(std::size_t tet) const {
    return tet_ids.empty() ? tet : tet_ids[tet];
  }
};

/// A box of a volume's voxels, and the lattice vertices that are counted with it.  Each vertex is
/// owned by one tile, which has all voxels around it, except those outside of the volume.
struct VoxelTile {
  VoxelLabels voxels;  ///< the voxels of `loaded`
  Index3 shape;        ///< shape of the whole volume
  Box3 loaded;
  Box3 owned;  ///< a box of vertices, from 0 to shape
};

/// All of a volume.
[[nodiscard]] inline VoxelTile whole(const VoxelLabels& volume) {
  const Index3 s = volume.shape;
  return {volume, s, {{0, 0, 0}, s}, {{0, 0, 0}, s + Index3{1, 1, 1}}};
}

/// Where the volume lies, in physical units: the box is [origin, origin + shape * spacing].
struct Frame {
  std::array<double, 3> spacing{1, 1, 1};
  std::array<double, 3> origin{0, 0, 0};

  /// Returns a point as multiples of a voxel's edges, from the first corner.
  [[nodiscard]] Position in_voxels(const Position& p) const {
    return {(p[0] - origin[0]) / spacing[0], (p[1] - origin[1]) / spacing[1],
            (p[2] - origin[2]) / spacing[2]};
  }
};

}  // namespace mw::audit
