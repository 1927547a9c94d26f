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

/// A label that gained or lost voxels; before or after is empty where the volume did not have it.
struct LabelChange {
  RawLabel label = 0;
  std::optional<LabelFacts> before;
  std::optional<LabelFacts> after;
};

/// Two labels whose common faces changed in number.
struct ContactChange {
  RawLabel first = 0;
  RawLabel second = 0;
  std::array<std::uint64_t, 3> before{};  ///< across x, y and z of the array
  std::array<std::uint64_t, 3> after{};
};

struct VolumeDelta {
  std::uint64_t voxels = 0;             ///< how many changed
  Box3 box;                             ///< holds all that changed, in voxels as people count them
  std::vector<LabelChange> labels;      ///< ascending
  std::vector<ContactChange> contacts;  ///< ascending
  bool labels_signed = false;
  bool is_renumbered = false;  ///< labels were given other numbers (VolumeInfo::numbering)
};

/// What a thread takes that reads a tile of both volumes.
inline constexpr std::uint64_t kComparerBytes = std::uint64_t{8} << 20U;

/// Compares two volumes of the same shape, in several passes over both.  Of task, it looks at
/// threads, readers, memory, folder and between.  Where tiles are only read, `readers` threads do
/// so at once, each of which takes up to kComparerBytes. ERRORS: those of the volumes, and of
/// temporary files.
[[nodiscard]] VolumeDelta delta_of(const io::LabelVolume& before, const io::LabelVolume& after,
                                   const VerifyTask& task, int readers);

/// The size of a mesh.
struct MeshSize {
  std::uint64_t vertices = 0;
  std::uint64_t tets = 0;
};

/// Returns the changes as JSON.  "box" is null if nothing changed, and a label's facts are null
/// where the volume does not have it.  Betti numbers are those of the closed and the open region of
/// a label, as promise P1 counts them.
[[nodiscard]] io::Json delta_json(const VolumeDelta& delta, const std::optional<MeshSize>& before,
                                  const MeshSize& after);

}  // namespace mw::engine
