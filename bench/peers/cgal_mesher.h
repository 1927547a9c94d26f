// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// CGAL Mesh_3 of a labelled image: the Delaunay refinement that the paper compares with (Sec 6).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "io/mesh/mesh_data.h"
#include "io/volume/label_volume.h"

namespace mw::peers {

/// What Mesh_3 leaves unmeshed; subdomains count from 1.
inline constexpr std::uint16_t kOutside = 0;

/// Perturbation and exudation after the refinement: none; no longer than the refinement took, which
/// is CGAL's default and makes the mesh depend on the clock; or until nothing gets better.
enum class Improvement { kNone, kTimed, kFull };

/// Lengths are in voxels (the least spacing), angles in degrees.
struct CgalCriteria {
  double facet_angle = 25;
  double facet_size = 6;
  double facet_distance = 1;
  double cell_radius_edge_ratio = 3;
  double cell_size = 8;
  Improvement improvement = Improvement::kTimed;
};

/// Meshes the subdomains of an image with one thread and a fixed seed.  Deterministic,
/// except with Improvement::kTimed.
///
/// Voxels are samples at their centres, between which CGAL interpolates.  A layer of kOutside goes
/// around the volume, so that the boundary of the outermost voxels is the plane of the box; without
/// it CGAL would end half a voxel inside.
/// REQUIRES: subdomains.size() == info.shape.product(), x fastest.
/// ENSURES: labels of the mesh are subdomains; tets are VTK-positive; physical units.
[[nodiscard]] io::MeshData mesh_with_cgal(std::span<const std::uint16_t> subdomains,
                                          const io::VolumeInfo& info, const CgalCriteria& criteria);

}  // namespace mw::peers
