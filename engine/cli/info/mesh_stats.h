// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What `mwmesh info` measures: labels one by one, and pairs of labels that touch.
#pragma once

#include <optional>
#include <vector>

#include "io/mesh/grouped/grouped_mesh.h"
#include "io/mesh/grouped/mask_groups.h"
#include "kernels/audit/topology/betti.h"

namespace mw::cli {

/// What is measured of one label, in physical units.
struct LabelStats {
  std::uint64_t tets = 0;
  double volume = 0;
  double area = 0;         ///< of the label's whole surface
  double area_on_box = 0;  ///< the part of area on the box of the volume
  double radius_ratio_min = 0;
  double radius_ratio_mean = 0;
  io::Position lo{};
  io::Position hi{};
  io::Position centroid{};                  ///< of its volume
  std::optional<audit::RegionBetti> betti;  ///< empty if not counted
};

struct ContactStats {
  Label first = 0;  ///< by rank, first < second
  Label second = 0;
  std::uint64_t triangles = 0;
  double area = 0;
};

/// What is measured of all labels of a mask together.
struct MaskStats {
  io::MaskGroup mask;
  std::uint64_t tets = 0;
  double volume = 0;
  std::optional<audit::RegionBetti> betti{};  ///< of their union; empty if not counted
};

struct MeshStats {
  std::vector<LabelStats> labels;      ///< by rank in the mesh's table
  std::vector<ContactStats> contacts;  ///< ascending
  std::vector<MaskStats> masks;        ///< those of mask_groups()
};

/// Measures the mesh; sums are compensated and in the order of tets and facets.  Betti numbers are
/// those of the closed and open regions that `verify` compares.  Memory: 200 bytes for each label
/// and contact; with count_betti also the mesh, 24 bytes a vertex and some 120 a tet.
/// ERRORS: see GroupedMesh; mw::Error(kInput) for coordinates that are not finite.
[[nodiscard]] MeshStats measure_mesh(io::GroupedMesh& mesh, bool count_betti);

}  // namespace mw::cli
