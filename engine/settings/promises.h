// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What a run promises of its mesh, by its settings.
#pragma once

#include <string>

#include "engine/settings/settings.h"
#include "io/mesh/mesh_record.h"

namespace mw::engine {

[[nodiscard]] io::MeshPromises promises_of(const MeshSettings& settings);

/// Returns the radius ratio that no tet is below: that of the run, or where tets were cut what is
/// left of it.
[[nodiscard]] double floor_of(const io::MeshPromises& promises);

/// Why volumes are not promised where labels come from scores (io::LabelScores): a crossing may be
/// half a voxel from the face, and the volume of the scores is the better one.
inline constexpr const char* kVolumesOfScores =
    "--values: interfaces are where the values say, not at voxel faces";

/// Returns why the volumes of labels are not promised (P8); empty when they are.
[[nodiscard]] std::string why_no_volumes(const io::MeshPromises& promises);

/// Returns which promises about distances and shapes are weaker than by default, in a few words
/// each; empty when none is.
[[nodiscard]] std::string less_than_default(const io::MeshPromises& promises);

/// ERRORS: mw::Error(kInput) when no run can have promised this, by the ranges of its settings.
void check_promises(const io::MeshPromises& promises);

}  // namespace mw::engine
