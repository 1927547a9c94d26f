// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Spaces, boxes, names and meshes of the library as io has them, and what is behind its Volume.
#pragma once

#include "engine/mwmesh.h"
#include "io/mesh/mesh_data.h"
#include "io/volume/label_volume.h"
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

namespace mwmesh {

class Volume::Content {
 public:
  explicit Content(std::shared_ptr<const mw::io::LabelVolume> volume)
      : volume_(std::move(volume)) {}

  [[nodiscard]] const std::shared_ptr<const mw::io::LabelVolume>& volume() const { return volume_; }

 private:
  std::shared_ptr<const mw::io::LabelVolume> volume_;
};

/// The only class that looks behind a Volume.
class VolumeAccess {
 public:
  /// ERRORS: Error(kUsage) for a volume that was moved from; the same holds for shared().
  [[nodiscard]] static const mw::io::LabelVolume& labels(const Volume& volume) {
    return *shared(volume);
  }
  [[nodiscard]] static const std::shared_ptr<const mw::io::LabelVolume>& shared(
      const Volume& volume) {
    if (volume.content_ != nullptr) return volume.content_->volume();
    throw Error(ErrorKind::kUsage, "volume: it was moved from, so there is nothing in it");
  }
  [[nodiscard]] static Volume wrap(std::shared_ptr<const mw::io::LabelVolume> volume) {
    return Volume(std::make_shared<const Volume::Content>(std::move(volume)));
  }
};

}  // namespace mwmesh
