// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Makes curved tets of their straight parts again.
#pragma once

#include <array>
#include <cstdint>

#include "io/file/scratch/scratch_file.h"
#include "io/mesh/kept_rows.h"
#include "io/mesh/scratch_mesh.h"

namespace mw::io {

/// The places of the middles of kTetEdges.
using SixPlaces = std::array<Position, 6>;

/// Makes tets of ten nodes of a mesh of parts (MeshHeader::in_parts).
/// Memory: 8 MiB, and a quarter of a byte for each vertex.  Disk: 80 bytes a tet of ten nodes.
/// ERRORS: see ScratchFile.
class CurvedParts {
 public:
  /// REQUIRES: the parts of each tet are there; the mesh outlives the object.
  explicit CurvedParts(ScratchMesh& parts);

  /// Returns the mesh of the tets' corners.
  /// ERRORS: kInput when a part names a vertex that is not there.
  [[nodiscard]] ScratchMesh corners();
  /// Returns the middles of a tet, each on the edge that it has when the tet's corners are
  /// positive. REQUIRES: corners() was called.
  [[nodiscard]] SixPlaces middles(std::uint64_t tet);

 private:
  [[nodiscard]] KeptRows corner_rows();

  ScratchMesh& parts_;
  PagedFile<std::array<std::uint64_t, 10>> tets_;
};

}  // namespace mw::io
