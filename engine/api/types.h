// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Spaces, boxes, names and meshes of the library as io has them.
#pragma once

#include "engine/mwmesh.h"
#include "io/mesh/mesh_data.h"
#include "io/volume/volume_space.h"

namespace mw::api {

/// What errors call a volume that is no file.
inline constexpr const char* kArray = "array";

/// ERRORS: mw::Error(kUsage) for lengths and angles that make no sense.
[[nodiscard]] io::VolumeSpace io_space(const mwmesh::Space& space);
[[nodiscard]] mwmesh::Space library_space(const io::VolumeSpace& space);
[[nodiscard]] Box3 io_box(const mwmesh::Box& box);
[[nodiscard]] mwmesh::Box library_box(const Box3& box);
[[nodiscard]] io::LabelNames io_names(const std::vector<mwmesh::LabelName>& names);
[[nodiscard]] std::vector<mwmesh::LabelName> library_names(const io::LabelNames& names);

/// Returns the mesh, without a report.
[[nodiscard]] mwmesh::Mesh library_mesh(io::MeshData&& mesh);
/// Opens a file.  has_values tells whether it gets values of tets, has_wedges whether it is known
/// to get wedges.  ERRORS: mw::Error(kUsage) for what its format has no place for, and for
/// materials without values where the format has a place for these.
[[nodiscard]] std::unique_ptr<io::MeshSink> open_file(const std::filesystem::path& path,
                                                      const mwmesh::FileOptions& file,
                                                      bool has_values, bool has_wedges = false);
/// Writes the mesh into the sink, from begin to finish, with the values of tets if `values` is
/// true.  ERRORS: mw::Error(kUsage) for lists that do not fit together.
void deliver(const mwmesh::Mesh& mesh, io::MeshSink& sink, bool values = true);

}  // namespace mw::api
