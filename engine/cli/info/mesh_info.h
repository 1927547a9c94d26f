// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What `mwmesh info` measures and prints about a mesh: labels one by one, pairs of labels that
// touch, and the volume that it was made from.
#pragma once

#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/cli/requests.h"
#include "engine/connect/connect_options.h"
#include "io/labels/label_table.h"
#include "io/mesh/grouped/group_names.h"
#include "io/mesh/grouped/grouped_mesh.h"
#include "io/names/label_names.h"
#include "kernels/audit/shape/shape.h"
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

/// What the volume has for the labels and contacts of the mesh.
struct VolumeSide {
  std::unordered_map<RawLabel, std::uint64_t> voxels;
  double voxel_volume = 1;  ///< cubic physical units
  std::string unit = {};    ///< of lengths; empty if unknown
  io::LabelNames names;
  /// Area of voxel faces of each contact, the smaller label first; in square physical units.
  std::map<std::pair<RawLabel, RawLabel>, double> areas;
};

/// Opens the volume, does its steps and reads it; for the areas it is read twice.
/// ERRORS: those of open() and of reading.
[[nodiscard]] VolumeSide look_at_volume(const VolumeRequest& request, bool with_areas);

/// All that `mwmesh info` prints about a mesh.
struct MeshInfo {
  std::string file;
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
  std::uint64_t curved = 0;   ///< curved tets of the file, each of which is eight of `tets`
  std::uint64_t doubled = 0;  ///< vertices, among them, that double earlier ones
  engine::ConnectFacts parts;
  io::LabelTable table;
  io::LabelNames names;
  MeshStats mesh;  ///< by rank of label
  std::optional<VolumeSide> volume;
  audit::ShapeReport shape;
  std::string digest;
  io::CohesiveRule cohesive{};  ///< which interfaces have wedges between their sides
};

/// Returns "kind", "file", "vertices", ... as a JSON object; `contacts` adds the contacts.
[[nodiscard]] io::Json mesh_json(const MeshInfo& facts, bool contacts);

}  // namespace mw::cli
