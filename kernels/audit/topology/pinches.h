// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Where the boundaries of labels are no surfaces, of a volume and of a mesh, tile by tile (P1).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/audit/mesh_stars.h"
#include "kernels/audit/subject.h"

namespace mw::audit {

/// How many vertices and edges of a label are pinched: its boundary is no surface there.  An edge
/// is, if more than two faces of the boundary have it; a vertex, if these are not one closed fan.
struct Pinches {
  std::uint64_t vertices = 0;
  std::uint64_t edges = 0;

  void add(const Pinches& other);
  /// Returns what they become when each edge is halved, `times` times.
  [[nodiscard]] Pinches halved(int times) const;
  friend bool operator==(const Pinches&, const Pinches&) = default;
};

/// Corners and edges of voxels at which a label is pinched, edges by axis.
struct VoxelPinches {
  std::uint64_t corners = 0;
  std::array<std::uint64_t, 3> edges{};

  void add(const VoxelPinches& other);
  /// Those of the volume whose voxels are cut into layers along each axis.
  [[nodiscard]] Pinches in_layers(Index3 layers) const;
  friend bool operator==(const VoxelPinches&, const VoxelPinches&) = default;
};

/// Counts the pinches of each label of a tile: at the vertices that it owns, and on edges whose
/// smaller vertex it owns.  What is no label of the volume has none.
/// Cost: as parts_of_mesh, and a sort of the corners of boundary triangles, 16 bytes each.
[[nodiscard]] std::vector<Pinches> mesh_pinches(const MeshStars& stars, std::size_t label_count);

/// What a label has in the volume, in the lattice that vertices lie on, and in the mesh.
struct LabelPinches {
  Pinches voxels;
  Pinches mesh;
};

}  // namespace mw::audit
