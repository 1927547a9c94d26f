// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What an edit of a volume did to its labels.
#pragma once

#include <optional>
#include <vector>

#include "engine/labels/label_regions.h"
#include "engine/verify/verify_mesh.h"
#include "io/json/json.h"
#include "io/volume/label_volume.h"
#include "kernels/audit/topology/betti.h"

namespace mw::engine {

/// A label in a volume that has it.
struct LabelFacts {
  std::uint64_t voxels = 0;
  audit::RegionBetti betti;
};

/// A label that gained or lost voxels; none: the volume did not have it.
struct LabelChange {
  RawLabel label = 0;
  std::optional<LabelFacts> before;
  std::optional<LabelFacts> after;
};

/// Labels whose common faces changed in number.
struct ContactChange {
  RawLabel first = 0;
  RawLabel second = 0;
  std::array<std::uint64_t, 3> before{};  ///< across x, y and z of the array
  std::array<std::uint64_t, 3> after{};
};

struct VolumeDelta {
  std::uint64_t voxels = 0;             ///< that changed
  Box3 box;                             ///< that has them all
  std::vector<LabelChange> labels;      ///< ascending
  std::vector<ContactChange> contacts;  ///< ascending
  bool labels_signed = false;
};

/// Several passes over both volumes, which have the same shape.  task: threads, memory, folder and
/// between are looked at.
/// ERRORS: those of the volumes, and of temporary files.
[[nodiscard]] VolumeDelta delta_of(const io::LabelVolume& before, const io::LabelVolume& after,
                                   const VerifyTask& task);

/// before and after of a mesh's size.
struct MeshSize {
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
};

/// "box" null: nothing changed.  Betti numbers are of the closed and the open region of a label, as
/// promise P1 counts them; null: the volume does not have the label.
[[nodiscard]] io::Json delta_json(const VolumeDelta& delta, const std::optional<MeshSize>& before,
                                  const MeshSize& after);

}  // namespace mw::engine
