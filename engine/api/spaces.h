// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Spaces, boxes and names of the library as io has them.
#pragma once

#include "engine/mwmesh.h"
#include "io/names/label_names.h"
#include "io/volume/volume_space.h"

namespace mw::api {

/// ERRORS: mw::Error(kInput) for a space that makes no sense.
[[nodiscard]] io::VolumeSpace io_space(const mwmesh::Space& space);
[[nodiscard]] mwmesh::Space library_space(const io::VolumeSpace& space);
[[nodiscard]] Box3 io_box(const mwmesh::Box& box);
[[nodiscard]] mwmesh::Box library_box(const Box3& box);
[[nodiscard]] io::LabelNames io_names(const std::vector<mwmesh::LabelName>& names);
[[nodiscard]] std::vector<mwmesh::LabelName> library_names(const io::LabelNames& names);

}  // namespace mw::api
